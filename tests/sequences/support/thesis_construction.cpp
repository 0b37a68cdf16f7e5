#include "sequences/support/thesis_construction.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>

namespace plat::testing {
namespace {

using sequences::Amount;
using sequences::SearchGraph;
using Vector = std::vector<Amount>;

std::int64_t sum(const Vector& vector) {
  return std::accumulate(vector.begin(), vector.end(), std::int64_t{0});
}

std::optional<Vector> plus(const SearchGraph& graph, Vector consumed, std::uint32_t element) {
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    consumed[d] += graph.uses(element)[d];
    if (consumed[d] > graph.zones.front().bounds[d].max) return std::nullopt;
  }
  return consumed;
}

std::optional<Vector> minus(const SearchGraph& graph, Vector consumed, std::uint32_t element) {
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    consumed[d] -= graph.uses(element)[d];
    if (consumed[d] < 0) return std::nullopt;
  }
  return consumed;
}

std::vector<std::vector<std::uint32_t>> successors(const SearchGraph& graph, bool is_reversed) {
  std::vector<std::vector<std::uint32_t>> out(graph.node_count());
  if (!graph.zones.front().table) return out;
  const auto& table = graph.tables[*graph.zones.front().table];
  for (std::uint32_t tail = 0; tail < graph.node_count(); ++tail)
    for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc) {
      const std::uint32_t head = table.arcs[arc].head;
      out[is_reversed ? head : tail].push_back(is_reversed ? tail : head);
    }
  return out;
}

ThesisNode node_at(const SearchGraph& graph, std::uint32_t element, const Vector& consumed) {
  const auto uses = graph.uses(element);
  return {element, sum(consumed) - sum(Vector(uses.begin(), uses.end())), consumed};
}

class Construction {
 public:
  Construction(const SearchGraph& graph, const ThesisReading& reading)
      : graph_(graph), reading_(reading) {}

  ThesisGraph run() {
    initialise();
    while (!has_ended()) {
      if (!forward_.empty()) expand_forward();
      if (!backward_.empty() && !has_ended()) expand_backward();
    }
    ThesisGraph result{nodes_.size(), {}};
    result.nodes = prune();
    return result;
  }

 private:
  using Queue = std::multimap<Vector, ThesisNode>;

  void initialise() {
    const Vector zero(graph_.dimension_count, 0);
    for (const auto& entry : graph_.entries)
      if (const auto consumed = plus(graph_, zero, entry.node))
        create_forward(node_at(graph_, entry.node, *consumed));
    for (const auto& exit : graph_.exits) {
      for_each_end([&](const Vector& consumed) {
        if (minus(graph_, consumed, exit.node))
          create_backward(node_at(graph_, exit.node, consumed));
      });
    }
  }

  template <class Visit>
  void for_each_end(Visit visit) const {
    const auto& bounds = graph_.zones.front().bounds;
    Vector consumed;
    const std::function<void()> choose = [&] {
      if (consumed.size() == bounds.size()) return visit(consumed);
      const auto& range = bounds[consumed.size()];
      for (Amount amount = range.min; amount <= range.max; ++amount) {
        consumed.push_back(amount);
        choose();
        consumed.pop_back();
      }
    };
    choose();
  }

  [[nodiscard]] Vector before(const ThesisNode& node) const {
    return *minus(graph_, node.consumed, node.element);
  }

  void create_forward(const ThesisNode& node) {
    const bool is_new = nodes_.insert(node).second;
    if (is_both_ways() ? created_forward_.insert(node).second : is_new)
      forward_.emplace(node.consumed, node);
  }
  void create_backward(const ThesisNode& node) {
    const bool is_new = nodes_.insert(node).second;
    const bool by_consumed = reading_.backward_order == ThesisReading::BackwardOrder::kConsumed;
    if (is_both_ways() ? created_backward_.insert(node).second : is_new)
      backward_.emplace(by_consumed ? node.consumed : before(node), node);
  }
  [[nodiscard]] bool is_both_ways() const {
    return reading_.expansion == ThesisReading::Expansion::kBothDirections;
  }

  /// The forward top is beyond the backward top, "or if both queues are empty".
  [[nodiscard]] bool has_ended() const {
    if (forward_.empty() || backward_.empty()) return forward_.empty() && backward_.empty();
    const auto& [forward_key, forward_top] = *forward_.begin();
    const auto& [backward_key, backward_top] = *backward_.rbegin();
    if (reading_.meeting == ThesisReading::Meeting::kVectors) return forward_key > backward_key;
    return forward_top.level > backward_top.level;
  }

  /// Function 1, for all nodes of the least key.
  void expand_forward() {
    const Vector key = forward_.begin()->first;
    while (!forward_.empty() && forward_.begin()->first == key) {
      const ThesisNode v1 = forward_.begin()->second;
      forward_.erase(forward_.begin());
      for (const std::uint32_t head : heads_[v1.element]) {
        const auto consumed = plus(graph_, v1.consumed, head);
        if (!consumed) continue;  // rc(e_succ) <= L
        const ThesisNode v2 = node_at(graph_, head, *consumed);
        if (is_beyond(v1, v2)) continue;  // l_succ <= l_ts
        create_forward(v2);
        edges_.emplace(v1, v2);
      }
    }
  }

