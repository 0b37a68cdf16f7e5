#include "sequences/sequence_path.h"

#include <algorithm>
#include <string>

namespace plat::sequences {
namespace {

/// A walker along a path: what has been consumed and paid so far, and the first thing that is
/// wrong.
struct Walk {
  const SearchGraph& graph;
  std::vector<std::int64_t> consumed;
  Cost cost = 0;
  std::string wrong;

  void enter(const Zone& zone, std::uint32_t node, std::span<const Amount> arc_uses) {
    const auto uses = graph.uses(node);
    for (std::size_t d = 0; d < consumed.size(); ++d) {
      consumed[d] += uses[d] + (arc_uses.empty() ? 0 : arc_uses[d]);
      if (zone.bounds[d].max != kUnbounded && consumed[d] > zone.bounds[d].max && wrong.empty())
        wrong = "dimension " + std::to_string(d) + " exceeds its maximum at node " +
                std::to_string(node);
    }
  }
  void expect_minimum(const Zone& zone, std::size_t dimension) {
    if (consumed[dimension] < zone.bounds[dimension].min && wrong.empty())
      wrong = "dimension " + std::to_string(dimension) + " stays below its minimum";
  }
  void leave(const Zone& from, const Zone& to) {
    for (std::size_t d = 0; d < consumed.size(); ++d) {
      if (!to.resets[d]) continue;
      expect_minimum(from, d);
      consumed[d] = 0;
    }
  }
};

void follow_link(Walk& walk, const Step& step, std::uint32_t tail) {
  const SearchGraph& graph = walk.graph;
  if (step.arc >= graph.links.size() || graph.links[step.arc].from != tail ||
      graph.links[step.arc].to != step.node) {
    walk.wrong = "no such link";
    return;
  }
  walk.cost += graph.links[step.arc].cost;
  const Zone& zone = graph.zones[graph.zone_of(step.node)];
  walk.leave(graph.zones[graph.zone_of(tail)], zone);
  walk.enter(zone, step.node, {});
}

void follow_arc(Walk& walk, const Step& step, std::uint32_t tail) {
  const SearchGraph& graph = walk.graph;
  const Zone& zone = graph.zones[graph.zone_of(step.node)];
  const std::uint32_t local = tail - zone.first_node;
  if (!zone.table || step.arc < graph.tables[*zone.table].first[local] ||
      step.arc >= graph.tables[*zone.table].first[local + 1] ||
      graph.tables[*zone.table].arcs[step.arc].head + zone.first_node != step.node) {
    walk.wrong = "no such arc";
    return;
  }
  const TransitionTable& table = graph.tables[*zone.table];
  walk.cost += table.arcs[step.arc].cost;
  std::span<const Amount> uses;
  if (!table.arc_uses.empty())
    uses = {table.arc_uses.data() + std::size_t{step.arc} * graph.dimension_count,
            graph.dimension_count};
  walk.enter(zone, step.node, uses);
}

}  // namespace

std::string why_not_feasible(const SearchGraph& graph, const SequencePath& path) {
  Walk walk{graph, std::vector<std::int64_t>(graph.dimension_count, 0), 0, {}};
  if (path.steps.empty()) return "no steps";
  const Step& start = path.steps.front();
  if (start.arc >= graph.entries.size() || graph.entries[start.arc].node != start.node)
    return "no such entry";
  walk.cost = graph.entries[start.arc].cost;
  walk.enter(graph.zones[graph.zone_of(start.node)], start.node, {});
  for (std::size_t i = 1; i < path.steps.size() && walk.wrong.empty(); ++i) {
    const std::uint32_t tail = path.steps[i - 1].node;
    if (path.steps[i].node >= graph.node_count()) return "no such node";
    if (graph.zone_of(tail) == graph.zone_of(path.steps[i].node))
      follow_arc(walk, path.steps[i], tail);
    else
      follow_link(walk, path.steps[i], tail);
  }
  if (!walk.wrong.empty()) return walk.wrong;
  const std::uint32_t last = path.steps.back().node;
  const auto exit = std::ranges::find(graph.exits, last, &Terminal::node);
  if (exit == graph.exits.end()) return "the last node is no exit";
  walk.cost += exit->cost;
  const Zone& zone = graph.zones[graph.zone_of(last)];
  for (std::size_t d = 0; d < walk.consumed.size(); ++d) walk.expect_minimum(zone, d);
  if (!walk.wrong.empty()) return walk.wrong;
  if (walk.cost != path.cost)
    return "costs " + std::to_string(walk.cost) + ", not " + std::to_string(path.cost);
  return {};
}

}  // namespace plat::sequences
