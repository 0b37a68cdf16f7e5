#include "sequences/stretched_search.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace plat::sequences {
namespace {

using Amounts = std::vector<Amount>;
constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

/// A state that was met, in the order of meeting.
struct Label {
  std::uint64_t state = 0;
  std::int64_t price = 0;
  Cost cost = 0;
  std::uint32_t parent = kNobody;
  Step step;
};

/// What waits: by price, cost, then the label met last, which is nearest to an end.
struct Waiting {
  std::int64_t price = 0;
  Cost cost = 0;
  std::uint32_t label = 0;
  bool is_ended = false;
  friend bool operator<(const Waiting& a, const Waiting& b) {
    return std::tuple(b.price, b.cost, a.label, a.is_ended) <
           std::tuple(a.price, a.cost, b.label, b.is_ended);
  }
};

class StretchedSearch {
 public:
  StretchedSearch(const SearchGraph& graph, const std::vector<std::vector<Stretch>>& stretches,
                  PriceTies ties, std::size_t max_states)
      : graph_(graph), stretches_(stretches), ties_(ties), max_states_(max_states) {}

  Expected<std::optional<StretchedPath>> run() {
    if (!find_radices())
      return fail(FailureCode::kTooManyStates,
                  "the bounds allow more combinations of amounts than can be numbered");
    for (std::uint32_t i = 0; i < graph_.entries.size(); ++i) {
      const auto& entry = graph_.entries[i];
      Reached reached{Amounts(graph_.dimension_count, 0), 0};
      if (enter(entry.node, nullptr, reached)) meet(reached, entry.cost, kNobody, {entry.node, i});
    }
    while (!queue_.empty()) {
      const Waiting top = queue_.top();
      queue_.pop();
      if (top.is_ended) return StretchedPath{top.price, path_to(top.label)};
      const Label label = labels_[top.label];
      if (best_.at(label.state) != top.label) continue;
      if (labels_.size() > max_states_)
        return fail(FailureCode::kTooManyStates,
                    "more than " + std::to_string(max_states_) + " states");
      expand(label, top.label);
    }
    return std::nullopt;
  }

 private:
  /// Amounts in a zone, and what has been paid.
  struct Reached {
    Amounts amounts;
    std::int64_t price = 0;
  };

  /// The bound as far as it still limits something.
  [[nodiscard]] Bounds bounds(std::size_t zone, std::size_t dimension) const {
    Bounds out = graph_.zones[zone].bounds[dimension];
    const Stretch& stretch = stretches_[zone][dimension];
    if (stretch.below == 0) out.min = 0;
    if (stretch.above == 0) out.max = kUnbounded;
    return out;
  }

  /// How many amounts of each dimension are told apart; false where their product is too large.
  bool find_radices() {
    double states = graph_.node_count();
    for (std::size_t d = 0; d < graph_.dimension_count; ++d) {
      Amount largest = 0;
      for (std::size_t z = 0; z < graph_.zones.size(); ++z)
        largest = std::max(largest, largest_amount(bounds(z, d)));
      radices_.push_back(static_cast<std::uint64_t>(largest) + 1);
      states *= static_cast<double>(radices_.back());
    }
    return states < 9e18;
  }
  [[nodiscard]] std::uint64_t state_of(std::uint32_t node, const Amounts& amounts) const {
    std::uint64_t state = node;
    for (std::size_t d = 0; d < amounts.size(); ++d)
      state = state * radices_[d] + static_cast<std::uint64_t>(amounts[d]);
    return state;
  }
  [[nodiscard]] Amounts amounts_of(std::uint64_t state) const {
    Amounts amounts(radices_.size());
    for (std::size_t d = radices_.size(); d-- > 0;) {
      amounts[d] = static_cast<Amount>(state % radices_[d]);
      state /= radices_[d];
    }
    return amounts;
  }

