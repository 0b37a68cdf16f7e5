#pragma once

#include <span>
#include <string>

#include "geodata/layer_io.h"

namespace plat::geodata {

/// A vector tile's place in the Web Mercator pyramid.
struct TileName {
  int zoom = 0;
  int column = 0;
  int row = 0;
};

/// From a file name "z-x-y.mvt". @throws InputError for another name
TileName parse_tile_name(const std::string& file);

/// One layer of several neighbouring vector tiles as if it had never been cut, in EPSG:3857
/// (frame origin 0, 0). GDAL clips each tile to its own box; then
/// - polygons of two tiles with equal attributes that share at least half of the shorter edge on
/// the
///   common border are united;
/// - features of lines with equal attributes, id included, whose ends meet on the border within a
///   tile unit become one feature, and the lines that meet there one line.
/// Features without a part of `kind` are left out. Fields: those of all tiles, and `tile`, the tile
/// of the first piece. Tiles without the layer are passed over.
/// @throws InputError where no tile has it
Layer merge_tiles(std::span<const std::string> files, const std::string& layer, GeometryKind kind);

}  // namespace plat::geodata
