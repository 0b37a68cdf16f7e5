#include <algorithm>
#include <set>
#include <utility>

#include "tiles/layout_defects.h"
#include "tiles/layout_stiffening_internal.h"
#include "tiles/settling.h"

namespace plat::tiles::detail {
namespace {

/// Solutions before an operation is refused, and what a tile's stiffness is multiplied by each
/// time: 4096 in the end (ADR 0039).
constexpr int kStiffenings = 6;
constexpr double kStiffer = 4.0;

Targets by_index(const TileLayout& layout, const std::map<TileId, Affine>& held) {
  Targets out;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    const auto target = held.find(layout.tiles[i].id);
    if (target != held.end()) out.emplace(i, target->second);
  }
  return out;
}

/// Tiles with a defect and those that they are joined to.
std::set<std::uint32_t> tiles_around(const std::vector<TileDefect>& defects,
                                     const TileGraph& graph) {
  std::set<std::uint32_t> defective;
  for (const TileDefect& defect : defects) {
    defective.insert(defect.tile);
    if (defect.other) defective.insert(*defect.other);
  }
  std::set<std::uint32_t> out = defective;
  for (const Joint& joint : graph.joints) {
    if (defective.contains(joint.a)) out.insert(joint.b);
    if (defective.contains(joint.b)) out.insert(joint.a);
  }
  return out;
}

}  // namespace

TileGraph stiffened(TileGraph graph, std::span<const double> stiffness) {
  if (stiffness.empty()) return graph;
  for (std::size_t t = 0; t < graph.tiles.size(); ++t) graph.tiles[t].rigidity *= stiffness[t];
  for (Joint& joint : graph.joints)
    joint.weight *= std::max(stiffness[joint.a], stiffness[joint.b]);
  return graph;
}

Expected<StiffenedLayout> without_overlaps(const SolvedLayout& solution,
                                           const std::map<TileId, Affine>& held,
                                           const SolverOptions& options) {
  const Targets targets = by_index(solution.layout, held);
  const TileGraph graph = graph_of(solution.layout);
  std::vector<double> stiffness(graph.tiles.size(), 1.0);
  std::vector<TileDefect> defects = find_tile_defects(settled(solution.layout));
  expects(!defects.empty(), "tiles of the solution overlap");
  for (int round = 0; round < kStiffenings && !defects.empty(); ++round) {
    for (const std::uint32_t tile : tiles_around(defects, graph)) stiffness[tile] *= kStiffer;
    auto stiffer = solved(solution.layout, targets, options, stiffness);
    if (!stiffer) return tl::unexpected(stiffer.error());
    TileLayout layout = settled(stiffer->layout);
    defects = find_tile_defects(layout);
    if (!defects.empty()) continue;
    const auto is_stiffer = [](double weight) { return weight > 1.0; };
    const auto tiles = static_cast<std::size_t>(std::ranges::count_if(stiffness, is_stiffer));
    return StiffenedLayout{*std::move(stiffer), std::move(layout), tiles,
                           static_cast<std::size_t>(round) + 1};
  }
  return tl::unexpected(std::move(defects.front().failure));
}

}  // namespace plat::tiles::detail
