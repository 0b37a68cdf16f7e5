#include "sequences/bound_use.h"

#include <gtest/gtest.h>

#include "sequences/support/brute_force.h"

namespace plat::sequences {
namespace {

/// Walls of 2, a corner of 3 with arms of 1 and 2, a transition that uses 1 itself.
SequenceProblem corner_problem() {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  database.elements = {
      {.name = "wall", .uses = {2}},
      {.name = "corner", .uses = {3}, .arms = {{1}, {2}, {0}}, .is_filling = false}};
  database.transitions = {
      {.from = 0, .to = 0, .cost = 1, .uses = {1}}, {.from = 0, .to = 1}, {.from = 1, .to = 0}};
  SequenceProblem problem{database, {{0, 13}}, {}};
  problem.structure.key_points = {{"corner", {1}}};
  problem.structure.segments.resize(2);
  Segment& before = problem.structure.segments[0];
  before.to = 0;
  before.bounds = {{6, 6}};
  Segment& after = problem.structure.segments[1];
  after.from = 0;
  after.bounds = {{4, 9}};
  return problem;
}

TEST(BoundUse, ListsTheWholeThenTheSegments) {
  const auto bounds = bounds_of(compile(corner_problem()));
  ASSERT_EQ(bounds.size(), 3U);
  EXPECT_EQ(bounds[0].place, (BoundPlace{0, std::nullopt}));
  EXPECT_EQ(bounds[1].place, (BoundPlace{0, 0}));
  EXPECT_EQ(bounds[1].bounds, (Bounds{6, 6}));
  EXPECT_EQ(bounds[2].place, (BoundPlace{0, 1}));
}

TEST(BoundUse, CountsElementsArmsAndTransitions) {
  const auto compiled = compile(corner_problem());
  const auto best = plat::testing::k_best_paths(compiled.graph, 10);
  ASSERT_EQ(best.size(), 2U);  // one or two walls after the corner
  const auto uses = bound_uses(compiled, best.front());
  EXPECT_EQ(uses[0].consumed, 5 + 3 + 2);  // two walls with a joint, the corner, a wall
  EXPECT_EQ(uses[1].consumed, 5 + 1);
  EXPECT_EQ(uses[2].consumed, 2 + 2);
  EXPECT_EQ(arrangement(compiled, corner_problem(), best.front()).consumed[0], 10);
}

TEST(BoundUse, CountsBeyondTheMinimumWhereThereIsNoMaximum) {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  database.elements = {{.name = "a", .uses = {5}}};
  const auto compiled = compile(plain_sequence(database, {{3, kUnbounded}}));
  const auto best = plat::testing::k_best_paths(compiled.graph, 1);
  ASSERT_EQ(best.size(), 1U);
  EXPECT_EQ(bound_uses(compiled, best.front())[0].consumed, 5);
  EXPECT_EQ(bound_uses(compiled, best.front())[0].place.segment, std::nullopt);
}

}  // namespace
}  // namespace plat::sequences
