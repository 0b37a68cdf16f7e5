#include "sequences/forward_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sequences/cheapest_ways.h"
#include "sequences/given_paths.h"
#include "sequences/monotone_queue.h"
#include "sequences/resource_bounds.h"
#include "sequences/state_index.h"

namespace plat::sequences {
namespace {

/// As many possible states are numbered from the start: 128 MB of costs.
constexpr std::size_t kDenseStates = std::size_t{1} << 24;
/// How many ways to a state are followed: the first run for one path, each further run for more.
constexpr std::size_t kLimitGrowth = 4;

/// One search with a fixed limit of ways to a state: gives as many of the best paths as the limit,
/// and more where they are few.
class Run {
 public:
  Run(const SearchGraph& graph, const ResourceBounds* bounds, std::size_t limit,
      std::size_t max_ways)
      : graph_(graph),
        bounds_(bounds),
        max_ways_(max_ways),
        states_(graph, limit == CheapestWays::kNoLimit ? 0 : kDenseStates),
        cheapest_(limit, states_.size()),
        consumed_(graph.dimension_count),
        next_consumed_(graph.dimension_count),
        zeros_(graph.dimension_count),
        is_fresh_(limit == CheapestWays::kNoLimit) {
    for (const Zone& zone : graph.zones) {
      for (const Bounds& limits : zone.bounds) {
        caps_.push_back(largest_amount(limits));
        saturates_.push_back(limits.max == kUnbounded ? 1 : 0);
      }
    }
    for (const Terminal& exit : graph.exits) {
      exit_cost_.resize(std::size_t{exit.node} + 1, kNoWay);
      exit_cost_[exit.node] = exit.cost;
    }
    exit_cost_.resize(graph.node_count(), kNoWay);
    for (std::uint32_t e = 0; e < graph.entries.size(); ++e) {
      const Terminal& entry = graph.entries[e];
      enter(graph.zone_of(entry.node), entry.node, zeros_.data(), entry.cost, kNobody, e);
    }
  }

  Expected<bool> next(SequencePath& path) {
    while (!queue_.empty()) {
      if (ways_.size() > max_ways_)
        return fail(FailureCode::kTooManyStates,
                    fmt::format("forward search holds {} ways to {} states; max_states is {}",
                                ways_.size(), cheapest_.states(), max_ways_));
      const auto [key, way] = queue_.pop();
      if (ways_[way].arc == kExit) {
        write_path(way, static_cast<Cost>(key), path);
        return true;
      }
      expand(way, static_cast<Cost>(key));
    }
    return false;
  }

  void add_to(SearchStatistics& out) const {
    out.states_created += cheapest_.states();
    out.states_expanded += expanded_;
    out.arcs_relaxed += relaxed_;
    out.states_pruned += stale_;
    out.bytes_held = ways_.capacity() * sizeof(Way) + queue_.bytes_held() + states_.bytes_held() +
                     cheapest_.bytes_held();
  }

 private:
  static constexpr std::uint32_t kNobody = ~std::uint32_t{0};
  static constexpr std::uint32_t kExit = ~std::uint32_t{0};
  /// A partial path: the last arc, and what was before.
  struct Way {
    StateIndex::Id state = 0;
    std::uint32_t parent = kNobody;
    std::uint32_t arc = 0;  ///< as in a Step; kExit: the parent is a whole path
  };

  struct Reached {
    StateIndex::Id state = 0;
    std::uint32_t arc = 0;
  };

  [[nodiscard]] Cost least_rest(std::uint32_t node) const {
    return bounds_ != nullptr ? bounds_->cost_to_exit[node] : 0;
  }

  void expand(std::uint32_t way, Cost key) {
    const StateIndex::Id state = ways_[way].state;
    const std::uint32_t node = states_.state(state, consumed_);
    const Cost cost = key - least_rest(node);
    if (!cheapest_.take(state, cost)) {
      ++stale_;
      return;
    }
    ++expanded_;
    const std::uint32_t z = graph_.zone_of(node);
    const Zone& zone = graph_.zones[z];
    if (exit_cost_[node] != kNoWay && keeps_minima(zone, [](std::size_t) { return true; })) {
      queue_.push(static_cast<std::uint64_t>(cost + exit_cost_[node]),
                  static_cast<std::uint32_t>(ways_.size()));
      ways_.push_back({state, way, kExit});
    }
    if (zone.table) follow_arcs(z, node, way, cost);
    follow_links(zone, node, way, cost);
  }

