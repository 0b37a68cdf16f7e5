#include "sequences/intermediate_graph_distances.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace plat::sequences {
namespace {

/// One pass over the groups, last to first.
class Sweep {
 public:
  explicit Sweep(const IntermediateGraph& graph) : graph_(graph) {
    result_.cost.assign(graph.state_count(), kUnreachable);
  }

  DistancesToEnd run() {
    const auto order = graph_.group_order();
    for (auto group = order.rbegin(); group != order.rend(); ++group) settle(*group);
    return std::move(result_);
  }

 private:
  void settle(std::uint32_t group) {
    const auto [first, last] = graph_.states_of(group);
    if (first == last) return;
    for (std::uint32_t state = first; state < last; ++state) leave(state);
    const ZoneArcs* arcs = graph_.arcs_of_zone(graph_.zone_of_group(group));
    if (arcs == nullptr) return;
    if (arcs->is_by_head())
      relax_by_head(group, *arcs);
    else
      relax_by_arc(group, *arcs);
    if (has_inner_arcs_) settle_inner(group, *arcs);
  }

  /// Exits and links.
  void leave(std::uint32_t state) {
    const SearchGraph& graph = graph_.search_graph();
    Cost& best = result_.cost[state];
    if (const auto exit = graph_.exit_of(state)) best = graph.exits[*exit].cost;
    const auto [first, last] = graph_.links_from(graph_.node(state));
    for (std::uint32_t link = first; link < last; ++link) {
      const std::uint32_t head = graph_.target_state(state, graph.links[link]);
      if (head == IntermediateGraph::kNoState) continue;
      best = std::min(best, graph.links[link].cost + result_.cost[head]);
      ++result_.arcs_relaxed;
    }
  }

  /// Every node is one state of one group, seen from here: its distance is looked up once.
  void relax_by_head(std::uint32_t group, const ZoneArcs& arcs) {
    const TransitionTable& table = arcs.table();
    targets_.clear();
    for (std::uint32_t c = 0; c < arcs.class_count(); ++c)
      targets_.push_back(graph_.target_group(group, arcs, c));
    has_inner_arcs_ = std::ranges::find(targets_, group) != targets_.end();
    beyond_.assign(table.node_count(), kUnreachable);
    for (std::uint32_t head = 0; head < table.node_count(); ++head) {
      const std::uint32_t target = targets_[arcs.class_of_head(head)];
      if (target == group) continue;
      const std::uint32_t state = graph_.state_in(target, head);
      if (state != IntermediateGraph::kNoState) beyond_[head] = result_.cost[state];
    }
    const std::uint32_t first_node = first_node_of(group);
    const auto [first, last] = graph_.states_of(group);
    for (std::uint32_t state = first; state < last; ++state) {
      const std::uint32_t tail = graph_.node(state) - first_node;
      Cost best = result_.cost[state];
      for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc)
        best = std::min(best, table.arcs[arc].cost + beyond_[table.arcs[arc].head]);
      result_.cost[state] = best;
      result_.arcs_relaxed += table.first[tail + 1] - table.first[tail];
    }
  }

  void relax_by_arc(std::uint32_t group, const ZoneArcs& arcs) {
    const TransitionTable& table = arcs.table();
    const std::uint32_t first_node = first_node_of(group);
    const auto [first, last] = graph_.states_of(group);
    has_inner_arcs_ = false;
    for (std::uint32_t state = first; state < last; ++state) {
      const std::uint32_t tail = graph_.node(state) - first_node;
      for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc) {
        const std::uint32_t target = graph_.target_group(group, arcs, arcs.class_of(arc));
        const std::uint32_t head = graph_.state_in(target, table.arcs[arc].head);
        has_inner_arcs_ = has_inner_arcs_ || target == group;
        if (head == IntermediateGraph::kNoState || target == group) continue;
        result_.cost[state] =
            std::min(result_.cost[state], table.arcs[arc].cost + result_.cost[head]);
        ++result_.arcs_relaxed;
      }
    }
  }

  /// Dijkstra's algorithm against the arcs that stay in the group.
  void settle_inner(std::uint32_t group, const ZoneArcs& arcs) {
    using Label = std::pair<Cost, std::uint32_t>;
    std::priority_queue<Label, std::vector<Label>, std::greater<>> open;
    const auto [first, last] = graph_.states_of(group);
    for (std::uint32_t state = first; state < last; ++state)
      if (result_.cost[state] < kUnreachable) open.emplace(result_.cost[state], state);
    const std::uint32_t first_node = first_node_of(group);
    while (!open.empty()) {
      const auto [cost, head] = open.top();
      open.pop();
      if (cost > result_.cost[head]) continue;
      for (const auto& incoming : arcs.arcs_into(graph_.node(head) - first_node)) {
        const std::uint32_t tail = graph_.state_in(group, incoming.tail);
        if (tail == IntermediateGraph::kNoState) continue;
        const Cost longer = cost + arcs.table().arcs[incoming.arc].cost;
        if (longer >= result_.cost[tail]) continue;
        if (graph_.target_group(group, arcs, arcs.class_of(incoming.arc)) != group) continue;
        result_.cost[tail] = longer;
        open.emplace(longer, tail);
        ++result_.arcs_relaxed;
      }
    }
  }

  [[nodiscard]] std::uint32_t first_node_of(std::uint32_t group) const {
    return graph_.search_graph().zones[graph_.zone_of_group(group)].first_node;
  }

  const IntermediateGraph& graph_;
  DistancesToEnd result_;
  std::vector<std::uint32_t> targets_;  ///< by class
  std::vector<Cost> beyond_;            ///< by head
  bool has_inner_arcs_ = false;
};

}  // namespace

DistancesToEnd distances_to_end(const IntermediateGraph& graph) { return Sweep(graph).run(); }

}  // namespace plat::sequences
