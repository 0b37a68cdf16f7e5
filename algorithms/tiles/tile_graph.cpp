#include "tiles/tile_graph.h"

#include <algorithm>
#include <cmath>

namespace plat::tiles {
namespace {

/// A smaller tile counts as this large, so that its deformation equations stay finite.
constexpr double kRadiusMin_m = 1e-3;

TileNode node_of(const Tile& tile) {
  const Polygon rest = rest_shape_of(tile);
  TileNode node{centroid(rest), kRadiusMin_m};
  double sum = 0.0;
  std::size_t count = 0;
  for (const auto& ring : tile.rings) {
    for (const Corner& corner : ring) {
      sum += squared_length(corner.rest - node.centroid);
      ++count;
    }
  }
  if (count > 0)
    node.radius_m = std::max(kRadiusMin_m, std::sqrt(sum / static_cast<double>(count)));
  return node;
}

}  // namespace

TileGraph graph_of(const TileLayout& layout) {
  TileGraph graph;
  graph.tiles.reserve(layout.tiles.size());
  struct Use {
    std::uint32_t tile;
    Point rest;
  };
  std::vector<std::vector<Use>> uses(layout.vertices.size());
  for (std::uint32_t t = 0; t < layout.tiles.size(); ++t) {
    graph.tiles.push_back(node_of(layout.tiles[t]));
    for (const auto& ring : layout.tiles[t].rings) {
      for (const Corner& corner : ring) {
        if (layout.vertices.at(corner.vertex).is_joint)
          uses[corner.vertex].push_back({t, corner.rest});
      }
    }
  }
  for (const std::vector<Use>& at : uses) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t j = i + 1; j < at.size(); ++j) {
        if (at[i].tile == at[j].tile) continue;  // a tile that meets itself in a point
        graph.joints.push_back(
            {at[i].tile, at[i].rest, at[j].tile, at[j].rest, JointKind::kProperty});
      }
    }
  }
  for (const StreetLink& link : layout.links)
    graph.joints.push_back({link.a, link.rest_a, link.b, link.rest_b, JointKind::kStreet});
  return graph;
}

}  // namespace plat::tiles
