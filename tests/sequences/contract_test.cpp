#include "sequences/support/contract.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "sequences/compiled_problem.h"
#include "sequences/support/brute_force.h"
#include "sequences/support/random_problems.h"
#include "sequences/support/structure_brute_force.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::enumerate_paths;
using plat::testing::iterations;
using plat::testing::k_best_paths;
using plat::testing::property_rng;
using plat::testing::random_plain_problem;
using plat::testing::random_search_graph;
using plat::testing::random_structure_problem;
using plat::testing::why_not_in_contract;

/// A graph, the best k of its paths, and what kind of case that is.
struct Case {
  SearchGraph graph;
  std::size_t k = 1;
  std::vector<SequencePath> best;

  [[nodiscard]] bool has_ties() const {
    return std::ranges::adjacent_find(best, {}, &SequencePath::cost) != best.end();
  }
};

std::size_t random_k(Rng& rng) {
  constexpr std::array<std::size_t, 5> kNumbers{1, 2, 10, 60, 300};
  return kNumbers[rng.index(kNumbers.size())];
}

/// Where random graphs come from.
enum class Source { kPlain, kZones, kStructures };
constexpr std::array<std::string_view, 3> kSourceNames{"plain", "zones", "structures"};

SearchGraph random_graph(Rng& rng, Source source) {
  switch (source) {
    case Source::kPlain:
      return compile(random_plain_problem(rng)).graph;
    case Source::kZones:
      return random_search_graph(rng);
    case Source::kStructures:
      return compile(random_structure_problem(rng, {.segments = 3})).graph;
  }
  return {};
}

Case random_case(Rng& rng, Source source) {
  Case out;
  out.graph = random_graph(rng, source);
  validate(out.graph);
  out.k = random_k(rng);
  out.best = k_best_paths(out.graph, out.k);
  return out;
}

/// How many of the cases tell something.
struct Tally {
  int cases = 0;
  int feasible = 0;
  int infeasible = 0;
  int with_ties = 0;
  int beyond_the_last = 0;
  int of_several_zones = 0;

  void add(const Case& one) {
    ++cases;
    one.best.empty() ? ++infeasible : ++feasible;
    with_ties += one.has_ties() ? 1 : 0;
    beyond_the_last += !one.best.empty() && one.best.size() < one.k ? 1 : 0;
    of_several_zones +=
        !one.best.empty() && one.graph.zone_of(one.best.front().steps.back().node) > 0 ? 1 : 0;
  }
  void expect_enough(Source source) const {
    EXPECT_GT(4 * feasible, cases);
    EXPECT_GT(10 * infeasible, cases);
    EXPECT_GT(8 * with_ties, cases);
    EXPECT_GT(15 * beyond_the_last, cases);
    if (source != Source::kPlain) {
      EXPECT_GT(8 * of_several_zones, cases);
    }
  }
};

/// Fewer cases than this may all be of one kind by chance.
constexpr int kEnoughToTell = 100;

/// Calls `check(case)` for many random cases from each source.
template <class Check>
void for_random_cases(const std::string& name, int count, Check check) {
  for (const Source source : {Source::kPlain, Source::kZones, Source::kStructures}) {
    const std::string_view source_name = kSourceNames[static_cast<std::size_t>(source)];
    Rng rng = property_rng(fmt::format("{}.{}", name, source_name));
    Tally tally;
    // Structures are larger: fewer of them take as long.
    const int share = source == Source::kStructures ? count / 5 : count;
    for (int i = 0; i < share; ++i) {
      const Case one = random_case(rng, source);
      tally.add(one);
      SCOPED_TRACE(fmt::format("{} case {}, k = {}", source_name, i, one.k));
      check(one);
      if (::testing::Test::HasFailure()) return;
    }
    if (share >= kEnoughToTell) tally.expect_enough(source);
  }
}

// ---- the oracles ----

