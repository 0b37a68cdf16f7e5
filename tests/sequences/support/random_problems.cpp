#include "sequences/support/random_problems.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace plat::testing {
namespace {

using sequences::Amount;
using sequences::Bounds;
using sequences::Cost;
using sequences::kUnbounded;
using sequences::Link;
using sequences::SearchGraph;
using sequences::SequenceDatabase;
using sequences::SequenceProblem;
using sequences::Transition;
using sequences::TransitionTable;
using sequences::Zone;

/// 0 .. n
Amount up_to(Rng& rng, Amount n) {
  return static_cast<Amount>(rng.index(static_cast<std::uint64_t>(n) + 1));
}

bool chance(Rng& rng, double probability) { return rng.uniform_01() < probability; }

Amount random_use(Rng& rng, Amount most) { return chance(rng, 0.35) ? 0 : up_to(rng, most); }

/// Most are zero, in half of the problems with ties only.
Cost random_cost(Rng& rng, bool has_few_values) {
  constexpr std::array<Cost, 8> kFew{0, 0, 0, 0, 1, 1, 2, 5};
  return has_few_values ? kFew[rng.index(kFew.size())] : static_cast<Cost>(rng.index(1000));
}

/// Bounds of every kind about an amount that may or may not be reachable.
Bounds random_bounds(Rng& rng, Amount target, Amount most) {
  switch (rng.index(6)) {
    case 0:
    case 1:
      return {target, target};
    case 2:
      return {std::max(0, target - up_to(rng, 3)), std::min(most, target + up_to(rng, 3))};
    case 3:
      return {0, target};
    case 4:
      return {target, kUnbounded};
    default:
      return {};
  }
}

/// Whether the transition consumes nothing that has an upper bound.
bool is_free(const SequenceProblem& problem, const Transition& transition) {
  const auto& uses = problem.database.elements[transition.to].uses;
  for (std::size_t r = 0; r < problem.bounds.size(); ++r) {
    if (problem.bounds[r].max == kUnbounded) continue;
    if (uses[r] > 0 || (!transition.uses.empty() && transition.uses[r] > 0)) return false;
  }
  return true;
}

/// What a walk of random length through the database consumes.
std::vector<Amount> reached_by_a_walk(Rng& rng, const SequenceDatabase& database) {
  std::vector<Amount> consumed(database.resources.size(), 0);
  auto at = static_cast<std::uint32_t>(rng.index(database.elements.size()));
  for (std::uint64_t left = rng.index(6);; --left) {
    for (std::size_t r = 0; r < consumed.size(); ++r) consumed[r] += database.elements[at].uses[r];
    std::vector<const Transition*> out;
    for (const auto& transition : database.transitions)
      if (transition.from == at) out.push_back(&transition);
    if (left == 0 || out.empty()) return consumed;
    const Transition& taken = *out[rng.index(out.size())];
    for (std::size_t r = 0; r < taken.uses.size(); ++r) consumed[r] += taken.uses[r];
    at = taken.to;
  }
}

SequenceDatabase random_database(Rng& rng, const ProblemSize& size) {
  SequenceDatabase database;
  const auto resources = 1 + rng.index(size.resources);
  const auto elements = static_cast<std::uint32_t>(1 + rng.index(size.elements));
  for (std::uint64_t r = 0; r < resources; ++r)
    database.resources.push_back({"r" + std::to_string(r), 1.0});
  const double rarity_of_ends = rng.uniform(0.3, 1.0);
  for (std::uint32_t e = 0; e < elements; ++e) {
    sequences::Element element{.name = "e" + std::to_string(e)};
    for (std::uint64_t r = 0; r < resources; ++r)
      element.uses.push_back(chance(rng, 0.15) ? 0 : random_use(rng, size.use));
    element.is_filling = chance(rng, 0.95);
    element.is_front = chance(rng, rarity_of_ends);
    element.is_back = chance(rng, rarity_of_ends);
    database.elements.push_back(std::move(element));
  }
  const double density = rng.uniform(0.2, 1.0);
  const bool has_few_costs = chance(rng, 0.6);
  const bool has_own_uses = chance(rng, 0.3);
  for (std::uint32_t from = 0; from < elements; ++from) {
    for (std::uint32_t to = 0; to < elements; ++to) {
      while (chance(rng, density * 0.7)) {  // parallel transitions, now and then
        Transition transition{.from = from, .to = to, .cost = random_cost(rng, has_few_costs)};
        if (has_own_uses && chance(rng, 0.5))
          for (std::uint64_t r = 0; r < resources; ++r)
            transition.uses.push_back(random_use(rng, 2));
        database.transitions.push_back(std::move(transition));
      }
    }
  }
  return database;
}

/// What one zone's table and nodes consume, drawn with its bounds known.
struct ZoneDraft {
  Rng& rng;
  SearchGraph& graph;
  bool has_few_costs;

