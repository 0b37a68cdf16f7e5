#include <fmt/format.h>

#include "tiles/reconfiguration_internal.h"

namespace plat::tiles {
namespace {

/// The layout as it is, with its errors measured.
Reconfiguration unchanged(const TileLayout& before, TileLayout layout,
                          const ReconfigurationOptions& options) {
  std::vector<Affine> placements;
  for (const Tile& tile : layout.tiles) placements.push_back(tile.placement);
  const LayoutSolution errors =
      measure_placements(graph_of(layout), std::move(placements), options.solver);
  Reconfiguration out{std::move(layout), {}};
  detail::compare(before, out.layout, errors, out.report);
  return out;
}

}  // namespace

Expected<Reconfiguration> move_tiles(const TileLayout& layout, std::span<const TileId> tiles,
                                     const Affine& motion, const ReconfigurationOptions& options) {
  const auto indices = detail::indices_of(layout, tiles);
  if (!indices) return tl::unexpected(indices.error());
  if (!motion.is_finite() || motion.determinant() <= 0.0)
    return fail(FailureCode::kOutOfRange,
                fmt::format("a motion with determinant {}: it must be finite and above 0",
                            motion.determinant()));
  TileLayout changed = layout;
  detail::Targets targets;
  for (const std::uint32_t i : *indices) {
    changed.tiles[i].is_pinned = true;
    targets.emplace(i, motion * layout.tiles[i].placement);
  }
  if (motion == Affine{}) return unchanged(layout, std::move(changed), options);
  const auto around = detail::boxes_of(layout, *indices, targets);
  const auto held = detail::held_tiles(changed, std::move(targets), around, options.reach_m);
  return detail::reconfigured(layout, std::move(changed), held, options);
}

Expected<Reconfiguration> relax(const TileLayout& layout, const ReconfigurationOptions& options) {
  return detail::reconfigured(layout, layout, detail::held_tiles(layout, {}, {}, std::nullopt),
                              options);
}

Expected<TileLayout> unpin_tiles(const TileLayout& layout, std::span<const TileId> tiles) {
  const auto indices = detail::indices_of(layout, tiles);
  if (!indices) return tl::unexpected(indices.error());
  TileLayout out = layout;
  for (const std::uint32_t i : *indices) out.tiles[i].is_pinned = false;
  return out;
}

}  // namespace plat::tiles
