#include <gtest/gtest.h>

#include "core/failure.h"
#include "sequences/compiled_problem.h"

namespace plat::sequences {
namespace {

/// Two elements of 2 and 3 quanta that may follow each other, but not themselves.
SequenceDatabase two_elements() {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}, {"balconies", 1.0}};
  database.elements = {{.name = "a", .uses = {2, 0}}, {.name = "b", .uses = {3, 1}}};
  database.transitions = {{.from = 0, .to = 1, .cost = 5}, {.from = 1, .to = 0, .cost = 7}};
  return database;
}

TEST(PlainCompilation, MakesADimensionOfBoundedResourcesOnly) {
  const auto compiled = compile(plain_sequence(two_elements(), {{5, 5}, {}}));
  EXPECT_EQ(compiled.graph.dimension_count, 1U);
  EXPECT_EQ(compiled.graph.node_count(), 2U);
  EXPECT_EQ(compiled.graph.uses(1)[0], 3);
}

TEST(PlainCompilation, AcceptsThePathsOfTheProblemAndNoOthers) {
  const auto compiled = compile(plain_sequence(two_elements(), {{5, 5}, {}}));
  const SequencePath ab{5, {{0, 0}, {1, 0}}};
  EXPECT_EQ(why_not_feasible(compiled.graph, ab), "");
  SequencePath dear = ab;
  dear.cost = 6;
  EXPECT_EQ(why_not_feasible(compiled.graph, dear), "costs 5, not 6");
  const SequencePath aba{12, {{0, 0}, {1, 0}, {0, 1}}};
  EXPECT_EQ(why_not_feasible(compiled.graph, aba), "dimension 0 exceeds its maximum at node 0");
  EXPECT_EQ(why_not_feasible(compiled.graph, SequencePath{0, {{0, 0}}}),
            "dimension 0 stays below its minimum");
}

TEST(PlainCompilation, RefusesACircleThatCostsAndConsumesNothing) {
  SequenceDatabase database = two_elements();
  for (auto& transition : database.transitions) transition.cost = 0;
  EXPECT_NO_THROW(compile(plain_sequence(database, {{5, 5}, {}})));
  EXPECT_THROW(compile(plain_sequence(database, {{5, kUnbounded}, {}})), InputError);
}

TEST(PlainCompilation, FindsTransitionsHoweverTheyAreStored) {
  SequenceDatabase database = two_elements();
  database.transitions[1] = {
      .from = 0, .to = 1, .from_port = Port::kLeft, .to_port = Port::kRight, .cost = 7};
  const auto compiled = compile(plain_sequence(database, {{7, 7}, {}}));
  EXPECT_EQ(why_not_feasible(compiled.graph, SequencePath{12, {{0, 0}, {1, 0}, {0, 1}}}), "");
}

TEST(PlainCompilation, GivesBackASequenceWithWhatItsTransitionsConsume) {
  SequenceDatabase database = two_elements();
  database.transitions[0].uses = {0, 4};
  auto problem = plain_sequence(database, {{5, 5}, {}});
  const SequencePath ab{5, {{0, 0}, {1, 0}}};
  const auto found = arrangement(compile(problem), problem, ab);
  EXPECT_EQ(found.consumed, (std::vector<std::int64_t>{5, 5}));
  EXPECT_EQ(by_part(problem.structure, found).segments[0], (std::vector<ElementIndex>{0, 1}));
  problem.structure.segments[0].is_reversed = true;
  const auto turned = arrangement(compile(problem), problem, ab);
  EXPECT_EQ(by_part(problem.structure, turned).segments[0], (std::vector<ElementIndex>{1, 0}));
}

}  // namespace
}  // namespace plat::sequences
