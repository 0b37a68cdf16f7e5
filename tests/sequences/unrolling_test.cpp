#include "sequences/unrolling.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/failure.h"
#include "sequences/adjacency.h"
#include "sequences/support/structure_brute_force.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::arrangements_of_all_paths;
using plat::testing::iterations;
using plat::testing::PlainArrangement;
using plat::testing::property_rng;
using plat::testing::random_structure_problem;

// Elements 0 and 1 fill; 2 and 3 are key elements, with arms of 1, 2 and 3 at left, right and stem.
constexpr ElementIndex kA = 0;
constexpr ElementIndex kB = 1;
constexpr ElementIndex kK = 2;
constexpr ElementIndex kL = 3;

SequenceDatabase four_elements() {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  database.elements = {{.name = "a", .uses = {2}},
                       {.name = "b", .uses = {3}},
                       {.name = "k", .uses = {10}, .arms = {{1}, {2}, {3}}, .is_filling = false},
                       {.name = "l", .uses = {20}, .arms = {{1}, {2}, {3}}, .is_filling = false}};
  return database;
}

/// Everything may stand right of everything at a cost that tells who, and left of a stem.
SequenceDatabase four_elements_that_touch() {
  SequenceDatabase database = four_elements();
  for (ElementIndex from = 0; from < 4; ++from)
    for (ElementIndex to = 0; to < 4; ++to) {
      database.transitions.push_back({.from = from, .to = to, .cost = 1 + 10 * from + to});
      database.transitions.push_back(
          {.from = from, .to = to, .from_port = Port::kStem, .cost = 100 + 10 * from + to});
    }
  return database;
}

Segment between(std::optional<std::uint32_t> from, std::optional<std::uint32_t> to,
                std::vector<Bounds> bounds = {}) {
  Segment segment;
  segment.from = from;
  segment.to = to;
  segment.bounds = std::move(bounds);
  return segment;
}

/// A T: free end -s0- T -s1- free end, and s2 from its stem to a free end.
SequenceProblem one_t() {
  SequenceProblem problem{four_elements_that_touch(), {}, {}};
  problem.structure.key_points = {{"t", {kK, kL}}};
  problem.structure.segments = {between(std::nullopt, 0, {{7, 7}}),
                                between(0, std::nullopt, {{8, 8}}),
                                between(0, std::nullopt, {{5, 6}})};
  problem.structure.segments[2].from_port = Port::kStem;
  return problem;
}

/// [Har, Fig. 3.4]: the branch once for each element of the T, the rest once.
TEST(Unrolling, CopiesABranchForEachElementAtItsStart) {
  const auto compiled = compile(one_t());
  const SearchGraph& graph = compiled.graph;
  // s0; T; T at its stem; s2 for k and for l; T' at its right; s1
  std::vector<std::uint32_t> sizes;
  for (const Zone& zone : graph.zones) sizes.push_back(zone.size);
  EXPECT_EQ(sizes, (std::vector<std::uint32_t>{2, 2, 2, 2, 2, 2, 2}));
  const Placement t_is_k{kK, Placement::Place::kKeyPoint, 0};
  EXPECT_EQ(compiled.placements[2], t_is_k);
  EXPECT_EQ(compiled.placements[4], std::nullopt);
  EXPECT_EQ(compiled.placements[6], (Placement{kA, Placement::Place::kSegment, 2}));
  EXPECT_EQ(compiled.placements[8], (Placement{kA, Placement::Place::kSegment, 2}));
  EXPECT_EQ(compiled.placements[10], std::nullopt);
  // From k at the stem to the first copy, from there without a cost to k', not to l'.
  const auto targets = [&graph](std::uint32_t node) {
    std::vector<std::uint32_t> to;
    const auto [first, last] = graph.links_from(node);
    for (auto link = first; link < last; ++link) to.push_back(graph.links[link].to);
    return to;
  };
  using Nodes = std::vector<std::uint32_t>;
  EXPECT_EQ(targets(2), Nodes{4});
  EXPECT_EQ(targets(4), (Nodes{6, 7}));
  EXPECT_EQ(targets(5), (Nodes{8, 9}));
  EXPECT_EQ(targets(7), Nodes{10});
  EXPECT_EQ(targets(9), Nodes{11});
  EXPECT_EQ(graph.links[graph.links_from(7).first].cost, 0);
  // Nobody knows T any more.
  EXPECT_EQ(targets(10), (Nodes{12, 13}));
  EXPECT_EQ(targets(11), (Nodes{12, 13}));
}

