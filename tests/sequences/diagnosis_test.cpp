#include "sequences/diagnosis.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sequences/sequence_search.h"
#include "sequences/stretched_search.h"
#include "sequences/support/brute_force.h"
#include "sequences/support/random_problems.h"
#include "sequences/support/structure_brute_force.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::k_best_paths;
using plat::testing::property_rng;

/// Farther than this the oracle does not look; the random problems' answers are near.
constexpr Amount kFar = 24;

struct Posed {
  SequenceProblem problem;
  CompiledProblem compiled;
};

/// A row of walls to a corner, and one on from it, under local and global bounds.
SequenceProblem random_chain(Rng& rng) {
  SequenceProblem problem = plat::testing::random_plain_problem(
      rng, {.elements = 4, .resources = 2, .amount = 8, .use = 3});
  auto& database = problem.database;
  const auto corner = static_cast<ElementIndex>(database.elements.size());
  const std::size_t resources = database.resources.size();
  Element element{.name = "corner", .uses = std::vector<Amount>(resources, 1)};
  element.arms.assign(kPortCount,
                      std::vector<Amount>(resources, static_cast<Amount>(rng.index(2))));
  element.is_filling = false;
  database.elements.push_back(element);
  for (ElementIndex e = 0; e < corner; ++e) {
    if (rng.index(3) > 0) database.transitions.push_back({.from = e, .to = corner});
    if (rng.index(3) > 0) database.transitions.push_back({.from = corner, .to = e});
  }
  for (auto& transition : database.transitions)
    transition.cost = std::max<Cost>(transition.cost, 1);
  problem.structure = {{{"corner", {corner}}}, {}};
  problem.structure.segments.resize(2);
  problem.structure.segments[0].to = 0;
  problem.structure.segments[1].from = 0;
  for (auto& segment : problem.structure.segments) {
    const auto min = static_cast<Amount>(rng.index(8));
    segment.bounds.resize(resources);
    if (rng.index(4) > 0) segment.bounds[0] = {min, min + static_cast<Amount>(rng.index(2))};
  }
  return problem;
}