  /// Consumes what entering the node takes; what exceeds a maximum is paid, or not allowed.
  bool enter(std::uint32_t node, const Amount* arc_uses, Reached& reached) const {
    const std::uint32_t z = graph_.zone_of(node);
    const auto uses = graph_.uses(node);
    for (std::size_t d = 0; d < reached.amounts.size(); ++d) {
      const Bounds limit = bounds(z, d);
      const std::int64_t sum =
          std::int64_t{reached.amounts[d]} + uses[d] + (arc_uses == nullptr ? 0 : arc_uses[d]);
      if (limit.max != kUnbounded && sum > limit.max) {
        if (!stretches_[z][d].above) return false;
        reached.price += *stretches_[z][d].above * (sum - limit.max);
      }
      reached.amounts[d] = static_cast<Amount>(std::min<std::int64_t>(sum, largest_amount(limit)));
    }
    return true;
  }
  /// What is missing to a minimum is paid, or not allowed.
  bool settle(std::size_t zone, std::size_t dimension, Reached& reached) const {
    const std::int64_t missing =
        std::int64_t{bounds(zone, dimension).min} - reached.amounts[dimension];
    if (missing <= 0) return true;
    const auto& price = stretches_[zone][dimension].below;
    if (!price) return false;
    reached.price += *price * missing;
    return true;
  }
  bool leave(std::uint32_t from, std::uint32_t to, Reached& reached) const {
    const std::uint32_t z = graph_.zone_of(from);
    const Zone& next = graph_.zones[graph_.zone_of(to)];
    for (std::size_t d = 0; d < reached.amounts.size(); ++d) {
      if (!next.resets[d]) continue;
      if (!settle(z, d, reached)) return false;
      reached.amounts[d] = 0;
    }
    return true;
  }

  [[nodiscard]] Cost counted(Cost cost) const { return ties_ == PriceTies::kByCost ? cost : 0; }

  void meet(const Reached& reached, Cost cost, std::uint32_t parent, const Step& step) {
    const std::uint64_t state = state_of(step.node, reached.amounts);
    const auto number = static_cast<std::uint32_t>(labels_.size());
    const auto [at, is_new] = best_.try_emplace(state, number);
    if (!is_new) {
      const Label& known = labels_[at->second];
      if (std::pair(known.price, counted(known.cost)) <= std::pair(reached.price, counted(cost)))
        return;
      at->second = number;
    }
    labels_.push_back({state, reached.price, cost, parent, step});
    queue_.push({reached.price, counted(cost), number, false});
  }

  void expand(const Label& label, std::uint32_t number) {
    const std::uint32_t node = label.step.node;
    const Reached here{amounts_of(label.state), label.price};
    end(label, number, here);
    const std::uint32_t z = graph_.zone_of(node);
    const Zone& zone = graph_.zones[z];
    if (zone.table) {
      const TransitionTable& table = graph_.tables[*zone.table];
      const std::uint32_t local = node - zone.first_node;
      for (std::uint32_t a = table.first[local]; a < table.first[local + 1]; ++a) {
        Reached next = here;
        const Amount* uses = table.arc_uses.empty()
                                 ? nullptr
                                 : table.arc_uses.data() + std::size_t{a} * graph_.dimension_count;
        const std::uint32_t head = zone.first_node + table.arcs[a].head;
        if (enter(head, uses, next)) meet(next, label.cost + table.arcs[a].cost, number, {head, a});
      }
    }
    const auto [first, last] = graph_.links_from(node);
    for (std::uint32_t i = first; i < last; ++i) {
      const Link& link = graph_.links[i];
      Reached next = here;
      if (leave(node, link.to, next) && enter(link.to, nullptr, next))
        meet(next, label.cost + link.cost, number, {link.to, i});
    }
  }

  /// Where the path may end here, lets the end wait for its turn.
  void end(const Label& label, std::uint32_t number, const Reached& here) {
    const auto exit = std::ranges::lower_bound(graph_.exits, label.step.node, {}, &Terminal::node);
    if (exit == graph_.exits.end() || exit->node != label.step.node) return;
    Reached ended = here;
    const std::uint32_t z = graph_.zone_of(label.step.node);
    for (std::size_t d = 0; d < ended.amounts.size(); ++d)
      if (!settle(z, d, ended)) return;
    queue_.push({ended.price, counted(label.cost + exit->cost), number, true});
  }

  [[nodiscard]] SequencePath path_to(std::uint32_t number) const {
    const std::uint32_t last = labels_[number].step.node;
    const auto exit = std::ranges::lower_bound(graph_.exits, last, {}, &Terminal::node);
    SequencePath path{labels_[number].cost + exit->cost, {}};
    for (std::uint32_t at = number; at != kNobody; at = labels_[at].parent)
      path.steps.push_back(labels_[at].step);
    std::ranges::reverse(path.steps);
    return path;
  }

  const SearchGraph& graph_;
  const std::vector<std::vector<Stretch>>& stretches_;
  PriceTies ties_;
  std::size_t max_states_;
  std::vector<std::uint64_t> radices_;
  std::vector<Label> labels_;
  std::unordered_map<std::uint64_t, std::uint32_t> best_;  // state to label; never iterated
  std::priority_queue<Waiting> queue_;
};

}  // namespace

Expected<std::optional<StretchedPath>> stretched_path(
    const SearchGraph& graph, const std::vector<std::vector<Stretch>>& stretches, PriceTies ties,
    std::size_t max_states) {
  return StretchedSearch(graph, stretches, ties, max_states).run();
}

}  // namespace plat::sequences
