#include "blocks/block.h"

#include <algorithm>
#include <cmath>

#include "core/failure.h"

namespace plat::blocks {

const Ring& ring_at(const Block& block, std::size_t ring) {
  expects(ring <= block.contour.holes.size(), "ring in range");
  return ring == 0 ? block.contour.outer : block.contour.holes[ring - 1];
}

void assign_logical_streets(Block& block, const std::vector<std::vector<std::string>>& keys,
                            double same_street_turn_rad) {
  std::uint32_t next_street = 0;
  for (std::size_t r = 0; r < block.edges.size(); ++r) {
    const Ring& ring = ring_at(block, r);
    auto& edges = block.edges[r];
    const std::size_t n = edges.size();
    expects(n == ring.size(), "one label per edge");
    const auto continues = [&](std::size_t i) {  // edge i is the same street as the edge before it
      const std::size_t before = (i + n - 1) % n;
      if (!edges[i].is_street() || !edges[before].is_street()) return false;
      if (!keys.empty() && (!keys[r][i].empty() || !keys[r][before].empty()))
        return keys[r][i] == keys[r][before];
      return std::abs(turn_rad(ring, i)) < same_street_turn_rad;
    };
    // Start at an edge that begins a street, so that a street across the ring's start gets one
    // number.
    std::size_t start = 0;
    while (start < n && continues(start)) ++start;
    if (start == n) start = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (start + k) % n;
      if (!edges[i].is_street()) continue;
      const bool is_same = k > 0 && continues(i);
      edges[i].logical_street = is_same ? edges[(i + n - 1) % n].logical_street : next_street++;
    }
  }
}

Block block_from_contour(BlockId id, Polygon contour, double width_m, double same_street_turn_rad) {
  Block block{id, {}, std::move(contour), {}};
  BlockEdge facing;
  facing.logical_street = 0;
  facing.street_width_m = width_m;
  facing.width_source = WidthSource::kAssumed;
  block.edges.emplace_back(block.contour.outer.size(), facing);
  for (const Ring& hole : block.contour.holes) block.edges.emplace_back(hole.size(), BlockEdge{});
  assign_logical_streets(block, {}, same_street_turn_rad);
  return block;
}

Block with_streets_assumed(const Block& block) {
  for (const auto& ring : block.edges) {
    if (std::any_of(ring.begin(), ring.end(), [](const BlockEdge& e) { return e.is_street(); }))
      return block;
  }
  Block out = block;
  out.edges = block_from_contour(block.id, block.contour).edges;
  return out;
}

}  // namespace plat::blocks
