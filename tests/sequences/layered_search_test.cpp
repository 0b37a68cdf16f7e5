#include "sequences/layered_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "sequences/compiled_problem.h"
#include "sequences/support/brute_force.h"
#include "sequences/support/random_problems.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::enumerate_paths;
using plat::testing::iterations;
using plat::testing::k_best_paths;
using plat::testing::property_rng;
using plat::testing::random_plain_problem;
using plat::testing::random_search_graph;

std::vector<SequencePath> first_paths(const SearchGraph& graph, std::size_t k,
                                      const LayeredSearch::Options& options = {}) {
  const auto stream = LayeredSearch(options).search(graph);
  if (!stream) throw LogicError(stream.error().message);
  auto paths = find_paths(**stream, k);
  if (!paths) throw LogicError(paths.error().message);
  return *paths;
}

/// Elements of one quantum each that all follow each other at cost `cost`.
SearchGraph uniform_graph(std::uint32_t elements, Amount length, Cost cost) {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  for (std::uint32_t e = 0; e < elements; ++e)
    database.elements.push_back({.name = std::to_string(e), .uses = {1}});
  for (std::uint32_t from = 0; from < elements; ++from)
    for (std::uint32_t to = 0; to < elements; ++to)
      database.transitions.push_back({.from = from, .to = to, .cost = cost});
  return compile(plain_sequence(std::move(database), {{length, length}})).graph;
}

