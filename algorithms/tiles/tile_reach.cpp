#include "tiles/tile_reach.h"

#include <algorithm>
#include <cmath>

namespace plat::tiles {

Box box_of(const TileLayout& layout, const Tile& tile) {
  Box box;
  for (const auto& ring : tile.rings) {
    for (const Corner& corner : ring) box.add(layout.vertices[corner.vertex].at);
  }
  return box;
}

Box box_at(const Tile& tile, const Affine& placement) {
  Box box;
  for (const auto& ring : tile.rings) {
    for (const Corner& corner : ring) box.add(placement(corner.rest));
  }
  return box;
}

double distance_m(const Box& a, const Box& b) {
  const double dx = std::max({0.0, a.min.x - b.max.x, b.min.x - a.max.x});
  const double dy = std::max({0.0, a.min.y - b.max.y, b.min.y - a.max.y});
  return std::hypot(dx, dy);
}

bool is_within_reach(const Box& box, std::span<const Box> around, double reach_m) {
  return std::ranges::any_of(around,
                             [&](const Box& other) { return distance_m(box, other) <= reach_m; });
}

}  // namespace plat::tiles
