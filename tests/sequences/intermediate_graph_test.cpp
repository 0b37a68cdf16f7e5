#include "sequences/intermediate_graph.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "sequences/compiled_problem.h"
#include "sequences/intermediate_graph_search.h"
#include "sequences/intermediate_graph_trace.h"
#include "sequences/or_library.h"
#include "sequences/support/brute_force.h"
#include "sequences/support/contract.h"
#include "sequences/support/random_problems.h"
#include "sequences/support/thesis_construction.h"
#include "support/data_folder.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::nodes_on_feasible_paths;
using plat::testing::property_rng;
using plat::testing::random_plain_problem;
using plat::testing::random_search_graph;
using plat::testing::thesis_construction;
using plat::testing::ThesisNode;
using plat::testing::ThesisReading;
using plat::testing::why_not_in_contract;

/// [Har, Fig. 3.1] in kind: three elements, an interval for the first resource, an equality for the
/// second. a uses (1, 0), b (1, 1), c (2, 1); every element may follow every other but itself.
SearchGraph three_elements() {
  SequenceDatabase database;
  database.resources = {{"lambda1", 1.0}, {"lambda2", 1.0}};
  database.elements = {{.name = "a", .uses = {1, 0}, .is_back = false},
                       {.name = "b", .uses = {1, 1}},
                       {.name = "c", .uses = {2, 1}, .is_front = false}};
  for (ElementIndex from = 0; from < 3; ++from)
    for (ElementIndex to = 0; to < 3; ++to)
      if (from != to)
        database.transitions.push_back({.from = from, .to = to, .cost = Cost{1} + 3 * from + to});
  return compile(plain_sequence(database, {{4, 5}, {2, 2}})).graph;
}

std::set<ThesisNode> states_of(const SearchGraph& graph, const GrowthLimits& limits = {}) {
  const auto built = IntermediateGraph::build(graph, limits);
  std::set<ThesisNode> states;
  for (std::uint32_t state = 0; state < built->state_count(); ++state) {
    const auto consumed = built->consumed(state);
    states.insert({built->node(state), built->level(state), {consumed.begin(), consumed.end()}});
  }
  EXPECT_EQ(states.size(), built->state_count());
  return states;
}

/// Problems of the thesis's kind: one zone, maxima everywhere, transitions that consume nothing.
SearchGraph random_thesis_problem(Rng& rng, std::uint32_t resources) {
  while (true) {
    auto problem = random_plain_problem(rng, {.resources = resources});
    for (auto& transition : problem.database.transitions) transition.uses.clear();
    for (auto& bounds : problem.bounds)
      if (bounds.max == kUnbounded) bounds.max = bounds.min + 3;
    bool is_free = false;
    SearchGraph graph;
    try {
      graph = compile(problem).graph;
    } catch (const InputError&) {
      is_free = true;
    }
    if (!is_free && graph.dimension_count > 0) return graph;
  }
}

TEST(IntermediateGraph, HoldsThreeElementsAsDrawn) {
  // Two of b and c, no two the same in a row, a or b in front, b or c at the back: b c (3, 2) is
  // too short, a b c is (4, 2), b a c too, a b a c is (5, 2), a b a b is (4, 2).
  const auto states = states_of(three_elements());
  EXPECT_TRUE(states.contains({0, 0, {1, 0}}));   // a in front
  EXPECT_TRUE(states.contains({2, 3, {4, 2}}));   // the c of a b c, behind (2, 1)
  EXPECT_TRUE(states.contains({2, 4, {5, 2}}));   // the c of a b a c
  EXPECT_TRUE(states.contains({1, 4, {4, 2}}));   // the last b of a b a b
  EXPECT_FALSE(states.contains({2, 0, {2, 1}}));  // c is no front
  EXPECT_FALSE(states.contains({2, 2, {3, 2}}));  // the c of b c
}

