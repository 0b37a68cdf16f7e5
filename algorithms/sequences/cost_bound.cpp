#include <algorithm>
#include <vector>

#include "sequences/layer_plan.h"

namespace plat::sequences {
namespace {

Cost saturating_add(Cost a, Cost b) { return std::min(kInfinite<Cost>, a + b); }

Cost saturating_product(std::uint64_t a, Cost b) {
  std::int64_t product = 0;
  if (a > static_cast<std::uint64_t>(kInfinite<Cost>) ||
      __builtin_mul_overflow(static_cast<std::int64_t>(a), b, &product))
    return kInfinite<Cost>;
  return std::min(kInfinite<Cost>, product);
}

/// No best path takes more arcs than this inside the zone: every `least` quanta one arc at most, or
/// every node once between two rows.
std::uint64_t max_arcs(const Zone& zone, const ZoneLayers& layers) {
  const std::size_t width = layers.highest.size();
  std::uint64_t span = 1;
  for (std::size_t d = 0; d < width; ++d)
    span += static_cast<std::uint64_t>(layers.highest[d] - layers.lowest[d]);
  std::uint64_t most = span * zone.size;
  for (std::size_t d = 0; d < width; ++d) {
    if (layers.saturates[d]) continue;
    Amount least = kUnbounded;
    for (std::size_t c = 0; c < layers.class_count; ++c)
      least = std::min(least, layers.class_uses[c * width + d]);
    if (least == 0) continue;
    most = std::min(most, static_cast<std::uint64_t>(layers.highest[d] - layers.lowest[d]) /
                                  static_cast<std::uint64_t>(least) +
                              1);
  }
  return most;
}

Cost largest_cost(const TransitionTable& table) {
  Cost largest = 0;
  for (const auto& arc : table.arcs) largest = std::max(largest, arc.cost);
  return largest;
}

}  // namespace

Cost path_cost_bound(const SearchGraph& graph, const LayerPlan& plan) {
  std::vector<Cost> dearest;
  for (const TransitionTable& table : graph.tables) dearest.push_back(largest_cost(table));
  Cost ends = 0;
  for (const Terminal& entry : graph.entries) ends = std::max(ends, entry.cost);
  Cost bound = ends;
  ends = 0;
  for (const Terminal& exit : graph.exits) ends = std::max(ends, exit.cost);
  bound = saturating_add(bound, ends);
  for (std::size_t z = 0; z < graph.zones.size(); ++z) {
    const ZoneLayers& layers = plan.zones[z];
    Cost link = 0;
    for (std::uint32_t l = layers.first_link; l < layers.last_link; ++l)
      link = std::max(link, graph.links[l].cost);
    bound = saturating_add(bound, link);
    if (layers.row_count == 0 || !graph.zones[z].table) continue;
    bound = saturating_add(bound, saturating_product(max_arcs(graph.zones[z], layers),
                                                     dearest[*graph.zones[z].table]));
  }
  return saturating_add(bound, 1);
}

}  // namespace plat::sequences
