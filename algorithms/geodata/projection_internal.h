#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/point.h"
#include "geodata/gdal_internal.h"

namespace plat::geodata::detail {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline bool is_finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// Maps points from one reference to another; what cannot be mapped becomes NaN.
class Projection {
 public:
  Projection(const OGRSpatialReference& from, const OGRSpatialReference& to);

  [[nodiscard]] Point operator()(Point p) const;
  void apply(std::vector<Point>& points) const;

 private:
  std::unique_ptr<OGRCoordinateTransformation> transformation_;
};

/// Whether a length in this CRS is, but for the projection's small error, a length on the ground.
bool is_metric(const OGRSpatialReference& reference);

/// The frame of data with this CRS and centre (in that CRS): the CRS itself if it is metric, else
/// the WGS 84 UTM zone of the centre; the origin is the centre, rounded to 1000 m.
/// @param name   of the source, for the message
/// @param tool   that gives the source its right CRS, for the message
/// @throws InputError where the centre is not a place in the CRS
LocalFrame choose_frame(const OGRSpatialReference& source, Point center, const std::string& name,
                        std::string_view tool);

}  // namespace plat::geodata::detail
