#pragma once

#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"
#include "geodata/raster_io.h"
#include "imagery/carried_image.h"
#include "tiles/tile_layout.h"

namespace plat::harness {

/// Which tiles stand among others that they were not observed among: copies and replacements. Tiles
/// belong together where they have a shared vertex or a link at one place at rest; where two that
/// share a vertex do not, the smaller group is the one that came. So is a tile that shows the land
/// of another one, of a lower id.
std::vector<bool> tiles_from_elsewhere(const tiles::TileLayout& layout);

/// What each tile shows: its own piece of the image of the city at rest, carried by its placement;
/// bare earth where tiles were cut.
std::vector<imagery::CarriedPiece> carried_tiles(const tiles::TileLayout& layout);

/// Where the land between tiles comes from: it goes along as streets do (StreetFollowing), copies
/// and replacements leave it as it is.
imagery::PointMap ground_at_rest(const tiles::TileLayout& layout);

/// The image of a city of tiles as it is now, made from one of the city at rest: on the lines of
/// the source's pixels, tiles and kTileImageMargin_m around them.
/// @throws InputError where the image cannot be read or written, or shows nothing of the tiles
/// @returns the picture's grid
geodata::RasterGrid write_tile_image(const std::string& path, const tiles::TileLayout& layout,
                                     const std::string& image, const geodata::LocalFrame& frame,
                                     Jobs jobs = {},
                                     Progress::Style progress = Progress::Style::kQuiet);

inline constexpr double kTileImageMargin_m = 30.0;

}  // namespace plat::harness
