#include "blocks/block_assignment.h"

#include <cmath>

#include "core/working_grid.h"

namespace plat::blocks {
namespace {

bool is_finite(const Polygon& polygon) {
  bool all = !polygon.outer.empty();
  for_each_edge(polygon, [&](const Segment& s) {
    all = all && std::abs(s.a.x) <= kGridExtent_m &&
          std::abs(s.a.y) <= kGridExtent_m;  // false for NaN
  });
  return all;
}

}  // namespace

BlockAssignment assign_to_blocks(std::span<const Block> blocks, std::span<const Polygon> shapes) {
  BlockAssignment out;
  out.of_block.resize(blocks.size());
  std::vector<Box> boxes;
  for (const Block& block : blocks) boxes.push_back(box_of(block.contour));
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    bool is_found = false;
    const Polygon shape = is_finite(shapes[i]) ? snap_polygon(shapes[i]) : Polygon{};
    if (shape.outer.size() > 2 && area_m2(shape) > 0.0) {
      const Point p = interior_point(shape);
      for (std::size_t b = 0; b < blocks.size() && !is_found; ++b) {
        is_found = boxes[b].contains(p) && locate(blocks[b].contour, p) == Side::kInside;
        if (is_found) out.of_block[b].push_back(i);
      }
    }
    if (!is_found) out.outside.push_back(i);
  }
  return out;
}

}  // namespace plat::blocks
