#pragma once

#include <vector>

#include "tiles/tile_layout.h"

namespace plat::tiles {

/// Closes the gaps that placements leave: every joint goes to the mean of where its tiles would
/// have it; every other vertex to the mean of where they would have it were they bent to those
/// joints, evenly along the ring in between. Rounded to the working grid. What imagery and
/// everything on output sees.
///
/// Guarantees: 1. tiles of a block have the same vertices along common boundaries, whatever the
/// placements;  2. where all tiles agree, vertices stand where they have them, to a grid step;  3.
/// settling twice is settling once. Complexity: O(n).
/// Paper: [ABVA08, Sec. 6], the simplification is undone: all vertices move, joints or not.
TileLayout settled(TileLayout layout);

/// Per tile, the root mean square distance of its vertices from where its placement has them,
/// metres: how far closing the gaps bends it.
std::vector<double> closing_residuals_m(const TileLayout& layout);

}  // namespace plat::tiles
