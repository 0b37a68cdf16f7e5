#include "sequences/or_library.h"

#include <gmock/gmock.h>

#include "core/failure.h"
#include "sequences/compiled_problem.h"
#include "sequences/sequence_search.h"
#include "support/data_folder.h"

namespace plat::sequences {
namespace {

using ::testing::HasSubstr;

/// Three vertices, two of which use something, and three arcs; one resource of two is bounded
/// below.
constexpr std::string_view kSmall =
    "3 3 2\n 0 1\n 7 9\n0 0\n1 2\n0 0\n1 2 5 1 0\n2 3 6 0 1\n1 3 20 0 1\n";

std::string refusal(std::string_view text) {
  try {
    parse_or_library(text, "small.txt");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OrLibrary, ReadsVerticesArcsAndLimitsInTheOrderOfTheText) {
  const SequenceProblem problem = parse_or_library(kSmall, "small.txt");
  const SequenceDatabase& database = problem.database;
  EXPECT_EQ(problem.bounds, (std::vector<Bounds>{{0, 7}, {1, 9}}));
  ASSERT_EQ(database.elements.size(), 3U);
  EXPECT_EQ(database.elements[1].name, "2");
  EXPECT_EQ(database.elements[1].uses, (std::vector<Amount>{1, 2}));
  EXPECT_TRUE(database.elements[0].is_front && !database.elements[0].is_back);
  EXPECT_TRUE(database.elements[2].is_back && !database.elements[2].is_front);
  ASSERT_EQ(database.transitions.size(), 3U);
  EXPECT_EQ(database.transitions[1].from, 1U);
  EXPECT_EQ(database.transitions[1].to, 2U);
  EXPECT_EQ(database.transitions[1].cost, 6);
  EXPECT_EQ(database.transitions[1].uses, (std::vector<Amount>{0, 1}));
}

TEST(OrLibrary, CompilesToOneZoneWhosePathsRunFromTheFirstVertexToTheLast) {
  const CompiledProblem compiled = compile(parse_or_library(kSmall, "small.txt"));
  EXPECT_EQ(compiled.graph.zones.size(), 1U);
  EXPECT_EQ(compiled.graph.entries.size(), 1U);
  EXPECT_EQ(compiled.graph.exits.size(), 1U);
  EXPECT_EQ(why_not_feasible(compiled.graph, {11, {{0, 0}, {1, 0}, {2, 2}}}), "");
}

TEST(OrLibrary, RefusesWhatDoesNotFitTheFormatWithItsLine) {
  EXPECT_EQ(refusal("3 1 1\n0\n"),
            "small.txt: line 3: the file ends where an upper limit should be");
  EXPECT_EQ(refusal("2 1 1\n0\n7\n0\n0\n1 3 5 0\n"),
            "small.txt: line 6: an arc's head = 3, allowed 1..2");
  EXPECT_EQ(refusal("2 1 1\n0\n7\n0\n0\n1 2 -5 0\n"),
            "small.txt: line 6: an arc's cost = -5, allowed 0..1000000000");
  EXPECT_EQ(refusal("2 1 1\n0\n7.5\n"),
            "small.txt: line 3: an upper limit should be a whole number, not \"7.5\"");
  EXPECT_EQ(refusal("1 0 1\n3\n2\n"),
            "small.txt: line 3: an upper limit = 2, allowed 3..1000000000");
  EXPECT_EQ(refusal("1 0 0\n4\n"), "small.txt: line 2: \"4\" after the last of 0 arcs");
}

TEST(OrLibrary, RefusesAFileThatIsNotThere) {
  EXPECT_THAT([] { read_or_library("no/such/rcsp1.txt"); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("no/such/rcsp1.txt: cannot be read")));
}

TEST(OrLibrary, RealFilesHaveTheSizesTheyName) {
  PLAT_REAL_DATA_OR_SKIP(path, "rcsp_or_library/rcsp24.txt");
  const SequenceProblem problem = read_or_library(path);
  EXPECT_EQ(problem.database.elements.size(), 500U);
  EXPECT_EQ(problem.database.transitions.size(), 4868U);
  EXPECT_EQ(problem.bounds.size(), 10U);
  EXPECT_NO_THROW(compile(problem));
}

TEST(OrLibrary, PublishedOptimaNameEveryInstanceAndTheOneWithoutAPath) {
  PLAT_REAL_DATA_OR_SKIP(path, "rcsp_or_library/results.txt");
  const auto optima = read_or_library_optima(path);
  ASSERT_EQ(optima.size(), 24U);
  EXPECT_EQ(optima[0].cost, 131);
  for (const PublishedOptimum& optimum : optima)
    EXPECT_EQ(optimum.cost.has_value(), optimum.instance != 14) << optimum.instance;
}

/// The paper's graph holds all feasible paths, of ten resources more than fit: it needs its bounds.
OptionMap options_for_general_graphs(const std::string& strategy) {
  if (strategy == "intermediate_graph") return {{"bounding", "resources_and_cost"}};
  return {};
}

TEST(OrLibrary, EveryStrategyFindsThePublishedOptima) {
  PLAT_REAL_DATA_OR_SKIP(path, "rcsp_or_library/results.txt");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (const PublishedOptimum& optimum : read_or_library_optima(path)) {
    const auto graph =
        compile(read_or_library(folder / fmt::format("rcsp{}.txt", optimum.instance))).graph;
    for (const std::string& name : sequence_searches().names()) {
      SCOPED_TRACE(fmt::format("{}, instance {}", name, optimum.instance));
      const auto stream =
          sequence_searches().make(name, options_for_general_graphs(name)).search(graph);
      ASSERT_TRUE(stream.has_value()) << stream.error().message;
      const auto paths = find_paths(**stream, 1);
      ASSERT_TRUE(paths.has_value()) << paths.error().message;
      ASSERT_EQ(paths->size(), optimum.cost ? 1U : 0U);
      if (!optimum.cost) continue;
      EXPECT_EQ(paths->front().cost, *optimum.cost);
      EXPECT_EQ(why_not_feasible(graph, paths->front()), "");
    }
  }
}

TEST(OrLibrary, ForwardSearchFindsThePublishedOptimaUnderEveryDominance) {
  PLAT_REAL_DATA_OR_SKIP(path, "rcsp_or_library/results.txt");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const std::vector<AnySequenceSearch> searches{
      sequence_searches().make("forward", {{"dominance", "bounds"}}),
      sequence_searches().make("forward", {{"dominance", "none"}})};
  for (const PublishedOptimum& optimum : read_or_library_optima(path)) {
    const auto graph =
        compile(read_or_library(folder / fmt::format("rcsp{}.txt", optimum.instance))).graph;
    for (const AnySequenceSearch& search : searches) {
      const auto stream = search.search(graph);
      const auto paths = find_paths(**stream, 1);
      ASSERT_TRUE(paths.has_value());
      ASSERT_EQ(paths->size(), optimum.cost ? 1U : 0U) << optimum.instance;
      if (optimum.cost) {
        EXPECT_EQ(paths->front().cost, *optimum.cost) << optimum.instance;
      }
    }
  }
}

}  // namespace
}  // namespace plat::sequences
