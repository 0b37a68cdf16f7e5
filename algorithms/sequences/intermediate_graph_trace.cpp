#include "sequences/intermediate_graph_trace.h"

#include <algorithm>
#include <map>
#include <utility>

namespace plat::sequences {
namespace {

/// Lists what a growth left.
class Tracer {
 public:
  Tracer(const SearchGraph& graph, const Consumption& consumption, const GrownStates& grown)
      : graph_(graph), consumption_(consumption), grown_(grown) {}

  IntermediateGraphTrace run() {
    for (const std::uint32_t group : grown_.order) add_states(group);
    for (const auto& [state, index] : index_) add_arcs(state.first, state.second, index);
    std::ranges::stable_sort(trace_.arcs, {}, &TracedArc::from);
    return std::move(trace_);
  }

 private:
  void add_states(std::uint32_t group) {
    const Zone& zone = graph_.zones[grown_.groups.zone(group)];
    const NodeBits forward = grown_.of_group(grown_.forward, group);
    const NodeBits backward = grown_.of_group(grown_.backward, group);
    const NodeBits alive = grown_.of_group(grown_.alive, group);
    for (std::uint32_t local = 0; local < zone.size; ++local) {
      const bool is_front = has_bit(forward, local);
      const bool is_back = has_bit(backward, local);
      if (!is_front && !is_back) continue;
      TracedState state = describe(group, zone.first_node + local);
      state.side = !is_back    ? TracedState::Side::kFront
                   : !is_front ? TracedState::Side::kBack
                               : TracedState::Side::kBoth;
      state.is_pruned = !has_bit(alive, local);
      index_[{group, state.node}] = static_cast<std::uint32_t>(trace_.states.size());
      trace_.states.push_back(std::move(state));
    }
  }

  [[nodiscard]] TracedState describe(std::uint32_t group, std::uint32_t node) const {
    const std::uint32_t zone = grown_.groups.zone(group);
    const auto consumed = grown_.groups.consumed(group);
    TracedState state;
    state.node = node;
    state.consumed.assign(consumed.begin(), consumed.end());
    std::vector<Amount> at_entry(consumed.size(), 0);
    const auto uses = graph_.uses(node);
    state.is_entry =
        std::ranges::find(graph_.entries, node, &Terminal::node) != graph_.entries.end() &&
        consumption_.add(zone, at_entry, uses) && at_entry == state.consumed;
    state.is_exit = std::ranges::find(graph_.exits, node, &Terminal::node) != graph_.exits.end() &&
                    consumption_.may_end(zone, consumed);
    for (std::size_t d = 0; d < consumed.size(); ++d)
      state.level += std::max(consumed[d] - uses[d], 0);
    return state;
  }

  void add_arcs(std::uint32_t group, std::uint32_t node, std::uint32_t from) {
    const std::uint32_t zone_index = grown_.groups.zone(group);
    const Zone& zone = graph_.zones[zone_index];
    std::vector<Amount> consumed;
    const auto begin = [&] {
      const auto here = grown_.groups.consumed(group);
      consumed.assign(here.begin(), here.end());
    };
    const auto end = [&](std::uint32_t head, Cost cost) {
      const auto target =
          index_.find({grown_.groups.find(consumption_.zone_of(head), consumed), head});
      if (target != index_.end()) trace_.arcs.push_back({from, target->second, cost});
    };
    if (zone.table) {
      const TransitionTable& table = graph_.tables[*zone.table];
      const std::uint32_t local = node - zone.first_node;
      for (std::uint32_t arc = table.first[local]; arc < table.first[local + 1]; ++arc) {
        begin();
        if (consumption_.follow_arc(zone_index, arc, consumed))
          end(zone.first_node + table.arcs[arc].head, table.arcs[arc].cost);
      }
    }
    const auto [first, last] = consumption_.links_from(node);
    for (std::uint32_t link = first; link < last; ++link) {
      begin();
      if (consumption_.follow(graph_.links[link], consumed))
        end(graph_.links[link].to, graph_.links[link].cost);
    }
  }

  const SearchGraph& graph_;
  const Consumption& consumption_;
  const GrownStates& grown_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> index_;  ///< (group, node)
  IntermediateGraphTrace trace_;
};

}  // namespace

Expected<IntermediateGraphTrace> trace_intermediate_graph(const SearchGraph& graph,
                                                          const GrowthLimits& limits) {
  const Consumption consumption(graph);
  const AllZoneArcs arcs(graph);
  const auto grown = IntermediateGraphGrowth(consumption, arcs, limits).run();
  if (!grown) return tl::unexpected(grown.error());
  return Tracer(graph, consumption, *grown).run();
}

}  // namespace plat::sequences
