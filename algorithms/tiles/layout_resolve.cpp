#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/working_grid.h"
#include "tiles/layout_defects.h"
#include "tiles/layout_stiffening_internal.h"
#include "tiles/reconfiguration_internal.h"
#include "tiles/settling.h"
#include "tiles/tile_replacement_internal.h"

namespace plat::tiles::detail {
namespace {

bool is_on_map(const Box& box) {
  const auto within = [](double x) { return std::abs(x) < kGridExtent_m; };
  return box.is_empty() ||
         (within(box.min.x) && within(box.min.y) && within(box.max.x) && within(box.max.y));
}

/// The farthest that a corner goes from one placement to the other.
double displacement_m(const Tile& tile, const Affine& from, const Affine& to) {
  double farthest = 0.0;
  for (const auto& ring : tile.rings) {
    for (const Corner& corner : ring)
      farthest = std::max(farthest, distance(from(corner.rest), to(corner.rest)));
  }
  return farthest;
}

}  // namespace

Expected<std::vector<std::uint32_t>> indices_of(const TileLayout& layout,
                                                std::span<const TileId> ids) {
  if (ids.empty()) return fail(FailureCode::kUnknownEntity, "no tile is named");
  std::map<TileId, std::uint32_t> index;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) index.emplace(layout.tiles[i].id, i);
  std::set<std::uint32_t> out;
  for (const TileId id : ids) {
    const auto found = index.find(id);
    if (found == index.end())
      return fail(FailureCode::kUnknownEntity, fmt::format("there is no tile {}", id.value));
    out.insert(found->second);
  }
  return std::vector<std::uint32_t>(out.begin(), out.end());
}

std::vector<Box> boxes_of(const TileLayout& layout, std::span<const std::uint32_t> tiles,
                          const Targets& targets) {
  std::vector<Box> out;
  for (const std::uint32_t i : tiles) {
    out.push_back(box_of(layout, layout.tiles[i]));
    if (const auto target = targets.find(i); target != targets.end())
      out.push_back(box_at(layout.tiles[i], target->second));
  }
  return out;
}

Targets held_tiles(const TileLayout& layout, Targets targets, std::span<const Box> around,
                   const std::optional<double>& reach_m) {
  const auto is_reached = [&](const Tile& tile) {
    return !reach_m || is_within_reach(box_of(layout, tile), around, *reach_m);
  };
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    const Tile& tile = layout.tiles[i];
    if (tile.is_pinned || !is_reached(tile)) targets.emplace(i, tile.placement);
  }
  return targets;
}

Targets held_or_farthest(const TileLayout& layout, Targets held, std::span<const Box> around) {
  if (!held.empty() || around.empty()) return held;
  double farthest = 0.0;
  std::optional<std::uint32_t> tile;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    const Box box = box_of(layout, layout.tiles[i]);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Box& other : around) nearest = std::min(nearest, distance_m(box, other));
    if (nearest <= farthest) continue;
    farthest = nearest;
    tile = i;
  }
  if (tile) held.emplace(*tile, layout.tiles[*tile].placement);
  return held;
}

Expected<SolvedLayout> solved(TileLayout layout, const Targets& held, const SolverOptions& options,
                              std::span<const double> stiffness) {
  std::vector<std::uint32_t> indices;
  std::vector<Affine> targets;
  for (const auto& [tile, target] : held) {
    indices.push_back(tile);
    targets.push_back(target);
  }
  std::vector<Affine> resting;
  for (const Tile& tile : layout.tiles) resting.push_back(tile.placement);
  const TileGraph graph = graph_of(layout);
  const auto solver = LayoutSolver::make(stiffened(graph, stiffness), std::move(indices), options);
  if (!solver) return tl::unexpected(solver.error());
  auto solution = solver->solve(targets, resting);
  if (!solution) return tl::unexpected(solution.error());
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    Tile& tile = layout.tiles[i];
    Affine& placement = solution->placements[i];
    if (!is_on_map(box_at(tile, placement)))
      return fail(FailureCode::kOutOfRange, fmt::format("tile {} would leave the map, {} m wide",
                                                        tile.id.value, 2.0 * kGridExtent_m));
    if (!held.contains(i) && displacement_m(tile, tile.placement, placement) < kUnmoved_m)
      placement = tile.placement;
    tile.placement = placement;
  }
  if (!stiffness.empty())
    *solution = measure_placements(graph, std::move(solution->placements), options);
  return SolvedLayout{std::move(layout), *std::move(solution)};
}

