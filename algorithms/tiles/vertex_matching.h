#pragma once

#include <span>
#include <vector>

#include "core/polygon.h"
#include "tiles/tile_layout.h"

namespace plat::tiles {

/// Rings of the tiles of one block over common vertices, numbered from 0.
struct MatchedRings {
  std::vector<std::vector<std::vector<Corner>>> tiles;  ///< per shape: outer ring, then holes
  std::uint32_t vertex_count = 0;
};

/// Gives shapes of one block common vertices: corners within `tolerance_m` of each other, nearest
/// first, never two of one shape; then every vertex within `tolerance_m` of an edge of a shape that
/// does not have it is put into that edge, unless the edge is already another's in reverse.
///
/// Guarantees: 1. a shape has a vertex at most once;  2. corners that shapes had of their own are
/// at most `tolerance_m` apart;  3. rest positions of own corners are as given; of the others, on
/// the edge, to a grid step.
/// Pre: shapes admitted (core/validity.h). Complexity: O(n log n).
MatchedRings match_vertices(std::span<const Polygon> shapes, double tolerance_m);

}  // namespace plat::tiles
