#include "sequences/forward_search.h"

#include <gtest/gtest.h>

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
using Dominance = ForwardSearch::Dominance;

/// Two elements of 1 and 2 quanta that may follow each other and themselves, at costs 0 to 3.
SearchGraph two_elements(Bounds length) {
  SequenceDatabase database;
  database.resources = {{"length"}};
  database.elements = {{.name = "a", .uses = {1}}, {.name = "b", .uses = {2}}};
  database.transitions = {{.from = 0, .to = 0, .cost = 3},
                          {.from = 0, .to = 1, .cost = 0},
                          {.from = 1, .to = 0, .cost = 1},
                          {.from = 1, .to = 1, .cost = 2}};
  return compile(plain_sequence(std::move(database), {length})).graph;
}

SearchStatistics statistics_after(const SearchGraph& graph, Dominance dominance, std::size_t k) {
  const auto stream = ForwardSearch({.dominance = dominance}).search(graph);
  EXPECT_TRUE(find_paths(**stream, k).has_value());
  return (*stream)->statistics();
}

TEST(ForwardSearch, HoldsItsContractUnderEveryDominance) {
  Rng rng = property_rng("ForwardSearch");
  int feasible = 0;
  int finished = 0;
  for (int i = 0; i < iterations(500); ++i) {
    const SearchGraph graph = i % 2 == 0 ? plat::testing::random_search_graph(rng)
                                         : compile(plat::testing::random_plain_problem(rng)).graph;
    const std::size_t k = 1 + rng.index(40);
    const auto best = k_best_paths(graph, k);
    feasible += best.empty() ? 0 : 1;
    for (const auto dominance : {Dominance::kStates, Dominance::kBounds})
      ASSERT_EQ(why_not_in_contract(ForwardSearch({dominance, 300'000}), graph, best, k), "") << i;
    // Without dominance only the limit ends a search in circles.
    const auto none =
        why_not_in_contract(ForwardSearch({Dominance::kNone, 30'000}), graph, best, k);
    if (none == plat::testing::kGivesUp) continue;
    ++finished;
    ASSERT_EQ(none, "") << i;
  }
  EXPECT_GT(2 * finished, iterations(500));
  EXPECT_GT(4 * feasible, iterations(500));
}

TEST(ForwardSearch, ExpandsEachStateOnceForOnePath) {
  const SearchGraph graph = two_elements({40, 40});
  const SearchStatistics once = statistics_after(graph, Dominance::kStates, 1);
  EXPECT_LE(once.states_expanded, once.states_created);
  EXPECT_LE(once.states_created, 2U * 41U);
  EXPECT_GT(statistics_after(graph, Dominance::kNone, 1).states_expanded, 10 * once.states_created);
}

TEST(ForwardSearch, DoesNotEnterADeadEndWithBounds) {
  SequenceDatabase database;
  database.resources = {{"length"}};
  database.elements = {{.name = "a", .uses = {1}},
                       {.name = "trap", .uses = {1}, .is_front = false, .is_back = false}};
  database.transitions = {{.from = 0, .to = 0, .cost = 2},
                          {.from = 0, .to = 1, .cost = 0},
                          {.from = 1, .to = 1, .cost = 0}};
  const auto graph = compile(plain_sequence(std::move(database), {{20, 20}})).graph;
  EXPECT_EQ(statistics_after(graph, Dominance::kStates, 1).states_created, 20U + 19U);
  EXPECT_EQ(statistics_after(graph, Dominance::kBounds, 1).states_created, 20U);
}

TEST(ForwardSearch, FollowsSeveralWaysToAStateOnlyWhenMorePathsAreAskedFor) {
  const SearchGraph graph = two_elements({12, 12});
  const auto one = statistics_after(graph, Dominance::kStates, 1);
  const auto four = statistics_after(graph, Dominance::kStates, 4);
  EXPECT_GT(four.states_expanded, one.states_expanded);
  // One run with one way to a state, and one run with four.
  EXPECT_LE(four.states_expanded, (1U + 4U) * 2U * 13U);
}

TEST(ForwardSearch, GivesUpBeyondItsLimitAndSaysSoAgain) {
  const SearchGraph graph = two_elements({60, 60});
  const auto stream =
      ForwardSearch({.dominance = Dominance::kNone, .max_states = 100}).search(graph);
  ASSERT_TRUE(stream.has_value());
  SequencePath path;
  for (int again = 0; again < 2; ++again) {
    const auto more = (*stream)->next(path);
    ASSERT_FALSE(more.has_value());
    EXPECT_EQ(more.error().code, FailureCode::kTooManyStates);
  }
}

TEST(ForwardSearch, CountsAmountsBeyondAMinimumAsOne) {
  const auto statistics = statistics_after(two_elements({3, kUnbounded}), Dominance::kStates, 1);
  EXPECT_LE(statistics.states_created, 2U * 4U);
}

}  // namespace
}  // namespace plat::sequences
