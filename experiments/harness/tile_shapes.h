#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "blocks/blocks_from_parcels.h"
#include "core/parallel.h"
#include "geodata/layer.h"
#include "harness/parcel_shapes.h"
#include "similarity/labelled_shape.h"

namespace plat::harness {

/// The polygons of a layer as shape similarities see them.
struct ReadTileShapes {
  geodata::LocalFrame frame;
  std::vector<similarity::LabelledShape> shapes;  ///< on the working grid, in file order
  std::vector<std::string> ids;                   ///< per shape
  /// Per shape, tiles of one block have the same number; none: in no block.
  std::vector<std::optional<std::uint32_t>> blocks;
  std::vector<blocks::BlockFailure> failures;  ///< features that are no usable tile
  std::size_t without_streets = 0;             ///< shapes in no block: their edges are unlabelled
};

/// Every polygon with its edges labelled.
/// @throws InputError as geodata::read_layer
ReadTileShapes read_tile_shapes(const ParcelShapeSources& sources, Jobs jobs);

/// Per edge of a ring, street where at least half of it is front, else property.
/// @param fronts  parts of the boundary, as parcels::street_fronts gives them
std::vector<similarity::EdgeLabel> edge_labels(const Ring& ring, std::span<const Segment> fronts);

}  // namespace plat::harness
