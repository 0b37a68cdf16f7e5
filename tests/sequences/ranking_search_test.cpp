#include "sequences/ranking_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "sequences/compiled_problem.h"
#include "sequences/completable_states.h"
#include "sequences/support/brute_force.h"
#include "sequences/support/contract.h"
#include "sequences/support/random_problems.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::k_best_paths;
using plat::testing::property_rng;
using plat::testing::random_plain_problem;
using plat::testing::random_search_graph;
using plat::testing::why_not_in_contract;
using Pruning = RankingSearch::Pruning;

/// Elements of 2 and 3 quanta, each may follow each; `cost` from 3 to 3, else 0.
SearchGraph two_and_three(Bounds bounds, Cost cost) {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  database.elements = {{.name = "two", .uses = {2}}, {.name = "three", .uses = {3}}};
  for (ElementIndex from = 0; from < 2; ++from)
    for (ElementIndex to = 0; to < 2; ++to)
      database.transitions.push_back(
          {.from = from, .to = to, .cost = from == 1 && to == 1 ? cost : 0});
  return compile(plain_sequence(database, {bounds})).graph;
}

/// Whether a path that has consumed so much may end, by the states that it may come to.
bool can_end(const SearchGraph& graph, std::uint32_t start, const std::vector<Amount>& begin) {
  using State = std::pair<std::uint32_t, std::vector<Amount>>;
  const Consumption consumption(graph);
  std::set<State> seen{{start, begin}};
  std::vector<State> open{{start, begin}};
  while (!open.empty()) {
    const auto [node, consumed] = open.back();
    open.pop_back();
    const std::uint32_t zone = graph.zone_of(node);
    const bool is_exit = std::ranges::find(graph.exits, node, &Terminal::node) != graph.exits.end();
    if (is_exit && consumption.may_end(zone, consumed)) return true;
    const auto reach = [&](std::uint32_t head, const std::vector<Amount>& amounts) {
      if (seen.emplace(head, amounts).second) open.emplace_back(head, amounts);
    };
    for (const Link& link : graph.links) {
      auto amounts = consumed;
      if (link.from == node && consumption.follow(link, amounts)) reach(link.to, amounts);
    }
    if (!graph.zones[zone].table) continue;
    const TransitionTable& table = graph.tables[*graph.zones[zone].table];
    const std::uint32_t local = node - graph.zones[zone].first_node;
    for (std::uint32_t arc = table.first[local]; arc < table.first[local + 1]; ++arc) {
      auto amounts = consumed;
      if (consumption.follow_arc(zone, arc, amounts))
        reach(graph.zones[zone].first_node + table.arcs[arc].head, amounts);
    }
  }
  return false;
}

TEST(RankingSearch, HoldsItsContractUnderEveryPruningWhereItDoesNotGiveUp) {
  Rng rng = property_rng("RankingSearch");
  int gave_up = 0;
  for (int i = 0; i < iterations(400); ++i) {
    const SearchGraph graph =
        i % 2 == 0 ? random_search_graph(rng) : compile(random_plain_problem(rng)).graph;
    const auto best = k_best_paths(graph, 20);
    for (const auto pruning : {Pruning::kNone, Pruning::kResources, Pruning::kStates}) {
      const RankingSearch search({.pruning = pruning, .max_walks = 2'000});
      const auto wrong = why_not_in_contract(search, graph, best, 20);
      if (wrong == plat::testing::kGivesUp)
        ++gave_up;
      else
        ASSERT_EQ(wrong, "") << i;
    }
  }
  EXPECT_LT(5 * gave_up, 3 * iterations(400));
}

TEST(RankingSearch, SaysHowManyWalksItLookedAt) {
  // 3 quanta and every further walk of cost 0 are too short or too long for 101 = 3 + 49 * 2: one
  // has to get there by trying.
  const auto stream = RankingSearch({.pruning = Pruning::kNone, .max_walks = 10})
                          .search(two_and_three({101, 101}, 1));
  SequencePath path;
  const auto found = (*stream)->next(path);
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, FailureCode::kTooManyStates);
  EXPECT_EQ(found.error().message.rfind("looked at 10 walks, of which 0", 0), 0U);
  EXPECT_EQ((*stream)->statistics().states_expanded, 10U);
}

/// [Har, Sec. 6.4]: "in the very rare case, when most of the elements concatenate with zero cost".
TEST(RankingSearch, IsSoonDoneWhereMostCostsAreZero) {
  const auto stream = RankingSearch({}).search(two_and_three({2000, 2000}, 1));
  SequencePath path;
  ASSERT_TRUE(*(*stream)->next(path));
  EXPECT_EQ(path.cost, 0);
  EXPECT_LT((*stream)->statistics().states_expanded, 3000U);
}

TEST(RankingSearch, AnswersThatThereIsNothingWithoutLookingAtMuch) {
  for (const Bounds bounds : {Bounds{1, 1}, Bounds{0, 1}}) {
    const auto stream = RankingSearch({}).search(two_and_three(bounds, 5));
    SequencePath path;
    const auto found = (*stream)->next(path);
    ASSERT_TRUE(found.has_value());
    EXPECT_FALSE(*found);
    EXPECT_LT((*stream)->statistics().states_expanded, 5U);
  }
}

/// Nothing is used until the end, so that b is tried and left while a is still open, and d, which
/// leads to b only, after that.
TEST(CompletableStates, IncludeThoseThatLeadBackToTheWayThatIsTried) {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  database.elements = {{.name = "a", .uses = {0}, .is_back = false},
                       {.name = "b", .uses = {0}, .is_back = false},
                       {.name = "d", .uses = {0}, .is_back = false},
                       {.name = "end", .uses = {1}}};
  for (const auto& [from, to] : {std::pair(0U, 1U), {0U, 2U}, {0U, 3U}, {1U, 0U}, {2U, 1U}})
    database.transitions.push_back({.from = from, .to = to, .cost = 1});
  const SearchGraph graph = compile(plain_sequence(database, {{1, 1}})).graph;
  const Consumption consumption(graph);
  const ResourceBounds bounds = resource_bounds(graph);
  CompletableStates completable(consumption, bounds, 1'000'000);
  for (const std::uint32_t node : {0U, 1U, 2U})
    EXPECT_TRUE(completable.may_end(node, std::vector<Amount>{0})) << node;
}

TEST(CompletableStates, AreThoseFromWhichAPathEndsWell) {
  Rng rng = property_rng("completable");
  int yes = 0;
  int no = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const SearchGraph graph =
        i % 2 == 0 ? random_search_graph(rng) : compile(random_plain_problem(rng)).graph;
    const Consumption consumption(graph);
    const ResourceBounds bounds = resource_bounds(graph);
    CompletableStates completable(consumption, bounds, 1'000'000);
    for (int start = 0; start < 5; ++start) {
      // The same graph, begun at the state: an entry whose node uses what has been consumed.
      const auto node = static_cast<std::uint32_t>(rng.index(graph.node_count()));
      const Zone& zone = graph.zones[graph.zone_of(node)];
      std::vector<Amount> consumed;
      for (const Bounds& range : zone.bounds)
        consumed.push_back(
            static_cast<Amount>(rng.index(std::uint64_t{1} + largest_amount(range))));
      const bool is_possible = can_end(graph, node, consumed);
      ASSERT_EQ(completable.may_end(node, consumed), is_possible) << i;
      ++(is_possible ? yes : no);
    }
  }
  EXPECT_GT(yes, iterations(300));
  EXPECT_GT(no, iterations(300));
}

}  // namespace
}  // namespace plat::sequences