TEST(SequenceOracles, FindTheSameCostsByEnumerationAndByDynamicProgramme) {
  int enumerated = 0;
  int complete = 0;
  int cases = 0;
  for_random_cases("oracles", iterations(400), [&](const Case& one) {
    ++cases;
    const auto all = enumerate_paths(one.graph, one.k);
    if (!all) return;
    ++enumerated;
    complete += all->is_complete ? 1 : 0;
    ASSERT_EQ(all->paths.size(), one.best.size());
    for (std::size_t i = 0; i < one.best.size(); ++i) {
      ASSERT_EQ(all->paths[i].cost, one.best[i].cost);
      ASSERT_EQ(why_not_feasible(one.graph, all->paths[i]), "");
      ASSERT_EQ(why_not_feasible(one.graph, one.best[i]), "");
    }
  });
  EXPECT_GT(10 * enumerated, 8 * cases);
  EXPECT_GT(10 * complete, 3 * cases);
}

TEST(SequenceOracles, EnumerateByCostThenSteps) {
  SequenceDatabase database;
  database.resources = {{"length", 1.0}};
  database.elements = {{.name = "a", .uses = {1}}, {.name = "b", .uses = {1}}};
  database.transitions = {
      {.from = 0, .to = 1}, {.from = 1, .to = 0}, {.from = 0, .to = 0, .cost = 1}};
  const auto compiled = compile(plain_sequence(database, {{2, 2}}));
  const auto all = enumerate_paths(compiled.graph, 10);
  ASSERT_TRUE(all.has_value() && all->is_complete);
  ASSERT_EQ(all->paths.size(), 3U);
  EXPECT_EQ(all->paths[0].steps.front().node, 0U);
  EXPECT_EQ(all->paths[1].steps.front().node, 1U);
  EXPECT_EQ(all->paths[2].cost, 1);
  EXPECT_FALSE(enumerate_paths(compiled.graph, 2)->is_complete);
}

// ---- the suite fails on strategies that are wrong ----

enum class Fault {
  kNone,
  kSkipsTheBest,
  kRepeats,
  kMissesTheLast,
  kNeverEnds,
  kLiesAboutCosts,
  kSwaps,
  kIgnoresBounds,
};

/// The oracle dressed as a strategy, with one fault.
struct Twin {
  Fault fault;

  [[nodiscard]] std::vector<SequencePath> paths(const SearchGraph& graph) const {
    SearchGraph searched = graph;
    if (fault == Fault::kIgnoresBounds)
      for (auto& zone : searched.zones)
        for (auto& bounds : zone.bounds) bounds.min = 0;
    auto paths = k_best_paths(searched, 61);
    if (paths.empty()) return paths;
    if (fault == Fault::kSkipsTheBest) paths.erase(paths.begin());
    if (fault == Fault::kRepeats) paths.insert(paths.begin(), paths.front());
    if (fault == Fault::kMissesTheLast) paths.pop_back();
    if (fault == Fault::kLiesAboutCosts) ++paths.back().cost;
    if (fault == Fault::kSwaps) std::swap(paths.front(), paths.back());
    return paths;
  }
  [[nodiscard]] Expected<std::unique_ptr<SequenceStream>> search(const SearchGraph& graph) const {
    struct Stream final : SequenceStream {
      std::vector<SequencePath> paths;
      std::size_t at = 0;
      bool restarts = false;
      Expected<bool> next(SequencePath& path) override {
        if (at == paths.size()) {
          if (restarts) at = 0;
          return false;
        }
        path = paths[at++];
        return true;
      }
      [[nodiscard]] SearchStatistics statistics() const override { return {}; }
    };
    auto stream = std::make_unique<Stream>();
    stream->paths = paths(graph);
    stream->restarts = fault == Fault::kNeverEnds;
    return stream;
  }
};
static_assert(SequenceSearch<Twin>);

/// In how many of many cases the suite objects.
int objections(Fault fault) {
  Rng rng = property_rng("twins");
  int count = 0;
  for (int i = 0; i < 80; ++i) {
    Case one = random_case(rng, i % 2 == 0 ? Source::kPlain : Source::kZones);
    one.k = std::min<std::size_t>(one.k, 60);
    one.best.resize(std::min(one.best.size(), one.k));
    count += why_not_in_contract(Twin{fault}, one.graph, one.best, one.k).empty() ? 0 : 1;
  }
  return count;
}

