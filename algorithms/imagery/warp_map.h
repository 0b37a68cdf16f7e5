#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "imagery/scanline_grid.h"

namespace plat::imagery {

/// Where a target point comes from, and how the source point moves with it: columns of the
/// Jacobian, metres of the source per metre of the target.
struct SourcePoint {
  Point at;
  Point per_east;
  Point per_north;
};

/// How a map distorts at one place.
struct Stretch {
  double singular_ratio = 1.0;  ///< larger by smaller singular value of the Jacobian, at least 1
  double area_ratio = 1.0;      ///< area of the target by area of the source
};
Stretch stretch_at(const SourcePoint& point);

/// The map from the target to the source that a grid of quadrilaterals means: point to parameters
/// by inverse bilinear interpolation, parameters to point by bilinear interpolation.
///
/// Guarantees: 1. target corners of a column go to its source corners, edges to edges, linearly;
/// 2. the map of exchanged roles is its inverse;  3. a point outside the target's quadrilaterals
/// (a pixel's centre just outside the contour) goes to the image of the nearest parameters, on the
/// contour of the source.
class WarpMap {
 public:
  explicit WarpMap(const WarpGrid& grid);

  /// @param column  a guess, and the column that the point was found in; near points are found fast
  [[nodiscard]] SourcePoint source_of(Point target, std::size_t& column) const;
  [[nodiscard]] SourcePoint source_of(Point target) const {
    std::size_t column = 0;
    return source_of(target, column);
  }

 private:
  struct Parameters {
    double a;
    double b;
    double excess;  // how far outside [0, 1]^2
  };
  /// A quadrilateral p + a e + b f + a b g, about its first corner.
  struct Patch {
    Point p, e, f, g;
    explicit Patch(const Quad& quad);
    [[nodiscard]] Point at(double a, double b) const;
  };
  [[nodiscard]] Parameters parameters(const Patch& patch, Point target) const;
  void move_towards(Point target, std::size_t& column) const;

  std::vector<Patch> target_;
  std::vector<Patch> source_;
};

}  // namespace plat::imagery