TEST(IntermediateGraph, IsTheThesissGraphNodeByNode) {
  int with_states = 0;
  int in_all = 0;
  for (const std::uint32_t resources : {1U, 4U}) {
    Rng rng = property_rng("thesis" + std::to_string(resources));
    for (int i = 0; i < iterations(250); ++i) {
      const SearchGraph graph = random_thesis_problem(rng, resources);
      const auto states = states_of(graph);
      ASSERT_EQ(states, nodes_on_feasible_paths(graph)) << resources << " case " << i;
      for (const auto order :
           {ThesisReading::BackwardOrder::kConsumed, ThesisReading::BackwardOrder::kConsumedBefore})
        ASSERT_EQ(states, thesis_construction(graph, {.backward_order = order}).nodes)
            << resources << " case " << i;
      with_states += states.empty() ? 0 : 1;
      ++in_all;
    }
  }
  EXPECT_GT(3 * with_states, in_all);
}

/// What ADR 0019 says of the text as it stands: nodes are lost where a side may not go on from what
/// the other side was at before, or where sides are compared by levels; none is ever too many.
TEST(IntermediateGraph, IsMoreThanTheTextWordForWord) {
  Rng rng = property_rng("word for word");
  int fewer = 0;
  for (int i = 0; i < iterations(400); ++i) {
    const SearchGraph graph = random_thesis_problem(rng, 1 + i % 2);
    const auto states = states_of(graph);
    const auto literal =
        thesis_construction(graph, {.backward_order = ThesisReading::BackwardOrder::kConsumed,
                                    .meeting = ThesisReading::Meeting::kLevels,
                                    .expansion = ThesisReading::Expansion::kOwnDirection});
    ASSERT_TRUE(std::ranges::includes(states, literal.nodes)) << i;
    fewer += literal.nodes.size() < states.size() ? 1 : 0;
  }
  EXPECT_GT(fewer, 0);
}

TEST(IntermediateGraph, DoesNotDependOnWhereTheSidesMeet) {
  Rng rng = property_rng("meeting");
  int different = 0;
  for (int i = 0; i < iterations(600); ++i) {
    const SearchGraph graph =
        i % 2 == 0 ? random_search_graph(rng) : compile(random_plain_problem(rng)).graph;
    const auto both = IntermediateGraph::build(graph, {.max_end_states = 1'000'000});
    const auto front = IntermediateGraph::build(graph, {.max_end_states = 0});
    ASSERT_EQ(both->state_count(), front->state_count()) << i;
    for (std::uint32_t state = 0; state < both->state_count(); ++state) {
      ASSERT_EQ(both->node(state), front->node(state)) << i;
      ASSERT_TRUE(std::ranges::equal(both->consumed(state), front->consumed(state))) << i;
    }
    different += both->created_count() != front->created_count() ? 1 : 0;
  }
  EXPECT_GT(4 * different, iterations(600));
}

TEST(IntermediateGraph, LeavesItsStatesInTopologicalOrder) {
  Rng rng = property_rng("order");
  for (int i = 0; i < iterations(200); ++i) {
    const SearchGraph graph = random_search_graph(rng);
    const auto built = IntermediateGraph::build(graph, {});
    for (std::uint32_t state = 0; state < built->state_count(); ++state)
      built->for_each_arc(state, [&](std::uint32_t, std::uint32_t head, Cost) {
        EXPECT_TRUE(head > state || built->group(head) == built->group(state)) << i;
      });
  }
}

TEST(IntermediateGraph, SaysWhenThereAreTooManyStatesOrBytes) {
  for (const GrowthLimits limits :
       {GrowthLimits{.max_states = 3}, GrowthLimits{.max_bytes = 300}}) {
    const auto built = IntermediateGraph::build(three_elements(), limits);
    ASSERT_FALSE(built.has_value());
    EXPECT_EQ(built.error().code, FailureCode::kTooManyStates);
  }
}