TEST(SequenceContract, AcceptsTheOracleAndRefusesItsBrokenTwins) {
  EXPECT_EQ(objections(Fault::kNone), 0);
  EXPECT_GT(objections(Fault::kSkipsTheBest), 5);
  EXPECT_GT(objections(Fault::kRepeats), 5);
  EXPECT_GT(objections(Fault::kMissesTheLast), 5);
  EXPECT_GT(objections(Fault::kNeverEnds), 5);
  EXPECT_GT(objections(Fault::kLiesAboutCosts), 5);
  EXPECT_GT(objections(Fault::kSwaps), 5);
  EXPECT_GT(objections(Fault::kIgnoresBounds), 5);
}

// ---- every strategy on the menu ----

/// A strategy that may have to look at too many walks does not look at many here.
AnySequenceSearch impatient(const std::string& name) {
  constexpr std::string_view kLimit = "max_walks";
  const auto& entry = sequence_searches().at(name);
  const bool is_limited =
      std::ranges::find(entry.fields, kLimit, &FieldDescription::name) != entry.fields.end();
  return entry.make(is_limited ? OptionMap{{std::string(kLimit), 5'000.0}} : OptionMap{});
}

TEST(SequenceContract, HoldsForEveryStrategyOnRandomProblems) {
  const auto& menu = sequence_searches();
  std::map<std::string, int> gave_up;
  int cases = 0;
  for_random_cases("contract", iterations(1000), [&](const Case& one) {
    ++cases;
    for (const std::string& name : menu.names()) {
      const auto wrong = why_not_in_contract(impatient(name), one.graph, one.best, one.k);
      if (wrong == plat::testing::kGivesUp)
        ++gave_up[name];
      else
        ASSERT_EQ(wrong, "") << name;
    }
  });
  for (const auto& [name, count] : gave_up) EXPECT_LT(50 * count, cases) << name;
}

TEST(SequenceContract, GivesTheSamePathsTwice) {
  const auto& menu = sequence_searches();
  for_random_cases("twice", iterations(60), [&](const Case& one) {
    for (const std::string& name : menu.names()) {
      std::vector<std::vector<Step>> runs[2];
      for (auto& steps : runs) {
        const SearchGraph copy = one.graph;
        const auto stream = impatient(name).search(copy);
        ASSERT_TRUE(stream.has_value());
        const auto paths = find_paths(**stream, one.k);
        if (!paths) {
          ASSERT_EQ(paths.error().code, FailureCode::kTooManyStates) << name;
          continue;
        }
        for (const auto& path : *paths) steps.push_back(path.steps);
      }
      ASSERT_EQ(runs[0], runs[1]) << name;
    }
  });
}

/// Larger than what enumeration finishes: here a search may give up, but only by saying so.
TEST(SequenceContract, StrategiesAgreeOnLargerProblems) {
  Rng rng = property_rng("larger");
  const auto& menu = sequence_searches();
  int found = 0;
  for (int i = 0; i < iterations(30); ++i) {
    const auto graph =
        compile(random_plain_problem(rng, {.elements = 14, .resources = 2, .amount = 60, .use = 9}))
            .graph;
    const auto best = k_best_paths(graph, 100);
    found += best.empty() ? 0 : 1;
    for (const std::string& name : menu.names()) {
      const auto stream = impatient(name).search(graph);
      if (!stream && stream.error().code == FailureCode::kTooManyStates) continue;
      const auto paths = stream ? find_paths(**stream, 100) : tl::unexpected(stream.error());
      if (!paths && paths.error().code == FailureCode::kTooManyStates) continue;
      ASSERT_TRUE(paths.has_value()) << name << ": " << paths.error().message;
      ASSERT_EQ(paths->size(), best.size()) << name << ", case " << i;
      for (std::size_t p = 0; p < best.size(); ++p)
        ASSERT_EQ((*paths)[p].cost, best[p].cost) << name << ", case " << i << ", path " << p;
    }
  }
  EXPECT_GT(found, iterations(30) / 4);
}

}  // namespace
}  // namespace plat::sequences