TEST(Unrolling, CountsArmsInSegmentsAndAKeyElementOnceInTheWhole) {
  SequenceProblem problem = one_t();
  problem.bounds = {{0, 1000}};
  const auto compiled = compile(problem);
  const SearchGraph& graph = compiled.graph;
  ASSERT_EQ(graph.dimension_count, 2U);
  EXPECT_TRUE(compiled.dimensions[1].is_local);
  const auto uses = [&graph](std::uint32_t node) {
    return std::pair(graph.uses(node)[0], graph.uses(node)[1]);
  };
  EXPECT_EQ(uses(2), std::pair(10, 1));  // k is placed, its left arm in s0
  EXPECT_EQ(uses(4), std::pair(0, 3));   // its stem in s2
  EXPECT_EQ(uses(10), std::pair(0, 2));  // its right arm in s1
  EXPECT_EQ(uses(6), std::pair(2, 2));
  EXPECT_TRUE(graph.zones[2].resets[1]);
  EXPECT_FALSE(graph.zones[2].resets[0]);
  EXPECT_EQ(graph.zones[3].bounds[1], (Bounds{5, 6}));
  const auto all = arrangements_of_all_paths(compiled, problem);
  ASSERT_TRUE(all && !all->empty());
  // s0: 7 - 1 = 2 + 2 + 2 or 3 + 3; s1: 8 - 2 likewise; s2: 5 - 3 = 2 or 6 - 3 = 3; T: 2 ways
  EXPECT_EQ(all->size(), 2U * 2U * 2U * 2U);
  for (const auto& found : *all) {
    std::int64_t length = found.key_points[0] == kK ? 10 : 20;
    for (const auto& row : found.segments)
      for (const ElementIndex e : row) length += e == kA ? 2 : 3;
    EXPECT_EQ(found.consumed[0], length);
  }
}

/// A closed curve of two key points.
SequenceProblem loop_of_two() {
  SequenceProblem problem{four_elements_that_touch(), {{0, 50}}, {}};
  problem.structure.key_points = {{"first", {kK, kL}}, {"second", {kK, kL}}};
  problem.structure.segments = {between(0, 1, {{5, 5}}), between(1, 0, {{6, 6}})};
  return problem;
}

/// [Har, Fig. 3.5]: the whole curve once for each element at the split, closed at a real cost.
TEST(Unrolling, CopiesAClosedCurveForEachElementAtItsSplit) {
  SequenceProblem problem = loop_of_two();
  for (auto& segment : problem.structure.segments) segment.may_be_empty = false;
  const auto compiled = compile(problem);
  const SearchGraph& graph = compiled.graph;
  // start (k, l); s0 for k, l; second (k, l each with the start); s1's start; s1 for k, l; start'
  std::vector<std::uint32_t> sizes;
  for (const Zone& zone : graph.zones) sizes.push_back(zone.size);
  EXPECT_EQ(sizes, (std::vector<std::uint32_t>{2, 2, 2, 4, 4, 2, 2, 2}));
  EXPECT_EQ(graph.entries.size(), 2U);
  ASSERT_EQ(graph.exits.size(), 2U);
  EXPECT_EQ(graph.exits[0].node, 18U);
  EXPECT_EQ(compiled.placements[18], std::nullopt);
  EXPECT_EQ(graph.uses(18)[0], 0);
  EXPECT_EQ(graph.uses(18)[1], 1);
  for (const Link& link : graph.links) {
    if (link.to < 18) continue;
    const std::uint32_t copy = (link.from - 14) / 2;
    EXPECT_EQ(link.to - 18, copy) << "a copy closes with the element that it began with";
    const ElementIndex last = (link.from - 14) % 2;
    const ElementIndex start = copy == 0 ? kK : kL;
    EXPECT_EQ(link.cost, 1 + 10 * last + start);
  }
}

