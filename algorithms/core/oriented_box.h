#pragma once

#include <span>

#include "core/polygon.h"

namespace plat {

/// A rectangle in any direction: `axis` is the unit vector along its longer side.
struct OrientedBox {
  Point center;
  Point axis{1.0, 0.0};
  double length_m = 0.0;  ///< along `axis`
  double width_m = 0.0;   ///< across; width_m <= length_m

  [[nodiscard]] double area_m2() const { return length_m * width_m; }
  /// length / width, at least 1; infinity where the width is zero.
  [[nodiscard]] double aspect_ratio() const;
};

/// The rectangle of least area around the points. It is flush with an edge of their convex hull, so
/// with an edge of the polygon wherever that edge lies on the hull [VKW12, Sec. 4.3, "edge
/// alignment"]. Ties go to the direction found first along the hull. Complexity: O(n log n) +
/// O(h^2) of the hull.
OrientedBox minimum_area_box(std::span<const Point> points);
OrientedBox minimum_area_box(const Polygon& polygon);

}  // namespace plat
