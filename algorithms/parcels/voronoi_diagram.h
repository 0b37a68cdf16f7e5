#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/box.h"
#include "core/point.h"

namespace plat::parcels {

/// An edge of a Voronoi diagram, clipped to a box, with the two sites it separates (indices into
/// the input).
struct VoronoiEdge {
  Segment segment;
  std::uint32_t left_site = 0;
  std::uint32_t right_site = 0;
};

/// The edges of the Voronoi diagram of distinct sites within `window`, which must contain all
/// sites. Collinear sites are allowed. Exact predicates, rounded vertices (CGAL, EPICK).
/// Complexity: O(n log n).
std::vector<VoronoiEdge> voronoi_edges(std::span<const Point> sites, const Box& window);

}  // namespace plat::parcels
