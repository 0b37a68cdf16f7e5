#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/box.h"
#include "tiles/layout_solver.h"
#include "tiles/reconfiguration.h"
#include "tiles/tile_layout.h"
#include "tiles/tile_reach.h"

/// What all operations on a layout share: which tiles are held, solving, closing gaps, reporting.
namespace plat::tiles::detail {

/// Tiles by index, and where each is to be held.
using Targets = std::map<std::uint32_t, Affine>;

/// Indices of tiles, ascending, each once. Fails with kUnknownEntity, also where none is named.
Expected<std::vector<std::uint32_t>> indices_of(const TileLayout& layout,
                                                std::span<const TileId> ids);

/// Boxes of tiles now, and where a target carries them: what an operation reaches from.
std::vector<Box> boxes_of(const TileLayout& layout, std::span<const std::uint32_t> tiles,
                          const Targets& targets);

/// Targets, pinned tiles where they are, and all that are farther than the reach from the boxes
/// where they are.
Targets held_tiles(const TileLayout& layout, Targets targets, std::span<const Box> around,
                   const std::optional<double>& reach_m);

/// The held tiles, or, where there are none, the tile farthest from the boxes where it is: nothing
/// moves in a layout of which nothing is held.
Targets held_or_farthest(const TileLayout& layout, Targets held, std::span<const Box> around);

/// A layout whose placements solve its constraints, not yet settled.
struct SolvedLayout {
  TileLayout layout;
  LayoutSolution solution;
};

/// Solves for all tiles that are not held. A tile that moves by less than kUnmoved_m stays as it
/// is. Fails as LayoutSolver does, and with kOutOfRange where a tile would leave the working grid.
/// @param stiffness  per tile, what its rigidity and its joints weigh more; the errors are those of
///                   the layout without. Empty: 1
Expected<SolvedLayout> solved(TileLayout layout, const Targets& held, const SolverOptions& options,
                              std::span<const double> stiffness = {});

/// Tiles that rounding errors of the solver displace by less are where they were: a millionth of a
/// metre, a thousandth of the working grid's step.
inline constexpr double kUnmoved_m = 1e-6;

/// Brings the vertices to their tiles and checks the layout. Fails with kTilesOverlap.
Expected<TileLayout> settled_and_checked(TileLayout layout);

/// The layout after an operation: solved, tiles replaced where the options say so, settled, checked
/// and compared with the layout before.
Expected<Reconfiguration> reconfigured(const TileLayout& before, TileLayout changed,
                                       const Targets& held, const ReconfigurationOptions& options);

/// What became of tiles, and the errors of a solution.
void compare(const TileLayout& before, const TileLayout& after, const LayoutSolution& solution,
             ReconfigurationReport& report);

/// Drops vertices that no tile has, and links of a tile to itself.
void drop_unused(TileLayout& layout);

/// The layout without the tiles (indices ascending); links to them are dropped. Indices change.
TileLayout without_tiles(const TileLayout& layout, std::span<const std::uint32_t> tiles);

}  // namespace plat::tiles::detail
