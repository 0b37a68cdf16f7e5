#pragma once

#include <span>
#include <vector>

#include "geodata/layer.h"
#include "tiles/layout_construction.h"
#include "tiles/layout_solver.h"
#include "tiles/tile_layout.h"

namespace plat::harness {

/// A layout as layers to look at, each tile where it is now:
/// `tiles`: tile, source_id, zone, block, area_m2, rest_area_m2, pinned, xx, xy, yx, yy, shift_x,
/// shift_y (the placement, local frame), moved_m (of the centroid), bent_m (closing residual), and,
/// of a solution, deformation and gap_m (mean over the tile's joints);
/// `joints`: vertex, tiles (how many share it), gap_m (largest distance of two of them);
/// `links`: a line from front to front by the link's points: tile_a, tile_b, width_m, gap_m.
std::vector<geodata::Layer> tile_layers(const tiles::TileLayout& layout,
                                        const geodata::LocalFrame& frame,
                                        const tiles::LayoutSolution* solution = nullptr);

/// Pieces that did not become tiles: source_id, code, message.
geodata::Layer tile_failure_layer(std::span<const tiles::TileFailure> failures,
                                  const geodata::LocalFrame& frame);

}  // namespace plat::harness
