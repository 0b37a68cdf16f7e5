#include "sequences/support/brute_force.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "core/failure.h"

namespace plat::testing {
namespace {

using sequences::Amount;
using sequences::Bounds;
using sequences::Cost;
using sequences::kUnbounded;
using sequences::SearchGraph;
using sequences::SequencePath;
using sequences::Step;
using sequences::Zone;
using Consumed = std::vector<std::int64_t>;

const Zone& zone_at(const SearchGraph& graph, std::uint32_t node) {
  for (const Zone& zone : graph.zones)
    if (node < zone.first_node + zone.size) return zone;
  throw LogicError("a node lies in a zone");
}

/// Adds what entering `node` takes; false where a maximum is exceeded.
bool consume(const SearchGraph& graph, std::uint32_t node, const Amount* arc_uses,
             Consumed& consumed) {
  const Zone& zone = zone_at(graph, node);
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    consumed[d] += graph.node_uses[node * consumed.size() + d];
    if (arc_uses != nullptr) consumed[d] += arc_uses[d];
    if (zone.bounds[d].max != kUnbounded && consumed[d] > zone.bounds[d].max) return false;
  }
  return true;
}

/// Starts again what the next zone resets; false where a minimum is missed.
bool cross(const Zone& from, const Zone& to, Consumed& consumed) {
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    if (!to.resets[d]) continue;
    if (consumed[d] < from.bounds[d].min) return false;
    consumed[d] = 0;
  }
  return true;
}

/// What it costs to end at `node` with so much consumed, or nothing where that is not allowed.
std::optional<Cost> cost_of_ending(const SearchGraph& graph, std::uint32_t node,
                                   const Consumed& consumed) {
  const Zone& zone = zone_at(graph, node);
  for (std::size_t d = 0; d < consumed.size(); ++d)
    if (consumed[d] < zone.bounds[d].min) return std::nullopt;
  for (const auto& exit : graph.exits)
    if (exit.node == node) return exit.cost;
  return std::nullopt;
}

/// Calls `visit(step, cost, consumed)` for every way on from `node` that keeps the maxima.
template <class Visit>
void for_each_way_on(const SearchGraph& graph, std::uint32_t node, const Consumed& consumed,
                     Visit visit) {
  const Zone& zone = zone_at(graph, node);
  if (zone.table) {
    const auto& table = graph.tables[*zone.table];
    for (std::uint32_t a = table.first[node - zone.first_node];
         a < table.first[node - zone.first_node + 1]; ++a) {
      const std::uint32_t head = zone.first_node + table.arcs[a].head;
      Consumed after = consumed;
      const Amount* uses =
          table.arc_uses.empty() ? nullptr : table.arc_uses.data() + a * consumed.size();
      if (consume(graph, head, uses, after)) visit(Step{head, a}, table.arcs[a].cost, after);
    }
  }
  for (std::uint32_t i = 0; i < graph.links.size(); ++i) {
    const auto& link = graph.links[i];
    if (link.from != node) continue;
    Consumed after = consumed;
    if (cross(zone, zone_at(graph, link.to), after) && consume(graph, link.to, nullptr, after))
      visit(Step{link.to, i}, link.cost, after);
  }
}

template <class Visit>
void for_each_start(const SearchGraph& graph, Visit visit) {
  for (std::uint32_t i = 0; i < graph.entries.size(); ++i) {
    Consumed consumed(graph.dimension_count, 0);
    if (consume(graph, graph.entries[i].node, nullptr, consumed))
      visit(Step{graph.entries[i].node, i}, graph.entries[i].cost, consumed);
  }
}

bool comes_before(const SequencePath& a, const SequencePath& b) {
  return std::tie(a.cost, a.steps) < std::tie(b.cost, b.steps);
}

constexpr Cost kNoCost = std::numeric_limits<Cost>::max();

/// A path of more steps is a walk in circles that no bound ends; enumeration gives up.
constexpr std::size_t kMaxSteps = 1000;

