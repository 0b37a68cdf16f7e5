#pragma once

#include <cstdint>

#include "core/failure.h"
#include "tiles/tile_layout.h"

namespace plat::tiles::detail {

/// The layout without a tile and its land: two opposite sides of it are laid on each other, the
/// other two become a point each. Vertices of the sides merge pairwise, so that the neighbours are
/// joined to each other; links pass to the neighbour across, or, where none is there, become links
/// between what lies across the two streets. Those two sides become points that cost neighbours
/// less length: the front along a street and its back. A tile surrounded by another one leaves its
/// land to it.
///
/// Guarantees: 1. tiles of the block have the same vertices along common boundaries;  2. tiles that
/// links and common vertices connected through the tile still are connected.
/// Failure kNoPlace: every way to close the land leaves a neighbour with less than three corners,
/// or touching itself.
/// Paper: [ABVA08, Sec. 4], "collapsing (or removing) tiles"; the paper does not say how (ADR
/// 0039).
Expected<TileLayout> without_land(const TileLayout& layout, std::uint32_t tile);

}  // namespace plat::tiles::detail
