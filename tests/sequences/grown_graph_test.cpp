#include "sequences/grown_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sequences/compiled_problem.h"
#include "sequences/intermediate_graph.h"

namespace plat::sequences {
namespace {

/// Three elements with an interval and an equality, as in the small example of [Har, Fig. 3.1].
CompiledProblem small_example() {
  SequenceDatabase database;
  database.resources = {{"one", 1.0}, {"two", 1.0}};
  database.elements = {{.name = "A", .uses = {1, 1}, .is_back = false},
                       {.name = "B", .uses = {0, 1}, .is_front = false, .is_back = false},
                       {.name = "C", .uses = {1, 2}, .is_front = false}};
  database.transitions = {{.from = 0, .to = 0, .cost = 2}, {.from = 0, .to = 1, .cost = 1},
                          {.from = 0, .to = 2, .cost = 3}, {.from = 1, .to = 0, .cost = 1},
                          {.from = 1, .to = 2, .cost = 1}, {.from = 2, .to = 2, .cost = 2}};
  return compile(plain_sequence(database, {{2, 3}, {5, 5}}));
}

TEST(GrownGraph, HasTheStatesOfTheIntermediateGraphAlive) {
  const auto compiled = small_example();
  const auto drawn = grown_graph(compiled.graph, {});
  const auto built = IntermediateGraph::build(compiled.graph, {});
  ASSERT_TRUE(drawn && built);
  const auto alive = std::ranges::count_if(drawn->states, &GrownState::is_alive);
  EXPECT_EQ(static_cast<std::uint32_t>(alive), built->state_count());
  EXPECT_LT(static_cast<std::size_t>(alive), drawn->states.size());
  for (std::uint32_t state = 0; state < built->state_count(); ++state) {
    const auto same = [&](const GrownState& other) {
      return other.is_alive && other.node == built->node(state) &&
             std::ranges::equal(other.consumed, built->consumed(state)) &&
             other.level == built->level(state);
    };
    EXPECT_EQ(std::ranges::count_if(drawn->states, same), 1);
  }
}

TEST(GrownGraph, HasAPathOfArcsForEveryFeasiblePath) {
  const auto compiled = small_example();
  const auto drawn = grown_graph(compiled.graph, {});
  ASSERT_TRUE(drawn);
  // Ways from the entries to a state, counted in topological order.
  std::vector<int> ways(drawn->states.size(), 0);
  int paths = 0;
  for (std::size_t s = 0; s < drawn->states.size(); ++s) {
    if (drawn->states[s].is_entry) ++ways[s];
    if (drawn->states[s].is_exit) paths += ways[s];
    for (const GrownGraph::Arc& arc : drawn->arcs)
      if (arc.from == s) ways[arc.to] += ways[s];
  }
  // By hand: AABC, ABAC and ACC.
  EXPECT_EQ(paths, 3);
}

}  // namespace
}  // namespace plat::sequences
