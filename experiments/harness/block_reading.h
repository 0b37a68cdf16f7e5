#pragma once

#include <optional>
#include <string>
#include <vector>

#include "blocks/block.h"
#include "blocks/blocks_from_parcels.h"
#include "core/parallel.h"
#include "geodata/layer_io.h"
#include "parcels/parcel_style.h"

namespace plat::harness {

/// Blocks from a polygon layer that someone else made.
struct ReadBlocks {
  geodata::LocalFrame frame;
  std::vector<blocks::Block> blocks;  ///< edges face nothing until labelled
  std::vector<blocks::BlockFailure>
      failures;  ///< features that are no usable block, with their ids
};

/// Every polygon of the layer as a block, admitted to the working grid; the others are failures.
/// @param frame  to read it in; chosen from the layer if not given
/// @throws InputError as geodata::read_layer
ReadBlocks read_blocks(const geodata::LayerSource& source, Jobs jobs,
                       const std::optional<geodata::LocalFrame>& frame = std::nullopt);

/// Labels the edges from the centrelines in `streets` ("FILE[:layer]"), or, where it is empty, from
/// the gaps between the blocks.
void label_from_streets(ReadBlocks& blocks, const std::string& streets, Jobs jobs);

/// Per block, the style of the observed parcels that lie in it; of no parcels where there are none.
std::vector<parcels::ParcelStyle> observed_styles(const ReadBlocks& blocks,
                                                  const geodata::LayerSource& observed);

}  // namespace plat::harness