  [[nodiscard]] bool is_beyond(const ThesisNode& v1, const ThesisNode& v2) const {
    if (backward_.empty()) return false;
    const auto& [backward_key, backward_top] = *backward_.rbegin();
    if (reading_.meeting == ThesisReading::Meeting::kLevels) return v2.level > backward_top.level;
    return v1.consumed > backward_key;
  }

  void expand_backward() {
    const Vector key = backward_.rbegin()->first;
    while (!backward_.empty() && backward_.rbegin()->first == key) {
      const ThesisNode v2 = backward_.rbegin()->second;
      backward_.erase(std::prev(backward_.end()));
      const Vector consumed = before(v2);
      for (const std::uint32_t tail : tails_[v2.element]) {
        if (!minus(graph_, consumed, tail)) continue;
        const ThesisNode v1 = node_at(graph_, tail, consumed);
        create_backward(v1);
        edges_.emplace(v1, v2);
      }
    }
  }

  /// Takes nodes without a predecessor or without a successor away until there are none. Sets of
  /// what is reached from both ends, since circles that consume nothing feed themselves.
  [[nodiscard]] std::set<ThesisNode> prune() const {
    std::set<ThesisNode> front;
    std::set<ThesisNode> back;
    for (const auto& node : nodes_) {
      const bool is_entry = std::ranges::any_of(graph_.entries, [&](const auto& entry) {
        return entry.node == node.element && before(node) == Vector(graph_.dimension_count, 0);
      });
      const bool is_exit = std::ranges::any_of(
          graph_.exits, [&](const auto& exit) { return exit.node == node.element; });
      if (is_entry) front.insert(node);
      if (is_exit && keeps_minima(node)) back.insert(node);
    }
    for (bool changes = true; changes;) {
      changes = false;
      for (const auto& [tail, head] : edges_) {
        changes = (front.contains(tail) && front.insert(head).second) || changes;
        changes = (back.contains(head) && back.insert(tail).second) || changes;
      }
    }
    std::set<ThesisNode> both;
    std::ranges::set_intersection(front, back, std::inserter(both, both.end()));
    return both;
  }

  [[nodiscard]] bool keeps_minima(const ThesisNode& node) const {
    for (std::size_t d = 0; d < node.consumed.size(); ++d)
      if (node.consumed[d] < graph_.zones.front().bounds[d].min) return false;
    return true;
  }

  const SearchGraph& graph_;
  ThesisReading reading_;
  std::vector<std::vector<std::uint32_t>> heads_ = successors(graph_, false);
  std::vector<std::vector<std::uint32_t>> tails_ = successors(graph_, true);
  std::set<ThesisNode> nodes_;
  std::set<ThesisNode> created_forward_;
  std::set<ThesisNode> created_backward_;
  std::set<std::pair<ThesisNode, ThesisNode>> edges_;
  Queue forward_;
  Queue backward_;
};

}  // namespace

ThesisGraph thesis_construction(const SearchGraph& graph, const ThesisReading& reading) {
  return Construction(graph, reading).run();
}

std::set<ThesisNode> nodes_on_feasible_paths(const SearchGraph& graph) {
  const auto heads = successors(graph, false);
  const auto& bounds = graph.zones.front().bounds;
  std::map<ThesisNode, std::vector<ThesisNode>> tails;
  std::vector<ThesisNode> open;
  const auto reach = [&](const ThesisNode& node) {
    if (tails.try_emplace(node).second) open.push_back(node);
  };
  for (const auto& entry : graph.entries)
    if (const auto consumed = plus(graph, Vector(graph.dimension_count, 0), entry.node))
      reach(node_at(graph, entry.node, *consumed));
  while (!open.empty()) {
    const ThesisNode tail = open.back();
    open.pop_back();
    for (const std::uint32_t head : heads[tail.element]) {
      const auto consumed = plus(graph, tail.consumed, head);
      if (!consumed) continue;
      const ThesisNode next = node_at(graph, head, *consumed);
      reach(next);
      tails[next].push_back(tail);
    }
  }
  std::set<ThesisNode> feasible;
  const auto keep = [&](const ThesisNode& node) {
    if (feasible.insert(node).second) open.push_back(node);
  };
  for (const auto& [node, before] : tails) {
    bool is_end = std::ranges::any_of(
        graph.exits, [&, e = node.element](const auto& exit) { return exit.node == e; });
    for (std::size_t d = 0; d < bounds.size(); ++d)
      is_end = is_end && node.consumed[d] >= bounds[d].min;
    if (is_end) keep(node);
  }
  while (!open.empty()) {
    const ThesisNode head = open.back();
    open.pop_back();
    for (const auto& tail : tails[head]) keep(tail);
  }
  return feasible;
}

}  // namespace plat::testing