TEST(LayeredSearch, GivesPathsByCostThenStepsWhateverTheBatch) {
  constexpr std::array<int, 5> kBatches{1, 2, 7, 40, 262144};
  int compared = 0;
  for (const bool is_plain : {true, false}) {
    Rng rng = property_rng(is_plain ? "layered.order.plain" : "layered.order.zones");
    for (int i = 0; i < iterations(400); ++i) {
      const SearchGraph graph =
          is_plain ? compile(random_plain_problem(rng)).graph : random_search_graph(rng);
      const auto all = enumerate_paths(graph, 200);
      if (!all) continue;
      const int batch = kBatches[static_cast<std::size_t>(i) % 5];
      for (const auto layers : {LayeredSearch::Layers::kDense, LayeredSearch::Layers::kSparse}) {
        const auto paths = first_paths(graph, 200, {.layers = layers, .batch_paths = batch});
        ASSERT_EQ(paths.size(), all->paths.size()) << i;
        for (std::size_t p = 0; p < paths.size(); ++p) {
          ASSERT_EQ(paths[p].cost, all->paths[p].cost) << i << ", path " << p;
          ASSERT_EQ(paths[p].steps, all->paths[p].steps) << i << ", path " << p;
        }
        compared += paths.size() > 1 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(compared, iterations(200));
}

TEST(LayeredSearch, StreamsAClassOfEqualCostsThatIsLargerThanABatch) {
  const SearchGraph graph = uniform_graph(3, 9, 2);  // 3^9 paths of the same cost
  const auto paths = first_paths(graph, 100000, {.batch_paths = 10});
  ASSERT_EQ(paths.size(), 19683U);
  EXPECT_TRUE(std::ranges::all_of(paths, [](const auto& path) { return path.cost == 16; }));
  EXPECT_TRUE(std::ranges::is_sorted(paths, std::ranges::less{}, &SequencePath::steps));
}

TEST(LayeredSearch, HoldsNoMoreForMorePaths) {
  SearchGraph graph = uniform_graph(3, 9, 2);
  graph.tables[0].arcs[0].cost = 1;  // from 0 to 0: costs from 8 to 16, thousands of paths each
  const auto stream = LayeredSearch({.batch_paths = 10}).search(graph);
  ASSERT_TRUE(stream.has_value());
  SequencePath path;
  std::uint64_t bytes = 0;
  std::size_t count = 0;
  for (; *(*stream)->next(path); ++count)
    bytes = std::max(bytes, (*stream)->statistics().bytes_held);
  EXPECT_EQ(count, 19683U);
  EXPECT_LT(bytes, 50'000U);  // the paths have 8 bytes for each of 9 steps, 1.4 MB in all
}

TEST(LayeredSearch, FindsCostsThatNeed64Bits) {
  constexpr Cost kHuge = Cost{1} << 50;
  SearchGraph graph = uniform_graph(3, 6, kHuge);
  graph.tables[0].arcs[1].cost = 1;  // from 0 to 1
  const auto paths = first_paths(graph, 4000);
  ASSERT_EQ(paths.size(), 729U);
  EXPECT_EQ(paths.front().cost, 3 + 2 * kHuge);
  EXPECT_EQ(paths.back().cost, 5 * kHuge);
}

TEST(LayeredSearch, TurnsPositiveCirclesThatConsumeNothing) {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  database.elements = {{.name = "a", .uses = {1}}, {.name = "b", .uses = {0}}};
  database.transitions = {{.from = 0, .to = 1, .cost = 3}, {.from = 1, .to = 1, .cost = 2}};
  const auto graph = compile(plain_sequence(std::move(database), {{1, 1}})).graph;
  const auto paths = first_paths(graph, 5);  // a, ab, abb, ...
  ASSERT_EQ(paths.size(), 5U);
  EXPECT_EQ(paths[0].cost, 0);
  EXPECT_EQ(paths[1].cost, 3);
  EXPECT_EQ(paths[4].cost, 9);
  EXPECT_EQ(paths[4].steps.size(), 5U);
}

/// Long uses, so that zones have runs, in a graph of one or two dimensions.
SearchGraph random_long_graph(Rng& rng) {
  SequenceDatabase database;
  const std::size_t elements = 2 + rng.index(9);
  const std::size_t resources = 1 + rng.index(2);
  const bool is_dense = rng.index(2) == 0;
  const bool has_uses = rng.index(3) == 0;
  for (std::size_t r = 0; r < resources; ++r) database.resources.push_back({"r", 1.0});
  for (std::size_t e = 0; e < elements; ++e) {
    Element element{.name = std::to_string(e)};
    element.uses.push_back(static_cast<Amount>(4 + rng.index(40)));
    if (resources > 1) element.uses.push_back(static_cast<Amount>(rng.index(3)));
    element.is_front = rng.index(4) > 0;
    element.is_back = rng.index(4) > 0;
    database.elements.push_back(element);
  }
  for (std::uint32_t from = 0; from < elements; ++from)
    for (std::uint32_t to = 0; to < elements; ++to)
      for (std::size_t parallel = rng.index(is_dense ? 10 : 3) / (is_dense ? 5 : 2);
           parallel-- > 0;) {
        Transition transition{.from = from, .to = to, .cost = static_cast<Cost>(rng.index(30))};
        if (has_uses && rng.index(2) == 0) {
          transition.uses.assign(resources, 0);
          transition.uses[0] = static_cast<Amount>(rng.index(5));
        }
        database.transitions.push_back(transition);
      }
  const auto length = static_cast<Amount>(rng.index(400));
  std::vector<Bounds> bounds{{length, length + static_cast<Amount>(rng.index(2) * rng.index(30))}};
  if (resources > 1) {
    const auto least = static_cast<Amount>(rng.index(6));
    bounds.push_back(
        {least, rng.index(2) == 0 ? kUnbounded : least + static_cast<Amount>(rng.index(4))});
  }
  return compile(plain_sequence(std::move(database), std::move(bounds))).graph;
}

TEST(LayeredSearch, AgreesWithTheOracleOnLongSequencesOnAllInstructionSets) {
  constexpr std::array<InstructionSet, 3> kSets{InstructionSet::kScalar, InstructionSet::kAvx2,
                                                InstructionSet::kAvx512};
  Rng rng = property_rng("layered.long");
  int feasible = 0;
  for (int i = 0; i < iterations(150); ++i) {
    const SearchGraph graph = random_long_graph(rng);
    const auto best = k_best_paths(graph, 30);
    feasible += best.empty() ? 0 : 1;
    std::vector<SequencePath> first;
    for (const InstructionSet set : kSets) {
      if (!is_supported(set)) continue;
      const auto paths = first_paths(graph, 30, {.instructions = set});
      ASSERT_EQ(paths.size(), best.size()) << i;
      for (std::size_t p = 0; p < paths.size(); ++p) {
        ASSERT_EQ(paths[p].cost, best[p].cost) << i << ", path " << p;
        ASSERT_EQ(why_not_feasible(graph, paths[p]), "");
        if (set != kSets[0]) {
          ASSERT_EQ(paths[p].steps, first[p].steps) << i << ", path " << p;
        }
      }
      first = paths;
    }
  }
  EXPECT_GT(feasible, iterations(50));
}

TEST(LayeredSearch, GoesOnWithATableWhereTooManyStatesGrow) {
  Rng rng = property_rng("layered.change");
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  for (std::uint32_t e = 0; e < 40; ++e)
    database.elements.push_back(
        {.name = std::to_string(e), .uses = {static_cast<Amount>(1 + rng.index(3))}});
  for (std::uint32_t from = 0; from < 40; ++from)
    for (std::uint32_t to = 0; to < 40; ++to)
      database.transitions.push_back(
          {.from = from, .to = to, .cost = static_cast<Cost>(10 + rng.index(100))});
  const auto graph = compile(plain_sequence(std::move(database), {{5, 100}})).graph;
  constexpr std::size_t kPaths = 20000;
  const auto stream = LayeredSearch({}).search(graph);
  ASSERT_TRUE(stream.has_value());
  const auto some = find_paths(**stream, 1);
  ASSERT_TRUE(some.has_value());
  const std::uint64_t grown = (*stream)->statistics().states_created;
  const auto rest = find_paths(**stream, kPaths - 1);
  ASSERT_TRUE(rest.has_value());
  EXPECT_LT(grown, 1000U);
  EXPECT_GT((*stream)->statistics().states_created, 3000U);
  const auto expected = first_paths(graph, kPaths, {.layers = LayeredSearch::Layers::kDense});
  ASSERT_EQ(rest->size() + 1, expected.size());
  EXPECT_EQ(some->front().steps, expected.front().steps);
  for (std::size_t p = 1; p < kPaths; ++p)
    ASSERT_EQ((*rest)[p - 1].steps, expected[p].steps) << "path " << p;
}

TEST(LayeredSearch, GrowsStatesWhereNoTableFits) {
  const SearchGraph graph = [] {
    SearchGraph many = uniform_graph(4, 6, 1);
    many.dimension_count = 8;  // 1001^7 vectors
    std::vector<Amount> uses;
    for (std::uint32_t node = 0; node < 4; ++node) {
      uses.push_back(1);
      for (std::uint32_t d = 1; d < 8; ++d) uses.push_back(d == node + 1 ? 100 : 1);
    }
    many.node_uses = uses;
    many.zones[0].bounds.resize(8, {0, 1000});
    many.zones[0].resets.resize(8, false);
    return many;
  }();
  const auto all = enumerate_paths(graph, 5000, 10'000'000);
  ASSERT_TRUE(all.has_value());
  const auto paths = first_paths(graph, 5000);
  ASSERT_EQ(paths.size(), 4096U);
  ASSERT_EQ(paths.size(), all->paths.size());
  for (std::size_t p = 0; p < paths.size(); ++p) ASSERT_EQ(paths[p].steps, all->paths[p].steps);
  EXPECT_FALSE(LayeredSearch({.layers = LayeredSearch::Layers::kDense}).search(graph).has_value());
}

TEST(LayeredSearch, FailsWhereTheMemoryIsExceeded) {
  const SearchGraph graph = uniform_graph(10, 1000, 1);
  const auto dense =
      LayeredSearch({.layers = LayeredSearch::Layers::kDense, .max_memory_mb = 0.01}).search(graph);
  ASSERT_FALSE(dense.has_value());
  EXPECT_EQ(dense.error().code, FailureCode::kTooManyStates);
  const auto stream = LayeredSearch({.max_memory_mb = 0.01}).search(graph);
  ASSERT_TRUE(stream.has_value());
  SequencePath path;
  for (int again = 0; again < 2; ++again) {
    const auto sparse = (*stream)->next(path);
    ASSERT_FALSE(sparse.has_value());
    EXPECT_EQ(sparse.error().code, FailureCode::kTooManyStates);
  }
}

}  // namespace
}  // namespace plat::sequences
