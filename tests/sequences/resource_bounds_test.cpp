#include "sequences/resource_bounds.h"

#include <gtest/gtest.h>

#include "sequences/compiled_problem.h"
#include "sequences/sequence_path.h"
#include "sequences/strong_components.h"
#include "sequences/support/brute_force.h"
#include "sequences/support/random_problems.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::k_best_paths;
using plat::testing::property_rng;

TEST(StrongComponents, LeadFromHigherToLowerIndex) {
  // 0 -> 1 <-> 2 -> 3, and 3 -> 3
  const TransitionTable table{{0, 1, 2, 4, 5}, {{1, 0}, {2, 0}, {1, 0}, {3, 0}, {3, 0}}, {}};
  const StrongComponents components = strong_components(table);
  EXPECT_EQ(components.count(), 3U);
  EXPECT_EQ(components.of_node, (std::vector<std::uint32_t>{2, 1, 1, 0}));
  EXPECT_EQ(components.nodes(1).size(), 2U);
}

/// a -> b -> c and a -> c, from a to c. Of "length" a, b, c use 1, 2, 3, of "doors" only b does.
SearchGraph two_ways(std::vector<Bounds> bounds) {
  SequenceDatabase database;
  database.resources = {{"length"}, {"doors"}};
  database.elements = {{.name = "a", .uses = {1, 0}, .is_back = false},
                       {.name = "b", .uses = {2, 1}, .is_front = false, .is_back = false},
                       {.name = "c", .uses = {3, 0}, .is_front = false}};
  database.transitions = {{.from = 0, .to = 1, .cost = 4},
                          {.from = 0, .to = 2, .cost = 9},
                          {.from = 1, .to = 2, .cost = 3}};
  return compile(plain_sequence(std::move(database), std::move(bounds))).graph;
}

TEST(ResourceBounds, OfASmallGraphAreThoseFoundByHand) {
  const ResourceBounds bounds = resource_bounds(two_ways({{0, 7}, {1, 5}}));
  EXPECT_EQ(bounds.cost_from_entry, (std::vector<Cost>{0, 4, 7}));
  EXPECT_EQ(bounds.cost_to_exit, (std::vector<Cost>{7, 3, 0}));
  EXPECT_EQ(bounds.least, (std::vector<Amount>{1, 0, 3, 1, 4, 0}));
  EXPECT_EQ(bounds.ceiling, (std::vector<Amount>{4, 5, 4, 5, 7, 5}));
  EXPECT_EQ(bounds.most, (std::vector<Amount>{7, 0, 7, 1, 7, 1}));
  EXPECT_EQ(bounds.floor, (std::vector<Amount>{0, 0, 0, 1, 0, 1}));
  EXPECT_TRUE(bounds.may_end(1, std::vector<Amount>{4, 1}));
  EXPECT_FALSE(bounds.may_end(1, std::vector<Amount>{5, 1}));
  EXPECT_FALSE(bounds.may_end(1, std::vector<Amount>{4, 0}));
}

TEST(ResourceBounds, ACircleReachesEveryMinimum) {
  SearchGraph graph = two_ways({{50, 60}, {1, 5}});
  EXPECT_EQ(resource_bounds(graph).most[4], 6);
  graph.tables[0] = {{0, 2, 4, 4}, {{1, 4}, {2, 9}, {0, 1}, {2, 3}}, {}};
  const ResourceBounds bounds = resource_bounds(graph);
  EXPECT_EQ(bounds.most[4], 60);
  EXPECT_EQ(bounds.floor[0], 0);
  EXPECT_EQ(bounds.floor[4], 50);
}

TEST(ResourceBounds, WhereNoWayLeadsSaySo) {
  SearchGraph graph = two_ways({{0, 7}, {1, 5}});
  graph.exits.clear();
  const ResourceBounds bounds = resource_bounds(graph);
  EXPECT_EQ(bounds.cost_to_exit[0], kNoWay);
  EXPECT_EQ(bounds.ceiling[0], -1);
  EXPECT_EQ(bounds.floor[0], kUnbounded);
  EXPECT_FALSE(bounds.may_end(0, std::vector<Amount>{1, 0}));
}

