#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/failure.h"
#include "tiles/tile_layout.h"

namespace plat::tiles {

/// What is wrong with a tile as it stands.
struct TileDefect {
  std::uint32_t tile = 0;              ///< index
  std::optional<std::uint32_t> other;  ///< the tile it overlaps, if any; greater than `tile`
  Failure failure;                     ///< kTilesOverlap
};

/// Every tile that is turned inside out or is not strictly simple, and every two tiles that
/// overlap, whatever their blocks; sorted. Exact for vertices on the working grid.
///
/// Proof used: the insides of two simple tiles meet if and only if edges cross, or the angles that
/// the two have at a point that both boundaries hold overlap, or a ring of one lies wholly inside
/// the other. Complexity: O(n log n) for tiles of similar size.
std::vector<TileDefect> find_tile_defects(const TileLayout& layout);

/// The first thing that keeps a layout from being one: an invariant of TileLayout that does not
/// hold (kUnknownEntity, kNotFinite), a tile turned inside out or overlapping another
/// (kTilesOverlap). nullopt where all is well.
std::optional<Failure> find_layout_defect(const TileLayout& layout);

}  // namespace plat::tiles
