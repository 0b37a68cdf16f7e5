#include "sequences/label_setting_search.h"

#include <gtest/gtest.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/r_c_shortest_paths.hpp>

#include "sequences/compiled_problem.h"
#include "sequences/support/brute_force.h"
#include "sequences/support/contract.h"
#include "sequences/support/random_problems.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::k_best_paths;
using plat::testing::property_rng;
using plat::testing::why_not_in_contract;
using Pruning = LabelSettingSearch::Pruning;

TEST(LabelSettingSearch, HoldsItsContractWithAndWithoutPruning) {
  Rng rng = property_rng("LabelSettingSearch");
  int feasible = 0;
  for (int i = 0; i < iterations(200); ++i) {
    const SearchGraph graph = i % 2 == 0 ? plat::testing::random_search_graph(rng)
                                         : compile(plat::testing::random_plain_problem(rng)).graph;
    const std::size_t k = 1 + rng.index(40);
    const auto best = k_best_paths(graph, k);
    feasible += best.empty() ? 0 : 1;
    for (const auto pruning : {Pruning::kNone, Pruning::kBounds})
      ASSERT_EQ(why_not_in_contract(LabelSettingSearch({.pruning = pruning}), graph, best, k), "")
          << i << " " << static_cast<int>(pruning);
  }
  EXPECT_GT(4 * feasible, iterations(200));
}

/// a, b1 or b2, c: by b1 it is cheaper, by b2 longer.
SearchGraph two_ways(Bounds length) {
  SequenceDatabase database;
  database.resources = {{"length"}};
  database.elements = {{.name = "a", .uses = {1}, .is_back = false},
                       {.name = "b1", .uses = {2}, .is_front = false, .is_back = false},
                       {.name = "b2", .uses = {4}, .is_front = false, .is_back = false},
                       {.name = "c", .uses = {1}, .is_front = false}};
  database.transitions = {{.from = 0, .to = 1, .cost = 1},
                          {.from = 0, .to = 2, .cost = 5},
                          {.from = 1, .to = 3, .cost = 1},
                          {.from = 2, .to = 3, .cost = 1}};
  return compile(plain_sequence(std::move(database), {length})).graph;
}

std::vector<Cost> costs(const SearchGraph& graph, const LabelSettingSearch::Options& options) {
  const auto stream = LabelSettingSearch(options).search(graph);
  const auto paths = find_paths(**stream, 10);
  std::vector<Cost> out;
  for (const SequencePath& path : *paths) out.push_back(path.cost);
  return out;
}

TEST(LabelSettingSearch, DoesNotLetLessDominateWhereThereIsAMinimum) {
  // With less is better the way by b1 would bring that by b2 to fall, the only feasible one.
  for (const auto pruning : {Pruning::kNone, Pruning::kBounds}) {
    EXPECT_EQ(costs(two_ways({6, 6}), {.pruning = pruning}), (std::vector<Cost>{6}));
    EXPECT_EQ(costs(two_ways({5, kUnbounded}), {.pruning = pruning}), (std::vector<Cost>{6}));
    EXPECT_EQ(costs(two_ways({0, 5}), {.pruning = pruning}), (std::vector<Cost>{2}));
    EXPECT_EQ(costs(two_ways({0, 6}), {.pruning = pruning}), (std::vector<Cost>{2, 6}));
  }
}

TEST(LabelSettingSearch, MakesFewerLabelsWithBounds) {
  const SearchGraph graph = two_ways({6, 6});
  const auto labels = [&](Pruning pruning) {
    const auto stream = LabelSettingSearch({.pruning = pruning}).search(graph);
    EXPECT_EQ(find_paths(**stream, 1)->size(), 1U);
    return (*stream)->statistics().states_created;
  };
  EXPECT_LT(labels(Pruning::kBounds), labels(Pruning::kNone));
}

TEST(LabelSettingSearch, GivesUpBeyondItsLimitsAndSaysSoAgain) {
  const SearchGraph graph = two_ways({6, 6});
  for (const auto& options : {LabelSettingSearch::Options{Pruning::kNone, 2, 1.0},
                              LabelSettingSearch::Options{Pruning::kNone, 2'000'000, 1e-6}}) {
    const auto stream = LabelSettingSearch(options).search(graph);
    SequencePath path;
    for (int again = 0; again < 2; ++again) {
      const auto more = (*stream)->next(path);
      ASSERT_FALSE(more.has_value());
      EXPECT_EQ(more.error().code, FailureCode::kTooManyStates);
    }
  }
}

// ---- why the overload for one path is not used (boostorg/graph, issue 363) ----

struct Arc {
  int cost = 0;
  int use = 0;
};
using BoostGraph =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, Arc>;
using BoostEdge = boost::graph_traits<BoostGraph>::edge_descriptor;

struct Consumed {
  int cost = 0;
  int use = 0;
  friend bool operator<(const Consumed& a, const Consumed& b) { return a.cost < b.cost; }
};

struct Extend {
  bool operator()(const BoostGraph& graph, Consumed& next, const Consumed& last,
                  BoostEdge edge) const {
    next = {last.cost + graph[edge].cost, last.use + graph[edge].use};
    return next.use <= 9;
  }
};

bool dominates(const Consumed& a, const Consumed& b) { return a.cost <= b.cost && a.use <= b.use; }

/// Straight from 0 to 2 at cost 10, or by 1 at cost 2 and one unit more.
BoostGraph shortcut_and_detour() {
  BoostGraph graph(3);
  add_edge(0, 2, Arc{10, 1}, graph);
  add_edge(0, 1, Arc{1, 1}, graph);
  add_edge(1, 2, Arc{1, 1}, graph);
  return graph;
}

TEST(BoostSingleSolution, GivesTheFirstLabelMadeAtTheTargetInsteadOfTheCheapest) {
  const BoostGraph graph = shortcut_and_detour();
  const std::map<BoostEdge, int> no_indices;
  std::vector<BoostEdge> path;
  Consumed consumed;
  boost::r_c_shortest_paths(graph, get(boost::vertex_index, graph),
                            boost::make_assoc_property_map(no_indices), 0U, 2U, path, consumed,
                            Consumed{}, Extend{}, dominates);
  // The search ends when the cheapest label, of cost 2, is popped; what it returns is the front of
  // the target's list.
  EXPECT_EQ(consumed.cost, 10);
}

TEST(BoostSingleSolution, IsRightWhereAllParetoOptimalPathsAreAskedFor) {
  const BoostGraph graph = shortcut_and_detour();
  const std::map<BoostEdge, int> no_indices;
  std::vector<std::vector<BoostEdge>> paths;
  std::vector<Consumed> consumed;
  boost::r_c_shortest_paths(graph, get(boost::vertex_index, graph),
                            boost::make_assoc_property_map(no_indices), 0U, 2U, paths, consumed,
                            Consumed{}, Extend{}, dominates);
  ASSERT_EQ(consumed.size(), 2U);
  EXPECT_EQ(std::min(consumed[0].cost, consumed[1].cost), 2);
}

}  // namespace
}  // namespace plat::sequences
