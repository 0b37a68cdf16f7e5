#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/point.h"

namespace plat::streets {

/// An edge of a triangulation, a < b: indices of its places.
struct DelaunayEdge {
  std::uint32_t a = 0;
  std::uint32_t b = 0;

  friend auto operator<=>(const DelaunayEdge&, const DelaunayEdge&) = default;
};

/// The edges of the Delaunay triangulation, sorted; of collinear places those between consecutive
/// ones. Pre: places on the working grid, all different.
///
/// Guarantees: 1. every edge whose diametral disc holds no other place, its rim included, is there.
/// Complexity: O(n log n).
std::vector<DelaunayEdge> delaunay_edges(std::span<const Point> places);

}  // namespace plat::streets
