#pragma once

#include "tiles/reconfiguration_internal.h"

namespace plat::tiles::detail {

/// Replaces tiles over the thresholds and solves again, in rounds.
/// @param observed  the layout that replacements are copied from, as observed
/// @param solution  of `layout`, settled
/// @param held      tiles of `layout` that the operation holds
SolvedLayout with_replacements(const TileLayout& observed, SolvedLayout solution,
                               const Targets& held, const ReplacementOptions& replacement,
                               const ReconfigurationOptions& options,
                               ReconfigurationReport& report);

}  // namespace plat::tiles::detail
