#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "tiles/reconfiguration_internal.h"

/// What is done before an operation is refused because tiles would overlap.
namespace plat::tiles::detail {

/// The graph, rigidity of tiles and weight of joints multiplied by the stiffness of their tiles (of
/// two, the larger). Empty: as it is.
TileGraph stiffened(TileGraph graph, std::span<const double> stiffness);

/// A layout without defects, and what it took.
struct StiffenedLayout {
  SolvedLayout solved;
  TileLayout layout;          ///< settled, without defects
  std::size_t tiles = 0;      ///< that were stiffened
  std::size_t solutions = 0;  ///< it took
};

/// Solves again and again, tiles with defects and those that they are joined to stiffer each time,
/// until no tile overlaps another one: what gives way then are tiles around, and streets. Fails
/// with kTilesOverlap where kStiffenings do not do, and as solved() does.
///
/// @param solution  whose tiles overlap
/// @param held      where tiles are held, by id
Expected<StiffenedLayout> without_overlaps(const SolvedLayout& solution,
                                           const std::map<TileId, Affine>& held,
                                           const SolverOptions& options);

}  // namespace plat::tiles::detail
