#include <algorithm>

#include "tiles/reconfiguration_internal.h"
#include "tiles/tile_closing_internal.h"
#include "tiles/tile_outline_internal.h"

namespace plat::tiles {
namespace {

std::vector<std::uint32_t> all_but(const TileLayout& layout, std::span<const std::uint32_t> tiles) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    if (!std::ranges::binary_search(tiles, i)) out.push_back(i);
  }
  return out;
}

/// The tiles' land remains, as tiles of nobody.
Expected<Reconfiguration> vacate(const TileLayout& layout, std::span<const std::uint32_t> tiles,
                                 const ReconfigurationOptions& options) {
  TileLayout changed = layout;
  for (const std::uint32_t i : tiles) {
    Tile& tile = changed.tiles[i];
    tile.id = {changed.next_id++};
    tile.source_id.clear();
    tile.zone = kVacantZone;
    tile.is_pinned = false;
  }
  std::vector<Affine> placements;
  for (const Tile& tile : changed.tiles) placements.push_back(tile.placement);
  const LayoutSolution errors =
      measure_placements(graph_of(changed), std::move(placements), options.solver);
  Reconfiguration out{std::move(changed), {}};
  detail::compare(layout, out.layout, errors, out.report);
  return out;
}

/// The tiles as one with their outline, which stands in the place of the first.
TileLayout with_united(const TileLayout& layout, const std::vector<std::uint32_t>& tiles,
                       const std::vector<detail::OutlineEdge>& outline) {
  TileLayout out = layout;
  Tile& first = out.tiles[tiles.front()];
  first.placement = {};
  first.rings.assign(1, {});
  for (const detail::OutlineEdge& edge : outline)
    first.rings.front().push_back({edge.vertex, layout.vertices[edge.vertex].at});
  const auto unite = [&](std::uint32_t& tile, Point& rest) {
    if (!std::ranges::binary_search(tiles, tile)) return;
    rest = layout.tiles[tile].placement(rest);
    tile = tiles.front();
  };
  for (StreetLink& link : out.links) {
    unite(link.a, link.rest_a);
    unite(link.b, link.rest_b);
  }
  return detail::without_tiles(out, std::span(tiles).subspan(1));
}

/// The layout without land that is one piece: closed at once where its outline is one ring, else
/// tile by tile.
Expected<TileLayout> closed(const TileLayout& layout, const std::vector<TileId>& piece) {
  const auto indices = detail::indices_of(layout, piece);
  if (!indices) return tl::unexpected(indices.error());
  const bool has_holes = std::ranges::any_of(
      *indices, [&](std::uint32_t i) { return layout.tiles[i].rings.size() > 1; });
  const auto outline = detail::outline_of(layout, *indices);
  if (outline && indices->size() > 1 && !has_holes) {
    const TileLayout united = with_united(layout, *indices, *outline);
    const TileId id = layout.tiles[indices->front()].id;
    if (auto out = detail::without_land(united, *find_tile(united, id))) return out;
  }
  TileLayout out = layout;
  for (const TileId id : piece) {
    auto without = detail::without_land(out, *find_tile(out, id));
    if (!without) return without;
    out = *std::move(without);
  }
  return out;
}

/// The neighbours draw together over the tiles.
Expected<Reconfiguration> close(const TileLayout& layout, std::span<const std::uint32_t> tiles,
                                const ReconfigurationOptions& options) {
  const TileLayout land = detail::without_tiles(layout, all_but(layout, tiles));
  TileLayout changed = layout;
  for (const auto& members : detail::connected_tiles(land)) {
    std::vector<TileId> piece;
    for (const std::uint32_t i : members) piece.push_back(land.tiles[i].id);
    auto without = closed(changed, piece);
    if (!without) return tl::unexpected(without.error());
    changed = *std::move(without);
  }
  const std::vector<Box> around = detail::boxes_of(layout, tiles, {});
  const auto held = detail::held_or_farthest(
      changed, detail::held_tiles(changed, {}, around, options.reach_m), around);
  return detail::reconfigured(layout, std::move(changed), held, options);
}

}  // namespace

Expected<TileGroup> copy_tiles(const TileLayout& layout, std::span<const TileId> tiles) {
  const auto indices = detail::indices_of(layout, tiles);
  if (!indices) return tl::unexpected(indices.error());
  const std::vector<std::uint32_t> others = all_but(layout, *indices);
  TileGroup out{detail::without_tiles(layout, others), {}};
  const detail::EdgeMap beyond = detail::edges_of(layout, others);
  for (std::size_t k = 0; k < indices->size(); ++k) {
    Tile& copy = out.tiles.tiles[k];
    copy.is_pinned = false;
    for (std::size_t r = 0; r < copy.rings.size(); ++r) {
      const auto& ring = layout.tiles[(*indices)[k]].rings[r];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t next = (i + 1) % ring.size();
        if (beyond.contains({ring[next].vertex, ring[i].vertex}))
          out.property_edges.emplace_back(copy.rings[r][i].vertex, copy.rings[r][next].vertex);
      }
    }
  }
  std::ranges::sort(out.property_edges);
  return out;
}

Expected<Reconfiguration> cut_tiles(const TileLayout& layout, std::span<const TileId> tiles,
                                    VacatedLand land, const ReconfigurationOptions& options) {
  const auto indices = detail::indices_of(layout, tiles);
  if (!indices) return tl::unexpected(indices.error());
  return land == VacatedLand::kVacant ? vacate(layout, *indices, options)
                                      : close(layout, *indices, options);
}

}  // namespace plat::tiles