  /// Arcs that go back and neither cost nor consume get a cost.
  TransitionTable table(const Zone& zone) {
    const auto free_node = [&](std::uint32_t local) {
      const auto uses = graph.uses(zone.first_node + local);
      for (std::uint32_t d = 0; d < graph.dimension_count; ++d)
        if (zone.bounds[d].max != kUnbounded && uses[d] > 0) return false;
      return true;
    };
    TransitionTable out;
    out.first.assign(1, 0);
    const double density = rng.uniform(0.1, 0.8);
    const bool has_uses = chance(rng, 0.3);
    for (std::uint32_t tail = 0; tail < zone.size; ++tail) {
      for (std::uint32_t head = 0; head < zone.size; ++head) {
        while (chance(rng, density * 0.7)) {
          Cost cost = random_cost(rng, has_few_costs);
          if (head <= tail && cost == 0 && free_node(head)) cost = 1;
          out.arcs.push_back({head, cost});
          for (std::uint32_t d = 0; has_uses && d < graph.dimension_count; ++d)
            out.arc_uses.push_back(random_use(rng, 2));
        }
      }
      out.first.push_back(static_cast<std::uint32_t>(out.arcs.size()));
    }
    return out;
  }
};

/// Half of them easily kept: a path meets many of them.
Bounds random_zone_bounds(Rng& rng, Amount target) {
  if (chance(rng, 0.5)) return {up_to(rng, 2), 5 + up_to(rng, 7)};
  return random_bounds(rng, target, 12);
}

/// How a dimension goes from zone to zone.
enum class Scope { kWhole, kEachZone, kSomeZones, kGrowing };

/// The bounds and resets of one dimension, zone by zone.
void draw_dimension(Rng& rng, SearchGraph& graph) {
  const auto scope = static_cast<Scope>(rng.index(4));
  const Amount target = 1 + up_to(rng, scope == Scope::kEachZone ? 5 : 9);
  Bounds bounds = random_zone_bounds(rng, target);
  for (std::size_t z = 0; z < graph.zones.size(); ++z) {
    Zone& zone = graph.zones[z];
    if (scope == Scope::kEachZone && z > 0) bounds = random_zone_bounds(rng, up_to(rng, 6));
    // A maximum may be another one further on, where it is a maximum.
    if (scope == Scope::kGrowing && bounds.max != kUnbounded)
      bounds.max = std::max(bounds.min, bounds.max + up_to(rng, 4) - 1);
    zone.bounds.push_back(bounds);
    zone.resets.push_back(scope == Scope::kEachZone ||
                          (scope == Scope::kSomeZones && chance(rng, 0.5)));
  }
}

void draw_links(Rng& rng, SearchGraph& graph, bool has_few_costs) {
  const double density = rng.uniform(0.2, 0.8);
  for (std::uint32_t from = 0; from < graph.node_count(); ++from) {
    for (std::uint32_t to = from + 1; to < graph.node_count(); ++to) {
      const std::uint32_t zones = graph.zone_of(to) - graph.zone_of(from);
      if (zones == 0) continue;
      while (chance(rng, zones == 1 ? density : 0.1))
        graph.links.push_back({from, to, random_cost(rng, has_few_costs)});
    }
  }
}

void draw_terminals(Rng& rng, SearchGraph& graph, bool has_few_costs) {
  const auto last = static_cast<std::uint32_t>(graph.zones.size()) - 1;
  for (std::uint32_t node = 0; node < graph.node_count(); ++node) {
    const std::uint32_t zone = graph.zone_of(node);
    while (chance(rng, zone == 0 ? 0.6 : 0.05))
      graph.entries.push_back({node, random_cost(rng, has_few_costs)});
    if (chance(rng, zone == last ? 0.7 : 0.1))
      graph.exits.push_back({node, random_cost(rng, has_few_costs)});
  }
}

}  // namespace

