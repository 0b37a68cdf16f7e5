#pragma once

#include "editing/editor.h"
#include "tiles/tile_layout.h"

namespace plat::testing {

/// The tiles of grid_city(): four rectangles a block, of 44 x 34 m, the ids of a block in a row,
/// west to east, then south to north; two links across each street for each two tiles that face.
tiles::TileLayout grid_tiles(int columns, int rows);

/// A grid of streets with those tiles.
editing::City tiled_grid_city(int columns, int rows, const editing::CityOptions& options = {});

/// A layout, to the last bit, as text.
std::string bytes_of(const tiles::TileLayout& layout);

/// The layout with every tile carried by one map from where it is.
tiles::TileLayout carried(tiles::TileLayout layout, const Affine& map);

}  // namespace plat::testing