TEST(IntermediateGraphTrace, TellsSidesAndDeadEnds) {
  const SearchGraph graph = three_elements();
  const auto trace = trace_intermediate_graph(graph);
  std::set<ThesisNode> alive;
  std::set<TracedState::Side> sides;
  for (const auto& state : trace->states) {
    if (!state.is_pruned) alive.insert({state.node, state.level, state.consumed});
    sides.insert(state.side);
    for (std::size_t d = 0; d < 2; ++d) EXPECT_GE(state.consumed[d], graph.uses(state.node)[d]);
  }
  EXPECT_EQ(alive, states_of(graph));
  EXPECT_EQ(sides.size(), 3U);
  EXPECT_LT(alive.size(), trace->states.size());
  EXPECT_TRUE(std::ranges::is_sorted(trace->arcs, {}, &TracedArc::from));
  for (const auto& arc : trace->arcs) {
    const auto& head = trace->states[arc.to];
    EXPECT_EQ(head.level,
              trace->states[arc.from].consumed[0] + trace->states[arc.from].consumed[1]);
  }
}

TEST(IntermediateGraphSearch, HoldsItsContractFromBothEndsAndFromTheFrontAlone) {
  Rng rng = property_rng("IntermediateGraphSearch");
  for (int i = 0; i < iterations(300); ++i) {
    const SearchGraph graph =
        i % 2 == 0 ? random_search_graph(rng) : compile(random_plain_problem(rng)).graph;
    const auto best = plat::testing::k_best_paths(graph, 50);
    for (const std::uint32_t max_end_states : {0U, 1'000'000U}) {
      const IntermediateGraphSearch search({.max_end_states = max_end_states});
      ASSERT_EQ(why_not_in_contract(search, graph, best, 50), "") << i;
    }
  }
}

TEST(IntermediateGraphSearch, HoldsItsContractUnderEveryBounding) {
  using Bounding = IntermediateGraphSearch::Bounding;
  Rng rng = property_rng("bounding");
  std::uint64_t without = 0;
  std::uint64_t with_resources = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const SearchGraph graph =
        i % 2 == 0 ? random_search_graph(rng) : compile(random_plain_problem(rng)).graph;
    const auto best = plat::testing::k_best_paths(graph, 50);
    for (const auto bounding : {Bounding::kResources, Bounding::kResourcesAndCost}) {
      const IntermediateGraphSearch search({.bounding = bounding});
      ASSERT_EQ(why_not_in_contract(search, graph, best, 50), "") << i;
    }
    without += (*IntermediateGraphSearch({.max_end_states = 0}).search(graph))
                   ->statistics()
                   .states_expanded;
    with_resources += (*IntermediateGraphSearch({.bounding = Bounding::kResources}).search(graph))
                          ->statistics()
                          .states_expanded;
  }
  EXPECT_LT(with_resources, without);
}

/// [BC89]: general graphs with up to 500 vertices and 10 resources.
TEST(IntermediateGraphSearch, FindsThePublishedOptimaWithBounds) {
  PLAT_REAL_DATA_OR_SKIP(results, "rcsp_or_library/results.txt");
  const IntermediateGraphSearch search(
      {.bounding = IntermediateGraphSearch::Bounding::kResourcesAndCost});
  for (const auto& optimum : read_or_library_optima(results)) {
    const auto file = fmt::format("rcsp{}.txt", optimum.instance);
    const SearchGraph graph =
        compile(read_or_library(std::filesystem::path(results).replace_filename(file))).graph;
    const auto stream = search.search(graph);
    ASSERT_TRUE(stream.has_value()) << optimum.instance;
    const auto paths = find_paths(**stream, 1);
    ASSERT_TRUE(paths.has_value()) << optimum.instance;
    ASSERT_EQ(paths->empty(), !optimum.cost.has_value()) << optimum.instance;
    const Cost found = paths->empty() ? 0 : paths->front().cost;
    EXPECT_EQ(found, optimum.cost.value_or(0)) << optimum.instance;
  }
}

TEST(IntermediateGraphSearch, CountsTheStatesThatAreLeft) {
  const SearchGraph graph = three_elements();
  const auto stream = IntermediateGraphSearch({}).search(graph);
  const auto statistics = (*stream)->statistics();
  EXPECT_EQ(statistics.states_created, states_of(graph).size());
  EXPECT_EQ(statistics.states_created + statistics.states_pruned,
            trace_intermediate_graph(graph)->states.size());
  EXPECT_EQ(statistics.arcs_relaxed, 0U) << "the first path is searched when it is asked for";
}

}  // namespace
}  // namespace plat::sequences
