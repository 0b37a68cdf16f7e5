#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/ids.h"

namespace plat::blocks {

/// Two blocks that face each other across a street: an edge of the dual of the street network
/// [VKW12, Sec. 3.1].
struct DualEdge {
  BlockId a;  ///< a < b
  BlockId b;
  StreetId street;
  double length_m = 0.0;  ///< of the centreline between them

  friend bool operator==(const DualEdge&, const DualEdge&) = default;
};

/// The neighbours of each of `block_count` blocks, sorted, each once.
std::vector<std::vector<BlockId>> neighbours_of(std::span<const DualEdge> dual,
                                                std::size_t block_count);

}  // namespace plat::blocks
