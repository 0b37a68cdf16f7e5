#include <gtest/gtest.h>

#include <algorithm>

#include "sequences/sequence_search.h"
#include "sequences/structure_decomposition.h"
#include "sequences/support/structure_brute_force.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::arrangements_of_all_paths;
using plat::testing::enumerate_arrangements;
using plat::testing::iterations;
using plat::testing::PlainArrangement;
using plat::testing::property_rng;
using plat::testing::random_structure_problem;
using plat::testing::StructureSize;

/// A random problem with all of its arrangements.
struct Case {
  SequenceProblem problem;
  CompiledProblem compiled;
  std::vector<PlainArrangement> arrangements;  ///< sorted, the cheapest first
};

bool has_contexts(const Structure& structure) {
  const auto visits = visit_order(structure, decompose(structure));
  return std::ranges::any_of(visits, [](const Visit& visit) { return !visit.remembered.empty(); });
}

/// Calls `check(case)` for random structures that brute force finishes, and expects enough of them
/// to say something.
template <class Check>
void for_random_structures(const std::string& name, const StructureSize& size, int count,
                           Check check) {
  Rng rng = property_rng(name);
  int with_arrangements = 0;
  int without = 0;
  int with_contexts = 0;
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(name + " case " + std::to_string(i));
    Case one{random_structure_problem(rng, size), {}, {}};
    auto expected = enumerate_arrangements(one.problem);
    if (!expected) continue;
    one.arrangements = std::move(*expected);
    one.compiled = compile(one.problem);
    check(one);
    if (::testing::Test::HasFailure()) return;
    one.arrangements.empty() ? ++without : ++with_arrangements;
    if (!one.arrangements.empty() && has_contexts(one.problem.structure)) ++with_contexts;
  }
  EXPECT_GT(5 * with_arrangements, count);
  EXPECT_GT(10 * without, count);
  EXPECT_GT(25 * with_contexts, count);
}

void expect_the_same_arrangements(const Case& one) {
  const auto found = arrangements_of_all_paths(one.compiled, one.problem);
  if (!found) return;
  EXPECT_EQ(found->size(), one.arrangements.size());
  EXPECT_TRUE(*found == one.arrangements);
}

TEST(Unrolling, HasJustTheArrangementsOfRandomTrees) {
  for_random_structures("structure.trees", {.segments = 5, .has_cycles = false}, iterations(300),
                        expect_the_same_arrangements);
}

TEST(Unrolling, HasJustTheArrangementsOfRandomStructuresWithCycles) {
  for_random_structures("structure.cycles", {.segments = 6}, iterations(300),
                        expect_the_same_arrangements);
}

TEST(Unrolling, EveryStrategyFindsTheCheapestArrangements) {
  const auto& menu = sequence_searches();
  for_random_structures("structure.menu", {.segments = 5}, iterations(150), [&](const Case& one) {
    for (const std::string& name : menu.names()) {
      const auto stream = menu.make(name).search(one.compiled.graph);
      const auto paths = stream ? find_paths(**stream, one.arrangements.size() + 1)
                                : tl::unexpected(stream.error());
      if (!paths && paths.error().code == FailureCode::kTooManyStates) continue;
      ASSERT_TRUE(paths.has_value()) << name << ": " << paths.error().message;
      ASSERT_EQ(paths->size(), one.arrangements.size()) << name;
      for (std::size_t p = 0; p < paths->size(); ++p)
        ASSERT_EQ((*paths)[p].cost, one.arrangements[p].cost) << name << " path " << p;
    }
  });
}

/// The structure drawn from the other end of each of its segments.
SequenceProblem drawn_backwards(SequenceProblem problem) {
  for (Segment& segment : problem.structure.segments) {
    std::swap(segment.from, segment.to);
    std::swap(segment.from_port, segment.to_port);
    segment.is_reversed = !segment.is_reversed;
  }
  return problem;
}

Port mirrored(Port port) {
  if (port == Port::kStem) return port;
  return port == Port::kLeft ? Port::kRight : Port::kLeft;
}

/// Everything seen in a mirror: left is right, in the database and in the structure.
SequenceProblem in_a_mirror(SequenceProblem problem) {
  for (Element& element : problem.database.elements) {
    std::swap(element.is_front, element.is_back);
    if (!element.arms.empty()) std::swap(element.arms[0], element.arms[1]);
  }
  for (Transition& transition : problem.database.transitions) {
    transition.from_port = mirrored(transition.from_port);
    transition.to_port = mirrored(transition.to_port);
  }
  for (Segment& segment : problem.structure.segments) {
    segment.from_port = mirrored(segment.from_port);
    segment.to_port = mirrored(segment.to_port);
    segment.is_reversed = !segment.is_reversed;
  }
  return problem;
}

/// Each adjacency stored the other way round.
SequenceProblem stored_backwards(SequenceProblem problem) {
  for (Transition& transition : problem.database.transitions) {
    std::swap(transition.from, transition.to);
    std::swap(transition.from_port, transition.to_port);
  }
  return problem;
}

TEST(Unrolling, HasTheSameArrangementsForTwins) {
  for_random_structures("structure.twins", {}, iterations(150), [](const Case& one) {
    auto turned = one.arrangements;
    for (auto& found : turned)
      for (auto& row : found.segments) std::ranges::reverse(row);
    std::ranges::sort(turned);
    const auto expect = [](const SequenceProblem& twin,
                           const std::vector<PlainArrangement>& expected) {
      const auto found = arrangements_of_all_paths(compile(twin), twin);
      EXPECT_TRUE(!found || *found == expected);
    };
    expect(drawn_backwards(one.problem), turned);
    expect(in_a_mirror(one.problem), one.arrangements);
    expect(stored_backwards(one.problem), one.arrangements);
  });
}

/// A key point that any element may take says nothing, but for where it is: a sequence of n
/// elements has n - 2 places for it.
TEST(Unrolling, FindsPlainSequencesOnceForEachPlaceOfAKeyPointThatAnyElementMayTake) {
  Rng rng = property_rng("structure.everything");
  int long_ones = 0;
  for (int i = 0; i < iterations(60); ++i) {
    auto database = random_structure_problem(rng, {.filling = 3, .key_elements = 0}).database;
    for (Element& element : database.elements) element.arms.clear();
    const auto length = static_cast<Amount>(4 + rng.index(4));
    const auto plain = plain_sequence(database, {{length, length}});
    SequenceProblem chain = plain;
    chain.structure = {{{"any", {0, 1, 2}}}, {Segment{}, Segment{}}};
    chain.structure.segments[0].to = 0;
    chain.structure.segments[1].from = 0;
    const auto sequences = arrangements_of_all_paths(compile(plain), plain);
    const auto found = arrangements_of_all_paths(compile(chain), chain);
    if (!sequences || !found) continue;
    std::vector<Cost> expected;
    for (const auto& sequence : *sequences)
      for (std::size_t n = 2; n < sequence.segments[0].size(); ++n)
        expected.push_back(sequence.cost);
    std::vector<Cost> costs;
    for (const auto& arrangement : *found) costs.push_back(arrangement.cost);
    EXPECT_EQ(costs, expected) << i;
    long_ones += costs.empty() ? 0 : 1;
  }
  EXPECT_GT(long_ones, iterations(60) / 4);
}

}  // namespace
}  // namespace plat::sequences