SequenceProblem random_plain_problem(Rng& rng, const ProblemSize& size) {
  SequenceDatabase database = random_database(rng, size);
  const std::vector<Amount> target = reached_by_a_walk(rng, database);
  std::vector<Bounds> bounds;
  for (const Amount reached : target) {
    const Amount about =
        chance(rng, 0.75) ? std::min(reached, size.amount) : up_to(rng, size.amount);
    bounds.push_back(random_bounds(rng, about, size.amount));
  }
  SequenceProblem problem = plain_sequence(std::move(database), std::move(bounds));
  for (auto& transition : problem.database.transitions) {
    const bool may_close_a_circle = transition.to <= transition.from;
    if (may_close_a_circle && transition.cost == 0 && is_free(problem, transition))
      transition.cost = 1;
  }
  return problem;
}

SearchGraph random_search_graph(Rng& rng) {
  SearchGraph graph;
  graph.dimension_count = static_cast<std::uint32_t>(rng.index(4));
  const bool has_few_costs = chance(rng, 0.6);
  std::uint32_t next = 0;
  for (std::uint64_t left = 1 + rng.index(5); left > 0; --left) {
    const auto size = static_cast<std::uint32_t>(1 + rng.index(3));
    graph.zones.push_back({next, size, std::nullopt, {}, {}});
    next += size;
  }
  for (std::uint32_t d = 0; d < graph.dimension_count; ++d) draw_dimension(rng, graph);
  for (std::uint32_t i = 0; i < next * graph.dimension_count; ++i)
    graph.node_uses.push_back(random_use(rng, 3));
  for (Zone& zone : graph.zones) {
    if (chance(rng, 0.25)) continue;
    ZoneDraft draft{rng, graph, has_few_costs};
    zone.table = static_cast<std::uint32_t>(graph.tables.size());
    graph.tables.push_back(draft.table(zone));
  }
  // A table is shared where the other zone's nodes make no free circle of it.
  for (std::size_t z = 1; z < graph.zones.size(); ++z) {
    Zone& zone = graph.zones[z];
    const Zone& before = graph.zones[z - 1];
    if (!before.table || zone.size != before.size || !chance(rng, 0.6)) continue;
    const auto& arcs = graph.tables[*before.table].arcs;
    const bool costs_something =
        std::ranges::all_of(arcs, [](const TransitionTable::Arc& arc) { return arc.cost > 0; });
    const auto n = std::size_t{zone.size} * graph.dimension_count;
    if (!costs_something) {  // the same elements again, under the same bounds
      if (zone.bounds != before.bounds) continue;
      std::copy_n(graph.node_uses.begin() + before.first_node * graph.dimension_count, n,
                  graph.node_uses.begin() + zone.first_node * graph.dimension_count);
    }
    zone.table = before.table;
  }
  draw_links(rng, graph, has_few_costs);
  draw_terminals(rng, graph, has_few_costs);
  return graph;
}

}  // namespace plat::testing
