#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "parcels/coverage.h"
#include "support/made_tile_layout.h"
#include "tiles/layout_defects.h"
#include "tiles/reconfiguration.h"

namespace plat::testing {

using tiles::Reconfiguration;
using tiles::TileId;
using tiles::TileLayout;

inline const tiles::Tile& tile_of(const TileLayout& layout, TileId id) {
  return layout.tiles.at(tiles::find_tile(layout, id).value());
}
inline Polygon land_of(const TileLayout& layout, TileId id) {
  return tiles::shape_of(layout, tile_of(layout, id));
}
inline Point middle_of(const TileLayout& layout, TileId id) {
  return centroid(land_of(layout, id));
}

/// The layout's invariants and no overlaps; else what is wrong.
inline std::string defect_of(const TileLayout& layout) {
  const auto defect = tiles::find_layout_defect(layout);
  return defect ? defect->message : "";
}

/// How many parts of the city nothing connects: no street, no common vertex.
inline std::size_t parts_of(const TileLayout& layout) {
  std::vector<std::size_t> root(layout.tiles.size() + layout.vertices.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  for (std::size_t t = 0; t < layout.tiles.size(); ++t) {
    for (const auto& ring : layout.tiles[t].rings) {
      for (const auto& corner : ring) root[find(layout.tiles.size() + corner.vertex)] = find(t);
    }
  }
  for (const auto& link : layout.links) root[find(link.a)] = find(link.b);
  std::vector<bool> is_root(root.size(), false);
  for (std::size_t t = 0; t < layout.tiles.size(); ++t) is_root[find(t)] = true;
  return static_cast<std::size_t>(std::ranges::count(is_root, true));
}

/// Whether the tiles of every block cover one piece of land without a hole in it, each point once;
/// else what is wrong.
inline std::string coverage_defect_of(const TileLayout& layout) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::map<std::uint32_t, std::vector<const tiles::Tile*>> blocks;
  for (const tiles::Tile& tile : layout.tiles) blocks[tile.block].push_back(&tile);
  for (const auto& [block, members] : blocks) {
    std::set<Edge> edges;
    std::vector<parcels::Parcel> parcels;
    for (const tiles::Tile* tile : members) {
      parcels.push_back({{tile->id.value}, tiles::shape_of(layout, *tile)});
      for (const auto& ring : tile->rings) {
        for (std::size_t i = 0; i < ring.size(); ++i)
          edges.emplace(ring[i].vertex, ring[(i + 1) % ring.size()].vertex);
      }
    }
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [from, to] : edges) {
      if (!edges.contains({to, from}) && !next.emplace(from, to).second)
        return fmt::format("block {} touches itself", block);
    }
    Polygon land;
    std::uint32_t at = next.begin()->first;
    do {
      land.outer.push_back(layout.vertices[at].at);
      at = next.at(at);
    } while (at != next.begin()->first);
    if (land.outer.size() != next.size()) return fmt::format("block {} has a hole", block);
    if (const auto defect = parcels::find_coverage_defect(land, parcels, 0.0))
      return fmt::format("block {}: {}", block, defect->message);
  }
  return "";
}

/// The objective, by nothing that the operations use.
inline double objective_of(const TileLayout& layout, const tiles::SolverOptions& options) {
  std::vector<Affine> placements;
  for (const tiles::Tile& tile : layout.tiles) placements.push_back(tile.placement);
  return tiles::measure_placements(tiles::graph_of(layout), std::move(placements), options)
      .objective;
}

/// Options under which tiles keep their size, for a city of a few blocks.
inline tiles::ReconfigurationOptions small_city_options() {
  tiles::ReconfigurationOptions options;
  options.reach_m = 60.0;
  options.solver.keep_size = 1.0;
  return options;
}

/// A layout whose four outermost tiles are pinned.
inline TileLayout with_pinned_corners(TileLayout layout) {
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const auto farthest =
          std::ranges::max_element(layout.tiles, {}, [&](const tiles::Tile& tile) {
            return dot(centroid(tiles::shape_of(layout, tile)), Point{x, y});
          });
      farthest->is_pinned = true;
    }
  }
  return layout;
}

}  // namespace plat::testing