  template <class IsAsked>
  [[nodiscard]] bool keeps_minima(const Zone& zone, IsAsked is_asked) const {
    for (std::size_t d = 0; d < consumed_.size(); ++d)
      if (is_asked(d) && consumed_[d] < zone.bounds[d].min) return false;
    return true;
  }

  void follow_arcs(std::uint32_t z, std::uint32_t node, std::uint32_t way, Cost cost) {
    const Zone& zone = graph_.zones[z];
    const TransitionTable& table = graph_.tables[*zone.table];
    const std::uint32_t first = table.first[node - zone.first_node];
    const std::uint32_t last = table.first[node - zone.first_node + 1];
    relaxed_ += last - first;
    if (reached_.size() < last - first) reached_.resize(last - first);
    const std::size_t count = graph_.dimension_count == 1   ? reach<1>(z, first, last)
                              : graph_.dimension_count == 2 ? reach<2>(z, first, last)
                                                            : reach<0>(z, first, last);
    // Only now, when all are on their way from memory, are the costs of the states compared.
    for (const auto [state, arc] : std::span(reached_.data(), count)) {
      const auto& followed = table.arcs[arc];
      push(state, zone.first_node + followed.head, cost + followed.cost, way, arc);
    }
  }

  /// Collects the states that arcs of one tail lead to, where bounds allow, and counts them.
  template <std::uint32_t kDimensions>
  std::size_t reach(std::uint32_t z, std::uint32_t first, std::uint32_t last) {
    const Zone& zone = graph_.zones[z];
    const TransitionTable& table = graph_.tables[*zone.table];
    const Amount* uses = table.arc_uses.empty() ? nullptr : table.arc_uses.data();
    std::size_t count = 0;
    for (std::uint32_t arc = first; arc < last; ++arc) {
      const std::uint32_t head = zone.first_node + table.arcs[arc].head;
      const Amount* own =
          uses == nullptr ? nullptr : uses + std::size_t{arc} * graph_.dimension_count;
      if (!consume<kDimensions>(z, head, consumed_.data(), own)) continue;
      const StateIndex::Id state = state_of(z, head);
      cheapest_.prefetch(state);
      reached_[count++] = {state, arc};
    }
    return count;
  }

  void follow_links(const Zone& zone, std::uint32_t node, std::uint32_t way, Cost cost) {
    const auto [first, last] = graph_.links_from(node);
    relaxed_ += last - first;
    for (std::uint32_t l = first; l < last; ++l) {
      const Link& link = graph_.links[l];
      const std::uint32_t z = graph_.zone_of(link.to);
      const Zone& next = graph_.zones[z];
      if (!keeps_minima(zone, [&next](std::size_t d) { return next.resets[d]; })) continue;
      std::vector<Amount> before = consumed_;
      for (std::size_t d = 0; d < before.size(); ++d)
        if (next.resets[d]) before[d] = 0;
      enter(z, link.to, before.data(), cost + link.cost, way, l);
    }
  }

  /// Enters a node with `before` consumed, if it may be and is not known to be worse than others.
  void enter(std::uint32_t z, std::uint32_t node, const Amount* before, Cost cost,
             std::uint32_t parent, std::uint32_t arc) {
    if (consume<0>(z, node, before, nullptr)) push(state_of(z, node), node, cost, parent, arc);
  }

  /// Writes `before` and what entering the node uses to `next_consumed_`; false where that cannot
  /// end well. With 0 dimensions as the graph has.
  template <std::uint32_t kDimensions>
  bool consume(std::uint32_t z, std::uint32_t node, const Amount* before, const Amount* arc_uses) {
    const std::size_t dimensions = kDimensions > 0 ? kDimensions : graph_.dimension_count;
    const Amount* uses = graph_.node_uses.data() + node * dimensions;
    const Amount* caps = caps_.data() + z * dimensions;
    for (std::size_t d = 0; d < dimensions; ++d) {
      std::int64_t sum = std::int64_t{before[d]} + uses[d];
      if (arc_uses != nullptr) sum += arc_uses[d];
      if (sum > caps[d]) {
        if (saturates_[z * dimensions + d] == 0) return false;
        sum = caps[d];
      }
      next_consumed_[d] = static_cast<Amount>(sum);
    }
    return bounds_ == nullptr || bounds_->may_end(node, next_consumed_);
  }

