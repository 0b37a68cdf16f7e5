#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/polygon.h"

namespace plat::persistence {

/// Carries points along with a polygon: mean value coordinates of the polygon before, applied to
/// its vertices after (Hormann and Floater 2006). Maps vertices to vertices, edges to edges.
class MeanValueWarp {
 public:
  /// @param corners  vertices before and after, in ring order, at least three
  explicit MeanValueWarp(std::span<const std::pair<Point, Point>> corners);

  [[nodiscard]] Point operator()(Point p) const;
  /// On the working grid; fewer than three points where nothing is left.
  [[nodiscard]] Polygon operator()(const Polygon& polygon) const;

 private:
  std::vector<Point> before_;
  std::vector<Point> after_;
};

}  // namespace plat::persistence
