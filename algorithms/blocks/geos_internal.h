#pragma once

#include <geos_c.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/polygon.h"

/// GEOS (unions, buffers, differences) behind our own shapes. One Geos per thread of work: a
/// context is not shared. GEOS reports trouble as a null pointer, which becomes nullopt here.
namespace plat::blocks::detail {

struct GeosDeleter {
  GEOSContextHandle_t context = nullptr;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
};
using GeosShape = std::unique_ptr<GEOSGeometry, GeosDeleter>;

class Geos {
 public:
  Geos();
  ~Geos();
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  [[nodiscard]] GEOSContextHandle_t context() const { return context_; }
  [[nodiscard]] GeosShape own(GEOSGeometry* geometry) const {
    return GeosShape(geometry, {context_});
  }

  /// Null for a ring of fewer than three points.
  [[nodiscard]] GeosShape from(const Polygon& polygon) const;
  /// The polygons of a shape, oriented as Polygon wants them, in the order of their lowest outer
  /// vertex; lines and points are left out.
  [[nodiscard]] std::vector<Polygon> polygons_of(const GEOSGeometry* shape) const;

  /// Grown (or, with a negative distance, shrunk) with mitred corners, so that a corner stays one
  /// vertex.
  [[nodiscard]] GeosShape buffer(const GEOSGeometry* shape, double distance_m) const;
  [[nodiscard]] GeosShape union_of(std::vector<GeosShape> shapes) const;
  /// On the working grid.
  [[nodiscard]] GeosShape difference(const GEOSGeometry* a, const GEOSGeometry* b) const;
  /// Douglas and Peucker's simplification that keeps rings simple and apart.
  [[nodiscard]] GeosShape simplified(const GEOSGeometry* shape, double tolerance_m) const;
  [[nodiscard]] bool intersects(const GEOSGeometry* a, const GEOSGeometry* b) const {
    return GEOSIntersects_r(context_, a, b) == 1;
  }

 private:
  GEOSContextHandle_t context_;
};

}  // namespace plat::blocks::detail