Expected<TileLayout> settled_and_checked(TileLayout layout) {
  TileLayout out = settled(std::move(layout));
  if (auto defect = find_layout_defect(out)) return tl::unexpected(*std::move(defect));
  return out;
}

void compare(const TileLayout& before, const TileLayout& after, const LayoutSolution& solution,
             ReconfigurationReport& report) {
  std::map<TileId, const Tile*> old;
  for (const Tile& tile : before.tiles) old.emplace(tile.id, &tile);
  report.moved.clear();
  report.appeared.clear();
  for (const Tile& tile : after.tiles) {
    const auto found = old.find(tile.id);
    if (found == old.end()) {
      report.appeared.push_back(tile.id);
      continue;
    }
    if (found->second->placement != tile.placement) report.moved.push_back(tile.id);
    old.erase(found);
  }
  report.vanished.clear();
  for (const auto& [id, tile] : old) report.vanished.push_back(id);
  report.mean_property_gap_m = solution.mean_property_gap_m;
  report.mean_street_gap_m = solution.mean_street_gap_m;
  report.mean_deformation = solution.mean_deformation;
  report.largest_deformation =
      solution.deformations.empty() ? 0.0 : std::ranges::max(solution.deformations);
  report.objective = solution.objective;
}

Expected<Reconfiguration> reconfigured(const TileLayout& before, TileLayout changed,
                                       const Targets& held, const ReconfigurationOptions& options) {
  std::map<TileId, Affine> held_ids;  // replacements change indices
  for (const auto& [tile, target] : held) held_ids.emplace(changed.tiles[tile].id, target);
  auto outcome = solved(std::move(changed), held, options.solver);
  if (!outcome) return tl::unexpected(outcome.error());
  ReconfigurationReport report;
  report.rounds = 1;
  if (options.replacement)
    outcome =
        with_replacements(before, *std::move(outcome), held, *options.replacement, options, report);
  auto layout = settled_and_checked(outcome->layout);
  if (!layout && layout.error().code == FailureCode::kTilesOverlap) {
    auto stiffer = without_overlaps(*outcome, held_ids, options.solver);
    if (!stiffer) return tl::unexpected(layout.error());  // the first place is the operation's
    outcome = std::move(stiffer->solved);
    layout = std::move(stiffer->layout);
    report.stiffened = stiffer->tiles;
    report.rounds += stiffer->solutions;
  }
  if (!layout) return tl::unexpected(layout.error());
  compare(before, *layout, outcome->solution, report);
  return Reconfiguration{*std::move(layout), std::move(report)};
}

void drop_unused(TileLayout& layout) {
  std::vector<std::uint32_t> kept(layout.vertices.size(), 0);
  for (const Tile& tile : layout.tiles) {
    for (const auto& ring : tile.rings) {
      for (const Corner& corner : ring) kept[corner.vertex] = 1;
    }
  }
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < kept.size(); ++v) {
    if (kept[v] == 0) continue;
    layout.vertices[next] = layout.vertices[v];
    kept[v] = next++;
  }
  layout.vertices.resize(next);
  for (Tile& tile : layout.tiles) {
    for (auto& ring : tile.rings) {
      for (Corner& corner : ring) corner.vertex = kept[corner.vertex];
    }
  }
  std::erase_if(layout.links, [](const StreetLink& link) { return link.a == link.b; });
}

TileLayout without_tiles(const TileLayout& layout, std::span<const std::uint32_t> tiles) {
  TileLayout out;
  out.vertices = layout.vertices;
  out.next_id = layout.next_id;
  std::map<std::uint32_t, std::uint32_t> index;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    if (std::ranges::binary_search(tiles, i)) continue;
    index.emplace(i, static_cast<std::uint32_t>(out.tiles.size()));
    out.tiles.push_back(layout.tiles[i]);
  }
  for (const StreetLink& link : layout.links) {
    const auto a = index.find(link.a);
    const auto b = index.find(link.b);
    if (a == index.end() || b == index.end()) continue;
    out.links.push_back({a->second, link.rest_a, b->second, link.rest_b, link.width_m});
  }
  drop_unused(out);
  return out;
}

}  // namespace plat::tiles::detail
