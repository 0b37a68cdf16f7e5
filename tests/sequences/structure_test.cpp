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
      ASSERT_TRUE(stream.has_value()) << name << ": " << stream.error().message;
      const auto paths = find_paths(**stream, one.arrangements.size() + 1);
      ASSERT_TRUE(paths.has_value()) << name;
      ASSERT_EQ(paths->size(), one.arrangements.size()) << name;
      for (std::size_t p = 0; p < paths->size(); ++p)
        ASSERT_EQ((*paths)[p].cost, one.arrangements[p].cost) << name << " path " << p;
    }
  });
}

}  // namespace
}  // namespace plat::sequences
