#include "parcel_persistence/warp.h"

#include "core/failure.h"
#include "core/working_grid.h"

namespace plat::persistence {
namespace {

/// Nearer than this to an edge a point is on it, metres: there the coordinates are a limit.
constexpr double kOnEdge_m = 1e-6;

}  // namespace

MeanValueWarp::MeanValueWarp(std::span<const std::pair<Point, Point>> corners) {
  expects(corners.size() >= 3, "a warp has three corners");
  for (const auto& [before, after] : corners) {
    before_.push_back(before);
    after_.push_back(after);
  }
}

Point MeanValueWarp::operator()(Point p) const {
  const std::size_t n = before_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Segment edge{before_[i], before_[(i + 1) % n]};
    if (distance(edge, p) < kOnEdge_m)
      return lerp(after_[i], after_[(i + 1) % n], nearest_parameter(edge, p));
  }
  // tan(a / 2) = (r s - dot) / cross, for the angle a at p between neighbouring corners.
  const auto half_tangent = [&](std::size_t i) {
    const Point a = before_[i] - p;
    const Point b = before_[(i + 1) % n] - p;
    const double area = cross(a, b);
    const double rest = length(a) * length(b) - dot(a, b);
    return area == 0.0 ? 0.0 : rest / area;
  };
  Point sum;
  double weights = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = (half_tangent((i + n - 1) % n) + half_tangent(i)) / distance(before_[i], p);
    sum = sum + w * after_[i];
    weights += w;
  }
  return sum / weights;
}

Polygon MeanValueWarp::operator()(const Polygon& polygon) const {
  Polygon out;
  const auto carried = [&](const Ring& ring) {
    Ring moved;
    for (const Point p : ring) moved.push_back((*this)(p));
    return moved;
  };
  out.outer = carried(polygon.outer);
  for (const Ring& hole : polygon.holes) out.holes.push_back(carried(hole));
  return snap_polygon(out);
}

}  // namespace plat::persistence
