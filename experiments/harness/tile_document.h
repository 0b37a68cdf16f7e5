#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geodata/layer.h"
#include "tiles/tile_layout.h"

namespace plat::harness {

/// The layers of a tile layout in a city's document: tiles (where each is now, its placement, and
/// its corners at rest), tile_vertices and tile_links (docs/reconfigure_script.md).
///
/// Guarantees: read_tile_document() of what was written is the same layout, to the last bit.
std::vector<geodata::Layer> tile_document_layers(const tiles::TileLayout& layout,
                                                 const geodata::LocalFrame& frame);

/// @param next_id  of the layer `document`
/// @throws InputError with layer and feature where the layers are no layout (any more); with the
///         tile where find_layout_defect() finds one
tiles::TileLayout read_tile_document(const std::string& file, const geodata::LocalFrame& frame,
                                     std::uint32_t next_id);

}  // namespace plat::harness
