#include "sequences/intermediate_graph.h"

#include <algorithm>
#include <bit>

namespace plat::sequences {

Expected<IntermediateGraph> IntermediateGraph::build(const SearchGraph& graph,
                                                     const GrowthLimits& limits) {
  auto consumption = std::make_unique<const Consumption>(graph);
  auto arcs = std::make_unique<const AllZoneArcs>(graph);
  auto states = IntermediateGraphGrowth(*consumption, *arcs, limits).run();
  if (!states) return tl::unexpected(states.error());
  return IntermediateGraph(graph, std::move(consumption), std::move(arcs), std::move(*states));
}

IntermediateGraph::IntermediateGraph(const SearchGraph& graph,
                                     std::unique_ptr<const Consumption> consumption,
                                     std::unique_ptr<const AllZoneArcs> arcs, GrownStates states)
    : graph_(&graph),
      consumption_(std::move(consumption)),
      arcs_(std::move(arcs)),
      states_(std::move(states)) {
  states_.forward = {};
  states_.backward = {};
  number_states();
}

void IntermediateGraph::number_states() {
  first_state_.assign(states_.groups.size(), 0);
  state_count_.assign(states_.groups.size(), 0);
  for (const std::uint32_t group : states_.order) {
    first_state_[group] = state_count();
    const std::uint32_t first_node = graph_->zones[states_.groups.zone(group)].first_node;
    for_each_bit(states_.of_group(states_.alive, group), [&](std::uint32_t local) {
      nodes_.push_back(first_node + local);
      groups_.push_back(group);
    });
    state_count_[group] = state_count() - first_state_[group];
  }
}

std::uint64_t IntermediateGraph::bytes() const {
  return states_.groups.bytes() + states_.alive.capacity() * sizeof(std::uint64_t) +
         states_.first_word.capacity() * sizeof(std::size_t) +
         (states_.order.capacity() + nodes_.capacity() + groups_.capacity() +
          first_state_.capacity() + state_count_.capacity()) *
             sizeof(std::uint32_t);
}

std::int64_t IntermediateGraph::level(std::uint32_t state) const {
  const auto amounts = consumed(state);
  const auto uses = graph_->uses(nodes_[state]);
  std::int64_t level = 0;
  for (std::size_t d = 0; d < amounts.size(); ++d) level += std::max(amounts[d] - uses[d], 0);
  return level;
}

std::uint32_t IntermediateGraph::target_group(std::uint32_t group, const ZoneArcs& arcs,
                                              std::uint32_t arc_class) const {
  const std::uint32_t zone = states_.groups.zone(group);
  const auto here = states_.groups.consumed(group);
  std::vector<Amount> amounts(here.begin(), here.end());
  if (!consumption_->add(zone, amounts, arcs.used(arc_class))) return StateGroups::kNone;
  return states_.groups.find(zone, amounts);
}

std::uint32_t IntermediateGraph::state_in(std::uint32_t group, std::uint32_t local) const {
  if (group == StateGroups::kNone) return kNoState;
  const NodeBits alive = states_.of_group(states_.alive, group);
  if (!has_bit(alive, local)) return kNoState;
  std::uint32_t state = first_state_[group];
  for (std::size_t word = 0; word < local / 64; ++word)
    state += static_cast<std::uint32_t>(std::popcount(alive[word]));
  const std::uint64_t below = (std::uint64_t{1} << (local % 64)) - 1;
  return state + static_cast<std::uint32_t>(std::popcount(alive[local / 64] & below));
}

std::uint32_t IntermediateGraph::target_state(std::uint32_t state, const Link& link) const {
  const auto here = consumed(state);
  std::vector<Amount> amounts(here.begin(), here.end());
  if (!consumption_->follow(link, amounts)) return kNoState;
  return state_in(states_.groups.find(consumption_->zone_of(link.to), amounts),
                  consumption_->local(link.to));
}

std::uint32_t IntermediateGraph::entry_state(const Terminal& entry) const {
  const std::uint32_t zone = consumption_->zone_of(entry.node);
  std::vector<Amount> amounts(graph_->dimension_count, 0);
  if (!consumption_->add(zone, amounts, graph_->uses(entry.node))) return kNoState;
  return state_in(states_.groups.find(zone, amounts), consumption_->local(entry.node));
}

std::optional<std::uint32_t> IntermediateGraph::exit_of(std::uint32_t state) const {
  const std::uint32_t node = nodes_[state];
  if (!consumption_->may_end(consumption_->zone_of(node), consumed(state))) return std::nullopt;
  const auto exit = std::ranges::lower_bound(graph_->exits, node, {}, &Terminal::node);
  if (exit == graph_->exits.end() || exit->node != node) return std::nullopt;
  return static_cast<std::uint32_t>(exit - graph_->exits.begin());
}

}  // namespace plat::sequences