TEST(Unrolling, ClosesASegmentFromAKeyPointToItself) {
  SequenceProblem problem{four_elements_that_touch(), {}, {}};
  problem.structure.key_points = {{"only", {kK, kL}}};
  problem.structure.segments = {between(0, 0, {{8, 8}})};
  const auto all = arrangements_of_all_paths(compile(problem), problem);
  ASSERT_TRUE(all.has_value());
  // 8 - 2 - 1 = 5 = a b or b a, with k or l
  ASSERT_EQ(all->size(), 4U);
  EXPECT_EQ(all->front(), (PlainArrangement{21 + 2 + 13, {kK}, {{kA, kB}}, {15}}));
}

TEST(Unrolling, MakesNoCopiesInAChainAndOneTablePerDirection) {
  SequenceProblem problem{four_elements_that_touch(), {{0, 90}}, {}};
  for (int i = 0; i < 3; ++i) problem.structure.key_points.push_back({"", {kK, kL}});
  problem.structure.segments = {between(std::nullopt, 0), between(0, 1), between(1, 2),
                                between(2, std::nullopt)};
  const auto count_tables = [](const SearchGraph& graph) {
    return std::ranges::count_if(graph.zones, [](const Zone& zone) { return !!zone.table; });
  };
  const auto straight = compile(problem);
  EXPECT_EQ(count_tables(straight.graph), 4);
  EXPECT_EQ(straight.graph.tables.size(), 1U);
  for (const std::size_t s : {1U, 2U}) problem.structure.segments[s].is_reversed = true;
  const auto turned = compile(problem);
  EXPECT_EQ(count_tables(turned.graph), 4);
  EXPECT_EQ(turned.graph.tables.size(), 2U);
}

TEST(Unrolling, LeavesOutKeyElementsThatHaveNoNeighbourAtAPort) {
  SequenceProblem problem = one_t();
  std::erase_if(problem.database.transitions, [](const Transition& transition) {
    return transition.from == kK && transition.from_port == Port::kStem;
  });
  const auto compiled = compile(problem);
  for (const auto& placement : compiled.placements)
    EXPECT_FALSE(placement && placement->element == kK);
  EXPECT_EQ(compiled.graph.zones.size(), 6U);
}

TEST(Unrolling, HasNoPathWhereNoKeyElementHasNeighbours) {
  SequenceProblem problem = one_t();
  problem.structure.key_points[0].allowed = {kK};
  std::erase_if(problem.database.transitions,
                [](const Transition& transition) { return transition.from == kK; });
  const auto all = arrangements_of_all_paths(compile(problem), problem);
  ASSERT_TRUE(all.has_value());
  EXPECT_TRUE(all->empty());
}

TEST(Unrolling, CountsWhatTransitionsAtKeyPointsConsume) {
  SequenceProblem problem = one_t();
  for (auto& transition : problem.database.transitions)
    if (transition.from == kK) transition.uses = {1};
  const auto all = arrangements_of_all_paths(compile(problem), problem);
  ASSERT_TRUE(all.has_value());
  // With k, s1 has 8 - 2 - 1 left, and s2 2 of 6 - 3 - 1; with l, as without such transitions.
  EXPECT_EQ(all->size(), 2U * 2U * 1U + 2U * 2U * 2U);
  for (const auto& found : *all) {
    const bool is_k = found.key_points[0] == kK;
    std::int64_t length = is_k ? 10 + 2 : 20;
    for (const auto& row : found.segments)
      for (const ElementIndex e : row) length += e == kA ? 2 : 3;
    EXPECT_EQ(found.consumed[0], length);
    if (is_k) {
      EXPECT_EQ(found.segments[2], std::vector<ElementIndex>{kA});
    }
  }
}

