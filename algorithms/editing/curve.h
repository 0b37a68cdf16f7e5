#pragma once

#include "core/polygon.h"

namespace plat::editing {

/// The control points of a cubic Bezier street, the first near its start, the second near its end.
struct Curve {
  Point first;
  Point second;

  friend bool operator==(const Curve&, const Curve&) = default;
};

/// How far the polyline of a curved street may lie from the curve, metres: below what shows on a
/// map, above what would fill contours with points.
inline constexpr double kFlatness_m = 0.05;

/// The curve as a polyline on the working grid, ends included, without repeated points.
Polyline sampled(Point from, const Curve& curve, Point to);

/// The two halves' control points where the curve is cut at parameter `t` (de Casteljau), on the
/// working grid.
std::pair<Curve, Curve> split(Point from, const Curve& curve, Point to, double t);

/// The parameter of the point of the curve nearest to `p`, to the resolution of its polyline.
double nearest_parameter(Point from, const Curve& curve, Point to, Point p);

}  // namespace plat::editing
