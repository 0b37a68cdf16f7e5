#pragma once

#include "tiles/tile_layout.h"

namespace plat::tiles {

/// The one-time simplification: sets `is_joint` of every vertex. Only vertices that tiles share are
/// joints; of a common boundary of two tiles, those that keep it within `collinear_m`; of vertices
/// of a tile that are nearer than `near_m`, one.
///
/// Guarantee: two tiles that share two vertices or more keep two joints at least; tiles that share
/// one keep it. Complexity: O(n log n).
/// Paper: [ABVA08, Sec. 6]; rings keep all vertices, so that nothing has to be undone on output.
TileLayout with_joints_selected(TileLayout layout, double near_m, double collinear_m);

}  // namespace plat::tiles
