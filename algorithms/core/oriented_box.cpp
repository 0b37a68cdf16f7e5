#include "core/oriented_box.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace plat {

double OrientedBox::aspect_ratio() const {
  return width_m > 0.0 ? length_m / width_m : std::numeric_limits<double>::infinity();
}

OrientedBox minimum_area_box(std::span<const Point> points) {
  const Ring hull = convex_hull(points);
  if (hull.empty()) return {};
  if (hull.size() < 3) {
    const Point d = hull.back() - hull.front();
    const double size = length(d);
    return {midpoint(hull.front(), hull.back()), size > 0.0 ? d / size : Point{1.0, 0.0}, size,
            0.0};
  }
  OrientedBox best;
  double best_area = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point u = normalized(hull[i + 1 == hull.size() ? 0 : i + 1] - hull[i]);
    const Point v = perpendicular(u);
    Box extent;
    for (const Point p : hull) extent.add(Point{dot(p - hull[i], u), dot(p - hull[i], v)});
    const double area = extent.width() * extent.height();
    // Rounding must not choose between directions that are equally good.
    if (area < best_area * (1.0 - 1e-12)) {
      best_area = area;
      const Point c = extent.center();
      best = {hull[i] + c.x * u + c.y * v, u, extent.width(), extent.height()};
      if (best.length_m < best.width_m) {
        best.axis = v;
        std::swap(best.length_m, best.width_m);
      }
    }
  }
  return best;
}

OrientedBox minimum_area_box(const Polygon& polygon) {
  return minimum_area_box(std::span<const Point>(polygon.outer));
}

}  // namespace plat