/// Tries every path of at most `limit`.
struct Trial {
  const SearchGraph& graph;
  Cost limit;
  std::size_t visits_left;
  Cost cheapest_beyond = kNoCost;  ///< what the next limit must allow
  std::vector<SequencePath> found = {};
  std::vector<Step> steps = {};

  bool is_beyond(Cost cost) {
    if (cost <= limit) return false;
    cheapest_beyond = std::min(cheapest_beyond, cost);
    return true;
  }
  void walk(const Step& step, Cost cost, const Consumed& consumed) {
    if (visits_left == 0 || is_beyond(cost)) return;
    visits_left = steps.size() < kMaxSteps ? visits_left - 1 : 0;
    steps.push_back(step);
    const auto ending = cost_of_ending(graph, step.node, consumed);
    if (ending && !is_beyond(cost + *ending)) found.push_back({cost + *ending, steps});
    for_each_way_on(graph, step.node, consumed,
                    [&](const Step& next, Cost more, const Consumed& after) {
                      walk(next, cost + more, after);
                    });
    steps.pop_back();
  }
};

}  // namespace

std::optional<Enumeration> enumerate_paths(const SearchGraph& graph, std::size_t k,
                                           std::size_t max_visits) {
  Cost limit = 0;
  for (;;) {
    Trial trial{graph, limit, max_visits};
    for_each_start(graph, [&](const Step& step, Cost cost, const Consumed& consumed) {
      trial.walk(step, cost, consumed);
    });
    if (trial.visits_left == 0) return std::nullopt;
    const bool is_everything = trial.cheapest_beyond == kNoCost;
    if (!is_everything && trial.found.size() < k) {
      limit = std::max(2 * limit, trial.cheapest_beyond);
      continue;
    }
    Enumeration result{std::move(trial.found), false};
    std::ranges::sort(result.paths, comes_before);
    result.is_complete = is_everything && result.paths.size() <= k;
    if (result.paths.size() > k) result.paths.resize(k);
    return result;
  }
}

std::vector<SequencePath> k_best_paths(const SearchGraph& graph, std::size_t k) {
  constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
  struct Way {
    std::size_t parent;
    Step step;
    Consumed consumed;
    bool is_ended;
  };
  std::vector<Way> ways;
  using Waiting = std::pair<Cost, std::size_t>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue;
  const auto add = [&](std::size_t parent, const Step& step, Cost cost, Consumed consumed,
                       bool is_ended) {
    const Zone& zone = zone_at(graph, step.node);
    for (std::size_t d = 0; d < consumed.size(); ++d)
      if (zone.bounds[d].max == kUnbounded)
        consumed[d] = std::min<std::int64_t>(consumed[d], zone.bounds[d].min);
    queue.emplace(cost, ways.size());
    ways.push_back({parent, step, std::move(consumed), is_ended});
  };
  for_each_start(graph, [&](const Step& step, Cost cost, const Consumed& consumed) {
    add(kNobody, step, cost, consumed, false);
  });
  std::map<std::pair<std::uint32_t, Consumed>, std::size_t> taken;
  std::vector<SequencePath> found;
  while (!queue.empty() && found.size() < k) {
    const auto [cost, index] = queue.top();
    queue.pop();
    const Way way = ways[index];
    if (way.is_ended) {
      SequencePath path{cost, {}};
      for (std::size_t at = way.parent; at != kNobody; at = ways[at].parent)
        path.steps.push_back(ways[at].step);
      std::ranges::reverse(path.steps);
      found.push_back(std::move(path));
      continue;
    }
    if (++taken[{way.step.node, way.consumed}] > k) continue;
    if (const auto ending = cost_of_ending(graph, way.step.node, way.consumed))
      add(index, way.step, cost + *ending, way.consumed, true);
    for_each_way_on(graph, way.step.node, way.consumed,
                    [&](const Step& next, Cost more, const Consumed& after) {
                      add(index, next, cost + more, after, false);
                    });
  }
  return found;
}

}  // namespace plat::testing
