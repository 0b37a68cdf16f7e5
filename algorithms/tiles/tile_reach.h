#pragma once

#include <span>

#include "core/affine.h"
#include "core/box.h"
#include "tiles/tile_layout.h"

namespace plat::tiles {

/// Of the tile's vertices, where they are now.
Box box_of(const TileLayout& layout, const Tile& tile);
/// Of the tile's corners, where a placement would have them.
Box box_at(const Tile& tile, const Affine& placement);

/// The least distance of a point of one box from a point of the other; 0 where they meet.
/// Pre: none is empty.
double distance_m(const Box& a, const Box& b);
/// Whether one of the boxes is no farther than `reach_m`: how it is told which tiles make room.
bool is_within_reach(const Box& box, std::span<const Box> around, double reach_m);

}  // namespace plat::tiles