/// Calls `check` for random problems, plain, of a corner and of trees and loops, that have no
/// sequence but could have.
template <class Check>
void for_problems_without_sequence(const std::string& name, int count, Check check) {
  Rng rng = property_rng(name);
  int local = 0;
  for (int found = 0; found < count;) {
    const auto kind = rng.index(3);
    SequenceProblem problem =
        kind == 0 ? random_chain(rng)
        : kind == 1
            ? plat::testing::random_structure_problem(rng, {.segments = 3, .key_elements = 2})
            : plat::testing::random_plain_problem(
                  rng, {.elements = 5, .resources = 3, .amount = 8, .use = 3});
    const Posed posed{problem, compile(problem)};
    if (!k_best_paths(posed.compiled.graph, 1).empty()) continue;
    ++found;
    local += kind < 2 ? 1 : 0;
    SCOPED_TRACE(fmt::format("{} case {}", name, found));
    check(posed);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(4 * local, count);
}

/// The graph with other bounds at one place.
SearchGraph with_bounds(const CompiledProblem& compiled, SearchGraph graph, const BoundPlace& place,
                        const Bounds& bounds) {
  for (std::size_t z = 0; z < graph.zones.size(); ++z)
    for (std::size_t d = 0; d < graph.dimension_count; ++d)
      if (place_of(compiled, d, z) == place) graph.zones[z].bounds[d] = bounds;
  return graph;
}

bool has_sequence(const SearchGraph& graph) { return !k_best_paths(graph, 1).empty(); }

bool has_sequence_without(const CompiledProblem& compiled, const std::vector<BoundPlace>& set) {
  SearchGraph graph = compiled.graph;
  for (const auto& place : set) graph = with_bounds(compiled, graph, place, {});
  return has_sequence(graph);
}

TEST(Diagnosis, NamesJustTheSmallestSetsOfBoundsThatCut) {
  int connected = 0;
  int of_two = 0;
  for_problems_without_sequence("cuts", iterations(150), [&](const Posed& posed) {
    const auto diagnosis = diagnose(posed.compiled, posed.problem);
    ASSERT_TRUE(diagnosis.has_value());
    const auto bounds = bounds_of(posed.compiled);
    std::vector<BoundPlace> all;
    for (const auto& bound : bounds) all.push_back(bound.place);
    ASSERT_EQ(diagnosis->gap.empty(), has_sequence_without(posed.compiled, all));
    if (!diagnosis->gap.empty()) return;
    ++connected;
    std::size_t least = all.size() + 1;
    std::vector<std::vector<BoundPlace>> expected;
    for (std::uint32_t mask = 1; mask < (1U << all.size()); ++mask) {
      std::vector<BoundPlace> set;
      for (std::size_t b = 0; b < all.size(); ++b)
        if ((mask >> b & 1U) != 0) set.push_back(all[b]);
      if (set.size() > least || !has_sequence_without(posed.compiled, set)) continue;
      if (set.size() < least) expected.clear();
      least = set.size();
      expected.push_back(set);
    }
    of_two += least > 1 ? 1 : 0;
    auto cuts = diagnosis->cuts;
    std::ranges::sort(cuts);
    std::ranges::sort(expected);
    ASSERT_EQ(cuts, expected);
  });
  EXPECT_GT(connected, iterations(150) / 3);
  EXPECT_GT(of_two, iterations(150) / 20);
}

TEST(Diagnosis, NamesTheNearestAttainableAmounts) {
  int below = 0;
  int above = 0;
  int none = 0;
  for_problems_without_sequence("nearest", iterations(150), [&](const Posed& posed) {
    const auto diagnosis = diagnose(posed.compiled, posed.problem);
    ASSERT_TRUE(diagnosis.has_value());
    for (const auto& nearest : diagnosis->nearest) {
      const auto attainable = [&](Amount amount) {
        return has_sequence(with_bounds(posed.compiled, posed.compiled.graph, nearest.bound.place,
                                        {amount, amount}));
      };
      std::optional<std::int64_t> under;
      for (Amount a = nearest.bound.bounds.min - 1; a >= 0 && !under; --a)
        if (attainable(a)) under = a;
      ASSERT_EQ(nearest.below, under);
      std::optional<std::int64_t> over;
      for (Amount a = nearest.bound.bounds.max; a < kFar && !over;)
        if (attainable(++a)) over = a;
      if (over || !nearest.above || *nearest.above <= kFar) {
        ASSERT_EQ(nearest.above, over);
      }
      below += under ? 1 : 0;
      above += over ? 1 : 0;
      none += !under && !over ? 1 : 0;
    }
  });
  EXPECT_GT(below, 20);
  EXPECT_GT(above, 20);
  EXPECT_GT(none, 20);
}

double distance_to(const Bounds& bounds, std::int64_t amount) {
  if (amount < bounds.min) return static_cast<double>(bounds.min - amount);
  return amount > bounds.max ? static_cast<double>(amount - bounds.max) : 0.0;
}

/// All amounts of up to two weighted bounds, tried one by one.
std::optional<std::pair<double, Cost>> best_by_trying(const Posed& posed,
                                                      const std::vector<BoundWeight>& weights,
                                                      const std::vector<BoundUse>& bounds) {
  std::optional<std::pair<double, Cost>> best;
  const auto amounts_tried = [&](std::size_t w) { return w < weights.size() ? kFar : 1; };
  for (Amount a = 0; a < amounts_tried(0); ++a) {
    for (Amount b = 0; b < amounts_tried(1); ++b) {
      SearchGraph graph = posed.compiled.graph;
      double distance = 0.0;
      const Amount tried[] = {a, b};
      for (std::size_t w = 0; w < weights.size(); ++w) {
        graph = with_bounds(posed.compiled, graph, weights[w].place, {tried[w], tried[w]});
        const auto bound = std::ranges::find(bounds, weights[w].place, &BoundUse::place);
        distance += weights[w].weight * distance_to(bound->bounds, tried[w]);
      }
      if (best && distance > best->first) continue;
      const auto paths = k_best_paths(graph, 1);
      if (paths.empty()) continue;
      const std::pair found(distance, paths.front().cost);
      if (!best || found < *best) best = found;
    }
  }
  return best;
}

TEST(Relaxation, IsTheNearestThenTheCheapest) {
  Rng rng = property_rng("weights");
  int relaxed = 0;
  int of_two = 0;
  for_problems_without_sequence("relaxation", iterations(80), [&](const Posed& posed) {
    const auto bounds = bounds_of(posed.compiled);
    std::vector<BoundWeight> weights;
    for (const auto& bound : bounds)
      if (weights.size() < 2 && rng.index(3) > 0)
        weights.push_back({bound.place, 0.5 * static_cast<double>(1 + rng.index(6))});
    if (weights.empty()) return;
    const auto found = relax(posed.compiled, posed.problem, weights);
    ASSERT_TRUE(found.has_value());
    const auto best = best_by_trying(posed, weights, bounds);
    if (!*found) {
      ASSERT_FALSE(best.has_value());
      return;
    }
    double distance = 0.0;
    for (const auto& use : (*found)->uses) {
      const auto weight = std::ranges::find(weights, use.place, &BoundWeight::place);
      if (weight == weights.end())
        ASSERT_EQ(distance_to(use.bounds, use.consumed), 0.0);
      else
        distance += weight->weight * distance_to(use.bounds, use.consumed);
    }
    ASSERT_DOUBLE_EQ(distance, (*found)->distance);
    const bool is_tried = std::ranges::all_of(
        (*found)->uses, [&](const BoundUse& use) { return use.consumed < kFar; });
    if (!is_tried) return;
    ASSERT_TRUE(best.has_value());
    ASSERT_DOUBLE_EQ(best->first, (*found)->distance);
    ASSERT_EQ(best->second, (*found)->path.cost);
    ++relaxed;
    of_two += weights.size() == 2 ? 1 : 0;
  });
  EXPECT_GT(relaxed, iterations(80) / 8);
  EXPECT_GT(of_two, 5);
}

/// Two elements of 4 and 6 quanta of 0.5 m, one of them with a balcony.
SequenceProblem small_problem(Bounds length, Bounds balconies) {
  SequenceDatabase database;
  database.resources = {{"length_m", 0.5}, {"balconies", 1.0}};
  database.elements = {{.name = "a", .uses = {4, 0}}, {.name = "b", .uses = {6, 1}}};
  database.transitions = {{.from = 0, .to = 0, .cost = 1},
                          {.from = 0, .to = 1, .cost = 1},
                          {.from = 1, .to = 0, .cost = 1}};
  return plain_sequence(database, {length, balconies});
}

TEST(Diagnosis, SaysBothSidesOfALengthThatCannotBeMet) {
  const SequenceProblem problem = small_problem({13, 13}, {1, 2});
  const auto diagnosis = diagnose(compile(problem), problem);
  ASSERT_TRUE(diagnosis.has_value());
  EXPECT_EQ(diagnosis->cuts, (std::vector<std::vector<BoundPlace>>{{{0, std::nullopt}}}));
  EXPECT_EQ(diagnosis->nearest[0].below, 10);
  EXPECT_EQ(diagnosis->nearest[0].above, 14);
  EXPECT_EQ(diagnosis->nearest[1].below, std::nullopt);
}

TEST(Diagnosis, SaysThatNothingLeadsThrough) {
  SequenceProblem problem = small_problem({13, 13}, {1, 2});
  for (auto& element : problem.database.elements) element.is_front = false;
  EXPECT_EQ(diagnose(compile(problem), problem)->gap, "no element may begin");
  problem.database.elements[0].is_front = true;
  problem.database.elements[0].is_back = false;
  problem.database.transitions.resize(1);
  EXPECT_EQ(diagnose(compile(problem), problem)->gap,
            "no row of transitions leads from an element that may begin to one that may end");
}

TEST(Diagnosis, NamesTheSegmentThatNothingLeadsThrough) {
  SequenceProblem problem = small_problem({}, {});
  problem.database.elements.push_back({.name = "corner", .uses = {1, 0}, .is_filling = false});
  problem.database.transitions.push_back({.from = 0, .to = 2});
  problem.database.transitions.push_back({.from = 2, .to = 1});
  problem.structure = {{{"corner", {2}}}, {}};
  problem.structure.segments.resize(2);
  problem.structure.segments[0].to = 0;
  problem.structure.segments[1].from = 0;
  problem.structure.segments[1].name = "east";
  for (auto& element : problem.database.elements) element.is_back = false;
  problem.structure.segments[1].bounds = {{3, 3}, {}};
  EXPECT_EQ(diagnose(compile(problem), problem)->gap, "no element may end");
  problem.database.elements[1].is_back = true;
  problem.database.transitions.pop_back();
  EXPECT_EQ(diagnose(compile(problem), problem)->gap,
            "no transitions lead through segment \"east\"");
}

TEST(Diagnosis, GivesUpWithAFailureBeyondItsLimit) {
  const SequenceProblem problem = small_problem({13, 13}, {1, 2});
  const auto diagnosis = diagnose(compile(problem), problem, {.max_states = 1});
  ASSERT_FALSE(diagnosis.has_value());
  EXPECT_EQ(diagnosis.error().code, FailureCode::kTooManyStates);
}

TEST(Diagnosis, TriesNoMoreSetsThanAllowedAndFindsOneThatHasNoSmaller) {
  // 24 resources that each ask for one quantum of what nothing has: only all together help.
  SequenceDatabase database;
  Element element{.name = "a"};
  for (int r = 0; r < 24; ++r) {
    database.resources.push_back({fmt::format("r{}", r), 1.0});
    element.uses.push_back(0);
  }
  database.elements = {element};
  const auto problem = plain_sequence(database, std::vector<Bounds>(24, Bounds{1, 1}));
  const auto diagnosis = diagnose(compile(problem), problem);
  ASSERT_TRUE(diagnosis.has_value());
  EXPECT_FALSE(diagnosis->has_all_cuts);
  ASSERT_EQ(diagnosis->cuts.size(), 1U);
  EXPECT_EQ(diagnosis->cuts[0].size(), 24U);
}

TEST(Relaxation, TakesWeightsPerUnitOfTheResource) {
  // 13 quanta: 14 are 0.5 m away with one balcony, 12 with none, if that is cheaper.
  const SequenceProblem problem = small_problem({13, 13}, {1, 1});
  const auto compiled = compile(problem);
  const auto by_length = relax(compiled, problem, {{{0, std::nullopt}, 1.0}});
  ASSERT_TRUE(by_length.has_value() && by_length->has_value());
  EXPECT_DOUBLE_EQ((**by_length).distance, 0.5);
  EXPECT_EQ((**by_length).uses[0].consumed, 14);
  const auto both = relax(compiled, problem, {{{0, std::nullopt}, 1.0}, {{1, std::nullopt}, 0.1}});
  ASSERT_TRUE(both.has_value() && both->has_value());
  EXPECT_DOUBLE_EQ((**both).distance, 0.5);
  const auto neither = relax(compiled, problem, {{{1, std::nullopt}, 1.0}});
  ASSERT_TRUE(neither.has_value());
  EXPECT_FALSE(neither->has_value());
}

TEST(Relaxation, RefusesWeightsThatMeanNothing) {
  const SequenceProblem problem = small_problem({13, 13}, {});
  const auto compiled = compile(problem);
  EXPECT_THROW(relax(compiled, problem, {{{0, std::nullopt}, 0.0}}), InputError);
  EXPECT_THROW(relax(compiled, problem, {{{0, std::nullopt}, 1.0 / 3.0}}), InputError);
  EXPECT_THROW(relax(compiled, problem, {{{1, std::nullopt}, 1.0}}), InputError);
}

}  // namespace
}  // namespace plat::sequences