TEST(Unrolling, TellsWhichTransitionAnArcOrLinkIs) {
  Rng rng = property_rng("unrolling.transitions");
  for (int i = 0; i < iterations(60); ++i) {
    const auto problem = random_structure_problem(rng);
    const auto compiled = compile(problem);
    const auto& transitions = problem.database.transitions;
    ASSERT_EQ(compiled.link_transitions.size(), compiled.graph.links.size());
    for (std::size_t l = 0; l < compiled.graph.links.size(); ++l) {
      const auto t = compiled.link_transitions[l];
      ASSERT_EQ(compiled.graph.links[l].cost, t == kNoTransition ? 0 : transitions[t].cost);
    }
    for (std::size_t t = 0; t < compiled.graph.tables.size(); ++t) {
      const auto& arcs = compiled.graph.tables[t].arcs;
      ASSERT_EQ(compiled.arc_transitions[t].size(), arcs.size());
      for (std::size_t a = 0; a < arcs.size(); ++a)
        ASSERT_EQ(arcs[a].cost, transitions[compiled.arc_transitions[t][a]].cost);
    }
  }
}

TEST(Unrolling, RefusesMoreLinksThanItMayMake) {
  SequenceProblem problem{four_elements_that_touch(), {{0, 90}}, {}};
  for (ElementIndex e = 0; e < 400; ++e)
    problem.database.elements.push_back({.name = "k", .uses = {1}, .is_filling = false});
  std::vector<ElementIndex> many;
  for (ElementIndex e = 4; e < 404; ++e) many.push_back(e);
  for (const ElementIndex e : many) {
    for (const Port port : {Port::kLeft, Port::kRight, Port::kStem})
      problem.database.transitions.push_back({.from = e, .to = kA, .from_port = port});
    problem.database.transitions.push_back({.from = kA, .to = e});
  }
  problem.database.transitions.push_back({.from = kA, .to = kA, .cost = 1});
  problem.structure.key_points = {{"0", many}, {"1", many}, {"2", many}, {"3", many}};
  problem.structure.segments = {between(0, 1), between(1, 0)};
  problem.structure.key_points.resize(2);
  EXPECT_NO_THROW(compile(problem));
  problem.structure.key_points = {{"0", many}, {"1", many}, {"2", many}};
  problem.structure.segments = {between(0, 1), between(1, 0), between(0, 2), between(2, 1)};
  problem.structure.segments[2].from_port = Port::kStem;
  problem.structure.segments[3].to_port = Port::kStem;
  EXPECT_THROW(compile(problem), InputError);
}

TEST(Adjacency, FindsATransitionFromBothEndsHoweverItIsStored) {
  SequenceDatabase database = four_elements();
  database.transitions = {{.from = kA, .to = kB},
                          {.from = kB, .to = kA, .from_port = Port::kLeft, .to_port = Port::kRight},
                          {.from = kK, .to = kK, .from_port = Port::kStem, .to_port = Port::kStem}};
  const Adjacency adjacency(database);
  const auto from_a = adjacency.of(kA, Port::kRight, Port::kLeft);
  ASSERT_EQ(from_a.size(), 2U);
  EXPECT_EQ(from_a[0].head, kB);
  EXPECT_EQ(from_a[1].transition, 1U);
  EXPECT_EQ(adjacency.of(kB, Port::kLeft, Port::kRight).size(), 2U);
  EXPECT_TRUE(adjacency.of(kB, Port::kRight, Port::kLeft).empty());
  EXPECT_EQ(adjacency.of(kK, Port::kStem, Port::kStem).size(), 1U);
}

}  // namespace
}  // namespace plat::sequences
