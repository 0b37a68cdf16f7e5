#include "blocks/dual_graph.h"

#include <algorithm>

#include "core/failure.h"

namespace plat::blocks {

std::vector<std::vector<BlockId>> neighbours_of(std::span<const DualEdge> dual,
                                                std::size_t block_count) {
  std::vector<std::vector<BlockId>> out(block_count);
  for (const DualEdge& edge : dual) {
    expects(edge.a.value < block_count && edge.b.value < block_count, "blocks of the dual exist");
    out[edge.a.value].push_back(edge.b);
    out[edge.b.value].push_back(edge.a);
  }
  for (auto& row : out) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  return out;
}

}  // namespace plat::blocks