  StateIndex::Id state_of(std::uint32_t z, std::uint32_t node) {
    if (is_fresh_) return states_.fresh_id(node, next_consumed_.data());
    const StateIndex::Id state = states_.id(z, node, next_consumed_.data());
    if (!states_.is_dense()) cheapest_.grow(states_.size());
    return state;
  }

  void push(StateIndex::Id state, std::uint32_t node, Cost cost, std::uint32_t parent,
            std::uint32_t arc) {
    if (!cheapest_.admit(state, cost)) return;
    queue_.push(static_cast<std::uint64_t>(cost + least_rest(node)),
                static_cast<std::uint32_t>(ways_.size()));
    ways_.push_back({state, parent, arc});
  }

  void write_path(std::uint32_t way, Cost cost, SequencePath& path) {
    path.cost = cost;
    path.steps.clear();
    for (std::uint32_t at = ways_[way].parent; at != kNobody; at = ways_[at].parent)
      path.steps.push_back({states_.state(ways_[at].state, consumed_), ways_[at].arc});
    std::ranges::reverse(path.steps);
  }

  const SearchGraph& graph_;
  const ResourceBounds* bounds_;  ///< null: not used
  std::size_t max_ways_;
  StateIndex states_;
  CheapestWays cheapest_;
  std::vector<Amount> caps_;              ///< zones x dimensions: what a zone remembers at most
  std::vector<unsigned char> saturates_;  ///< zones x dimensions: more than the cap is as the cap
  std::vector<Cost> exit_cost_;           ///< by node; kNoWay: no exit
  std::vector<Way> ways_;
  MonotoneQueue<std::uint32_t> queue_;
  std::vector<Amount> consumed_;  ///< of the state that is expanded
  std::vector<Amount> next_consumed_;
  std::vector<Amount> zeros_;
  std::vector<Reached> reached_;  ///< by the arcs of the state that is expanded
  bool is_fresh_;                 ///< every way is a state of its own
  std::uint64_t expanded_ = 0;
  std::uint64_t relaxed_ = 0;
  std::uint64_t stale_ = 0;
};

class ForwardStream final : public SequenceStream {
 public:
  ForwardStream(const SearchGraph& graph, const ForwardSearch::Options& options)
      : graph_(&graph),
        limit_(options.dominance == ForwardSearch::Dominance::kNone ? CheapestWays::kNoLimit : 1),
        max_ways_(static_cast<std::size_t>(options.max_states)) {
    if (options.dominance == ForwardSearch::Dominance::kBounds) {
      bounds_ = resource_bounds(graph);
    }
    start();
  }

  Expected<bool> next(SequencePath& path) override {
    while (!is_finished_) {
      if (given_.count() == limit_) {
        run_->add_to(before_);
        limit_ *= kLimitGrowth;
        start();
      }
      const auto more = run_->next(path);
      if (!more) return more;
      if (!*more) break;
      if (limit_ != CheapestWays::kNoLimit && !given_.add(path)) continue;
      return true;
    }
    is_finished_ = true;
    return false;
  }

  [[nodiscard]] SearchStatistics statistics() const override {
    SearchStatistics out = before_;
    run_->add_to(out);
    return out;
  }

 private:
  void start() { run_.emplace(*graph_, bounds_ ? &*bounds_ : nullptr, limit_, max_ways_); }

  const SearchGraph* graph_;
  std::optional<ResourceBounds> bounds_;
  std::size_t limit_;
  std::size_t max_ways_;
  std::optional<Run> run_;
  SearchStatistics before_;  ///< of earlier runs
  GivenPaths given_;  ///< not used where every way is followed, and no run comes after the first
  bool is_finished_ = false;
};

}  // namespace

Expected<std::unique_ptr<SequenceStream>> ForwardSearch::search(const SearchGraph& graph) const {
  return std::make_unique<ForwardStream>(graph, options_);
}

}  // namespace plat::sequences
