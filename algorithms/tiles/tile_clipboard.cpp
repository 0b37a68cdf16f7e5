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

/// The neighbours draw together over the tiles, one after the other.
Expected<Reconfiguration> close(const TileLayout& layout, std::span<const TileId> ids,
                                std::span<const std::uint32_t> tiles,
                                const ReconfigurationOptions& options) {
  const std::vector<Box> around = detail::boxes_of(layout, tiles, {});
  TileLayout changed = layout;
  for (const TileId id : ids) {
    const auto index = find_tile(changed, id);
    if (!index) continue;  // named twice
    auto closed = detail::without_land(changed, *index);
    if (!closed) return tl::unexpected(closed.error());
    changed = *std::move(closed);
  }
  const auto held = detail::held_tiles(changed, {}, around, options.reach_m);
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
                                      : close(layout, tiles, *indices, options);
}

}  // namespace plat::tiles
