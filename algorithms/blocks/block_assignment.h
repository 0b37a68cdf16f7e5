#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blocks/block.h"

namespace plat::blocks {

/// Which shapes (parcels, footprints) lie in which block: those with an interior point in it.
struct BlockAssignment {
  std::vector<std::vector<std::uint32_t>> of_block;  ///< per block: indices of shapes, ascending
  std::vector<std::uint32_t> outside;                ///< in no block, or without area
};

/// Shapes are taken on the working grid; any coordinates are allowed. Blocks do not overlap: the
/// first one counts. Complexity: O(shapes * blocks) box tests.
BlockAssignment assign_to_blocks(std::span<const Block> blocks, std::span<const Polygon> shapes);

}  // namespace plat::blocks
