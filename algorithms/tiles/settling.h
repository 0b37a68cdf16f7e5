#pragma once

#include <vector>

#include "tiles/tile_layout.h"

namespace plat::tiles {

/// Closes the gaps that placements leave: every vertex goes to the mean of where its tiles would
/// have it, rounded to the working grid. What imagery and everything on output sees.
///
/// Guarantees: 1. tiles of a block have the same vertices along common boundaries, whatever the
/// placements;  2. a vertex on which its tiles agree stands where they have it, to half a grid
/// step;  3. settling twice is settling once. Complexity: O(n).
/// Paper: [ABVA08, Sec. 6], the simplification is undone: all vertices move, joints or not.
TileLayout settled(TileLayout layout);

/// The same for layouts that fold when settled so, where tiles with a fine outline meet a third
/// one: every joint goes to the mean of where its tiles would have it; every other vertex to the
/// mean of where its tiles would have it were they bent to their joints, within 10 m of those.
///
/// Guarantees: as of settled(); where no joint leaves a gap, the result is that of settled().
TileLayout settled_to_joints(TileLayout layout);

/// Per tile, the root mean square distance of its vertices from where its placement has them,
/// metres: how far closing the gaps bends it.
std::vector<double> closing_residuals_m(const TileLayout& layout);

}  // namespace plat::tiles
