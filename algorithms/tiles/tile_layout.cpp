#include "tiles/tile_layout.h"

#include <algorithm>
#include <set>

namespace plat::tiles {
namespace {

template <class Place>
Polygon polygon_of(const Tile& tile, Place place) {
  Polygon out;
  for (std::size_t r = 0; r < tile.rings.size(); ++r) {
    Ring& ring = r == 0 ? out.outer : out.holes.emplace_back();
    ring.reserve(tile.rings[r].size());
    for (const Corner& corner : tile.rings[r]) ring.push_back(place(corner));
  }
  return out;
}

}  // namespace

Polygon shape_of(const TileLayout& layout, const Tile& tile) {
  return polygon_of(tile, [&](const Corner& c) { return layout.vertices.at(c.vertex).at; });
}

Polygon rest_shape_of(const Tile& tile) {
  return polygon_of(tile, [](const Corner& c) { return c.rest; });
}

similarity::LabelledShape labelled_shape_of(const TileLayout& layout, std::uint32_t index) {
  const Tile& tile = layout.tiles.at(index);
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::set<Edge> reversed;
  for (const Tile& other : layout.tiles) {
    if (other.block != tile.block || other.id == tile.id) continue;
    for (const auto& ring : other.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        reversed.emplace(ring[(i + 1) % ring.size()].vertex, ring[i].vertex);
    }
  }
  similarity::LabelledShape out{shape_of(layout, tile), {}, tile.zone};
  if (tile.rings.empty()) return out;
  const auto& ring = tile.rings.front();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Edge edge{ring[i].vertex, ring[(i + 1) % ring.size()].vertex};
    out.edges.push_back(reversed.contains(edge) ? similarity::EdgeLabel::kProperty
                                                : similarity::EdgeLabel::kStreet);
  }
  return out;
}

std::optional<std::uint32_t> find_tile(const TileLayout& layout, TileId id) {
  const auto it = std::ranges::find(layout.tiles, id, &Tile::id);
  if (it == layout.tiles.end()) return std::nullopt;
  return static_cast<std::uint32_t>(it - layout.tiles.begin());
}

}  // namespace plat::tiles