TEST(ResourceBounds, EndAtTheResetOfADimension) {
  // Zones {a}, {b}; each uses 4 of at most 5, and the second starts again.
  SearchGraph graph;
  graph.dimension_count = 1;
  graph.zones = {{0, 1, {}, {{3, 5}}, {false}}, {1, 1, {}, {{0, 5}}, {true}}};
  graph.node_uses = {4, 4};
  graph.entries = {{0, 0}};
  graph.exits = {{1, 0}};
  graph.links = {{0, 1, 2}};
  validate(graph);
  const ResourceBounds bounds = resource_bounds(graph);
  EXPECT_EQ(bounds.ceiling, (std::vector<Amount>{5, 5}));
  EXPECT_EQ(bounds.floor, (std::vector<Amount>{3, 0}));
  EXPECT_EQ(bounds.least, (std::vector<Amount>{4, 4}));
  EXPECT_EQ(bounds.most, (std::vector<Amount>{4, 4}));
  graph.zones[1].resets = {false};
  EXPECT_EQ(resource_bounds(graph).ceiling[0], 1);
}

/// Walks along a path and holds it against the bounds at every node.
void expect_within(const SearchGraph& graph, const ResourceBounds& bounds,
                   const SequencePath& path) {
  std::vector<Amount> consumed(graph.dimension_count, 0);
  Cost cost = 0;
  std::uint32_t zone = 0;
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    const auto [node, arc] = path.steps[i];
    const std::uint32_t own_zone = graph.zone_of(node);
    const Zone& here = graph.zones[own_zone];
    std::vector<Amount> used(graph.uses(node).begin(), graph.uses(node).end());
    if (i == 0) {
      cost = graph.entries[arc].cost;
    } else if (own_zone != zone) {
      cost += graph.links[arc].cost;
      for (std::size_t d = 0; d < used.size(); ++d)
        if (here.resets[d]) consumed[d] = 0;
    } else {
      const TransitionTable& table = graph.tables[*here.table];
      cost += table.arcs[arc].cost;
      for (std::size_t d = 0; d < used.size() && !table.arc_uses.empty(); ++d)
        used[d] += table.arc_uses[arc * used.size() + d];
    }
    zone = own_zone;
    for (std::size_t d = 0; d < used.size(); ++d) {
      consumed[d] = add_amount(here.bounds[d], consumed[d], used[d]).value();
      const std::size_t row = node * used.size() + d;
      ASSERT_LE(bounds.least[row], consumed[d]);
      ASSERT_GE(bounds.most[row], consumed[d]);
      ASSERT_LE(bounds.floor[row], consumed[d]);
      ASSERT_GE(bounds.ceiling[row], consumed[d]);
    }
    ASSERT_TRUE(bounds.may_end(node, consumed));
    ASSERT_LE(bounds.cost_from_entry[node], cost);
    ASSERT_LE(bounds.cost_to_exit[node], path.cost - cost);
  }
}

TEST(ResourceBounds, HoldForTheBestPathsOfRandomGraphs) {
  Rng rng = property_rng("ResourceBounds");
  int feasible = 0;
  for (int i = 0; i < iterations(600); ++i) {
    const SearchGraph graph = i % 2 == 0 ? plat::testing::random_search_graph(rng)
                                         : compile(plat::testing::random_plain_problem(rng)).graph;
    const ResourceBounds bounds = resource_bounds(graph);
    const auto best = k_best_paths(graph, 60);
    feasible += best.empty() ? 0 : 1;
    for (const SequencePath& path : best) {
      SCOPED_TRACE(i);
      expect_within(graph, bounds, path);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(4 * feasible, iterations(600));
}

}  // namespace
}  // namespace plat::sequences
