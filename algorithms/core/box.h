#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "core/point.h"

namespace plat {

/// An axis-parallel box; empty until a point is added.
struct Box {
  Point min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool is_empty() const { return min.x > max.x || min.y > max.y; }
  [[nodiscard]] double width() const { return max.x - min.x; }
  [[nodiscard]] double height() const { return max.y - min.y; }
  [[nodiscard]] Point center() const { return midpoint(min, max); }

  void add(Point p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  void add(const Box& other) {
    if (other.is_empty()) return;
    add(other.min);
    add(other.max);
  }
  /// The box grown by `margin_m` on every side.
  [[nodiscard]] Box expanded(double margin_m) const {
    return {min - Point{margin_m, margin_m}, max + Point{margin_m, margin_m}};
  }
  [[nodiscard]] bool contains(Point p) const {
    return min.x <= p.x && p.x <= max.x && min.y <= p.y && p.y <= max.y;
  }
  [[nodiscard]] bool intersects(const Box& o) const {
    return min.x <= o.max.x && o.min.x <= max.x && min.y <= o.max.y && o.min.y <= max.y;
  }
};

inline Box box_of(std::span<const Point> points) {
  Box box;
  for (const Point p : points) box.add(p);
  return box;
}

}  // namespace plat
