#include "sequences/graph_pruning.h"

#include <gtest/gtest.h>

#include "sequences/compiled_problem.h"
#include "sequences/support/brute_force.h"
#include "sequences/support/random_problems.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::k_best_paths;
using plat::testing::property_rng;

/// a -> b -> d, a -> c -> d and a -> d from a to d; c uses too much, a -> d is dear.
SearchGraph three_ways() {
  SequenceDatabase database;
  database.resources = {{"length"}};
  database.elements = {{.name = "a", .uses = {1}, .is_back = false},
                       {.name = "b", .uses = {2}, .is_front = false, .is_back = false},
                       {.name = "c", .uses = {9}, .is_front = false, .is_back = false},
                       {.name = "d", .uses = {1}, .is_front = false}};
  database.transitions = {{.from = 0, .to = 1, .cost = 1},
                          {.from = 0, .to = 2, .cost = 1},
                          {.from = 0, .to = 3, .cost = 9},
                          {.from = 1, .to = 3, .cost = 1},
                          {.from = 2, .to = 3, .cost = 1}};
  return compile(plain_sequence(std::move(database), {{0, 10}})).graph;
}

TEST(GraphPruning, TakesAwayWhatNoFeasiblePathUses) {
  const PrunedGraph pruned = prune(three_ways());
  EXPECT_EQ(pruned.nodes, (std::vector<std::uint32_t>{0, 1, 3}));
  EXPECT_EQ(pruned.arcs.at(0), (std::vector<std::uint32_t>{0, 2, 3}));
  validate(pruned.graph);
}

TEST(GraphPruning, TakesAwayWhatIsTooDear) {
  const PrunedGraph pruned = prune(three_ways(), 2);
  EXPECT_EQ(pruned.arcs.at(0), (std::vector<std::uint32_t>{0, 3}));
  SequencePath path{2, {{0, 0}, {1, 0}, {2, 1}}};
  ASSERT_EQ(why_not_feasible(pruned.graph, path), "");
  pruned.restore(path);
  EXPECT_EQ(why_not_feasible(three_ways(), path), "");
}

TEST(GraphPruning, LeavesNoZoneWhereThereIsNoPath) {
  SearchGraph graph = three_ways();
  graph.zones[0].bounds[0] = {0, 1};
  const PrunedGraph pruned = prune(graph);
  EXPECT_TRUE(pruned.graph.zones.empty());
  EXPECT_TRUE(pruned.graph.entries.empty());
  EXPECT_EQ(pruned.graph.node_count(), 0U);
}

TEST(GraphPruning, KeepsTablesSharedThatStayAsTheyAre) {
  const SearchGraph one = three_ways();
  SearchGraph graph = one;
  graph.zones.push_back(graph.zones[0]);
  graph.zones[1].first_node = 4;
  graph.zones[1].resets = {true};
  graph.node_uses.insert(graph.node_uses.end(), one.node_uses.begin(), one.node_uses.end());
  graph.exits = {{7, 0}};
  graph.links = {{3, 4, 0}};
  validate(graph);
  const PrunedGraph pruned = prune(graph);
  EXPECT_EQ(pruned.graph.zones.size(), 2U);
  EXPECT_EQ(pruned.graph.tables.size(), 1U);
}

TEST(GraphPruning, KeepsTheBestPathsOfRandomGraphs) {
  Rng rng = property_rng("GraphPruning");
  int smaller = 0;
  int feasible = 0;
  for (int i = 0; i < iterations(600); ++i) {
    SCOPED_TRACE(i);
    const SearchGraph graph = i % 2 == 0 ? plat::testing::random_search_graph(rng)
                                         : compile(plat::testing::random_plain_problem(rng)).graph;
    const auto best = k_best_paths(graph, 40);
    std::optional<Cost> max_cost;
    if (i % 3 == 0 && !best.empty()) max_cost = best[rng.index(best.size())].cost;
    const PrunedGraph pruned = prune(graph, max_cost);
    smaller += pruned.graph.node_count() < graph.node_count() ? 1 : 0;
    feasible += best.empty() ? 0 : 1;
    if (pruned.graph.zones.empty()) {
      ASSERT_TRUE(best.empty());
      continue;
    }
    validate(pruned.graph);
    ASSERT_EQ(prune(pruned.graph, max_cost).graph.node_uses, pruned.graph.node_uses);
    auto left = k_best_paths(pruned.graph, 40);
    for (std::size_t p = 0; p < best.size() && best[p].cost <= max_cost.value_or(kNoWay); ++p) {
      ASSERT_LT(p, left.size());
      pruned.restore(left[p]);
      ASSERT_EQ(left[p].cost, best[p].cost);
      ASSERT_EQ(why_not_feasible(graph, left[p]), "");
    }
  }
  EXPECT_GT(4 * feasible, iterations(600));
  EXPECT_GT(4 * smaller, iterations(600));
}

}  // namespace
}  // namespace plat::sequences
