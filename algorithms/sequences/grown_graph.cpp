#include "sequences/grown_graph.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace plat::sequences {
namespace {

/// (group, node) -> index of the state.
using StateNumbers = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

class GraphWriter {
 public:
  GraphWriter(const Consumption& consumption, const GrownStates& grown)
      : graph_(consumption.graph()), consumption_(consumption), grown_(grown) {}

  GrownGraph write() {
    for (const std::uint32_t group : grown_.order) add_states(group);
    for (const Terminal& entry : graph_.entries) mark_entry(entry);
    for (const auto& [key, number] : numbers_) {
      add_table_arcs(key.first, number);
      add_links(number);
    }
    std::ranges::stable_sort(out_.arcs, {}, &GrownGraph::Arc::from);
    return std::move(out_);
  }

 private:
  void add_states(std::uint32_t group) {
    const std::uint32_t zone = grown_.groups.zone(group);
    const auto forward = grown_.of_group(grown_.forward, group);
    const auto backward = grown_.of_group(grown_.backward, group);
    for (std::uint32_t local = 0; local < graph_.zones[zone].size; ++local) {
      GrownState state;
      state.is_from_front = has_bit(forward, local);
      state.is_from_end = has_bit(backward, local);
      if (!state.is_from_front && !state.is_from_end) continue;
      state.node = graph_.zones[zone].first_node + local;
      const auto consumed = grown_.groups.consumed(group);
      state.consumed.assign(consumed.begin(), consumed.end());
      const auto uses = graph_.uses(state.node);
      state.level = std::accumulate(consumed.begin(), consumed.end(), std::int64_t{0}) -
                    std::accumulate(uses.begin(), uses.end(), std::int64_t{0});
      state.is_alive = has_bit(grown_.of_group(grown_.alive, group), local);
      state.is_exit = consumption_.may_end(zone, consumed) &&
                      std::ranges::binary_search(graph_.exits, state.node, {}, &Terminal::node);
      numbers_.emplace(std::pair(group, state.node), out_.states.size());
      out_.states.push_back(std::move(state));
    }
  }

  void mark_entry(const Terminal& entry) {
    const std::uint32_t zone = consumption_.zone_of(entry.node);
    std::vector<Amount> consumed(graph_.dimension_count, 0);
    if (!consumption_.add(zone, consumed, graph_.uses(entry.node))) return;
    const auto state = numbers_.find({grown_.groups.find(zone, consumed), entry.node});
    if (state != numbers_.end()) out_.states[state->second].is_entry = true;
  }

  void add_table_arcs(std::uint32_t group, std::uint32_t tail) {
    const std::uint32_t zone = grown_.groups.zone(group);
    if (!graph_.zones[zone].table) return;
    const TransitionTable& table = graph_.tables[*graph_.zones[zone].table];
    const std::uint32_t local = consumption_.local(out_.states[tail].node);
    for (std::size_t arc = table.first[local]; arc < table.first[local + 1]; ++arc) {
      const std::uint32_t head = graph_.zones[zone].first_node + table.arcs[arc].head;
      std::vector<Amount> used(graph_.uses(head).begin(), graph_.uses(head).end());
      for (std::size_t d = 0; !table.arc_uses.empty() && d < used.size(); ++d)
        used[d] += table.arc_uses[arc * used.size() + d];
      std::vector<Amount> consumed = out_.states[tail].consumed;
      if (consumption_.add(zone, consumed, used))
        add_arc(tail, grown_.groups.find(zone, consumed), head, table.arcs[arc].cost);
    }
  }

  void add_links(std::uint32_t tail) {
    const auto [first, last] = consumption_.links_from(out_.states[tail].node);
    for (std::uint32_t link = first; link < last; ++link) {
      std::vector<Amount> consumed = out_.states[tail].consumed;
      if (!consumption_.follow(graph_.links[link], consumed)) continue;
      const std::uint32_t zone = consumption_.zone_of(graph_.links[link].to);
      add_arc(tail, grown_.groups.find(zone, consumed), graph_.links[link].to,
              graph_.links[link].cost);
    }
  }

  void add_arc(std::uint32_t tail, std::uint32_t group, std::uint32_t node, Cost cost) {
    const auto head = numbers_.find({group, node});
    if (head != numbers_.end()) out_.arcs.push_back({tail, head->second, cost});
  }

  const SearchGraph& graph_;
  const Consumption& consumption_;
  const GrownStates& grown_;
  StateNumbers numbers_;
  GrownGraph out_;
};

}  // namespace

Expected<GrownGraph> grown_graph(const SearchGraph& graph, const GrowthLimits& limits) {
  const Consumption consumption(graph);
  const AllZoneArcs arcs(graph);
  const auto grown = IntermediateGraphGrowth(consumption, arcs, limits).run();
  if (!grown) return tl::unexpected(grown.error());
  return GraphWriter(consumption, *grown).write();
}

}  // namespace plat::sequences
