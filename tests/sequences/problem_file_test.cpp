#include "sequences/problem_file.h"

#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "core/failure.h"
#include "sequences/support/random_problems.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

/// What the reader says of the text, without the source's name.
std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parse_problem(text, "p.json"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// A problem of one resource with `rest` after its two elements.
std::string small_problem(const std::string& resource, const std::string& rest) {
  return R"({"resources": [)" + resource + R"(], "elements": [
    {"name": "a", "uses": {"length_m": 0.6}, "classes": ["wall"]},
    {"name": "b", "uses": {"length_m": 1.5}, "front": false}],
    "transitions": [{"from": "a", "to": "b", "cost": 0.25}])" +
         rest + "}";
}
const std::string kLength = R"({"name": "length_m"})";

TEST(ProblemFile, FindsTheStepAndTellsIt) {
  const auto read = parse_problem(small_problem(kLength, R"(, "bounds": {"length_m": 2.1})"), "p");
  EXPECT_EQ(read.problem.database.resources[0].step, 0.3);
  EXPECT_EQ(read.problem.database.elements[1].uses[0], 5);
  EXPECT_EQ(read.problem.database.transitions[0].cost, 1);
  EXPECT_EQ(read.problem.bounds[0], (Bounds{7, 7}));
  ASSERT_EQ(read.notes.size(), 2U);
  EXPECT_EQ(read.notes[0], "length_m: step 0.3 found, the greatest common divisor of 2 values");
  EXPECT_EQ(read.notes[1], "cost: step 0.25 found, the greatest common divisor of 1 values");
}

TEST(ProblemFile, WithoutSegmentsIsAPlainSequence) {
  const auto read = parse_problem(small_problem(kLength, ""), "p");
  ASSERT_EQ(read.problem.structure.segments.size(), 1U);
  EXPECT_FALSE(read.problem.structure.segments[0].from.has_value());
  EXPECT_FALSE(read.problem.database.elements[1].is_front);
  EXPECT_EQ(read.problem.bounds[0], Bounds{});
}

TEST(ProblemFile, NarrowsIntervalsToWholeSteps) {
  const auto read =
      parse_problem(small_problem(kLength, R"(, "bounds": {"length_m": [2, 3.5]})"), "p");
  EXPECT_EQ(read.problem.bounds[0], (Bounds{7, 11}));
  EXPECT_EQ(read.notes[2], "length_m: 2 ends of intervals moved inwards to multiples of 0.3");
  const auto open =
      parse_problem(small_problem(kLength, R"(, "bounds": {"length_m": [2.4, null]})"), "p");
  EXPECT_EQ(open.problem.bounds[0], (Bounds{8, kUnbounded}));
}

TEST(ProblemFile, RoundsOnlyWhereToldAndSaysSo) {
  const std::string step = R"({"name": "length_m", "step": 0.2})";
  EXPECT_EQ(refusal(small_problem(step, "")),
            "p.json: element \"b\": uses: length_m = 1.5 is no whole multiple of its step 0.2, "
            "the nearest is 1.6; give another step, or \"round\": true");
  const auto read =
      parse_problem(small_problem(R"({"name": "length_m", "step": 0.2, "round": true})", ""), "p");
  EXPECT_EQ(read.problem.database.elements[1].uses[0], 8);
  EXPECT_EQ(read.notes.back().find("length_m: 1 values rounded to multiples of 0.2, by 0.1"), 0U);
}

TEST(ProblemFile, RefusesWithSourceKeyAndWhatIsAllowed) {
  EXPECT_EQ(refusal(small_problem(kLength, R"(, "bounds": {"lenght_m": 3})")),
            "p.json: bounds: no resource \"lenght_m\", did you mean \"length_m\"?");
  EXPECT_EQ(refusal(small_problem(kLength, R"(, "bound": {})")),
            "p.json: unknown key \"bound\", did you mean \"bounds\"?");
  EXPECT_EQ(refusal(small_problem(kLength, R"(, "bounds": {"length_m": [3, 2.7]})")),
            "p.json: bounds: length_m = [3, 2.7] holds no multiple of the step 0.3");
  EXPECT_EQ(refusal(small_problem(kLength, R"(, "bounds": {"length_m": -1})"))
                .find("p.json: bounds: length_m = -1, allowed 0.."),
            0U);
  EXPECT_EQ(refusal(small_problem(R"({"name": "length_m", "step": 0})", "")),
            "p.json: resource 1: step = 0, allowed 1e-9..1e9");
  EXPECT_EQ(refusal(small_problem(kLength, R"(, "key_points": [{"name": "k", "classes": ["x"]}])")),
            "p.json: key point \"k\": no element is of class \"x\"");
  EXPECT_EQ(refusal(small_problem(kLength, R"(, "transition_matrix": [[0, 1]])")),
            "p.json: transition_matrix: 1 rows for 2 elements");
  EXPECT_EQ(refusal("[1]"), "p.json: must be a JSON object");
  EXPECT_EQ(refusal("{").find("p.json: is no JSON"), 0U);
  EXPECT_EQ(refusal(R"({"elements": []})"), "p.json: \"elements\" must list at least one");
  EXPECT_EQ(refusal(R"({"elements": [{"name": "a"}, {"name": "a"}]})"),
            "p.json: two elements are called \"a\"");
  EXPECT_EQ(refusal(small_problem(kLength, R"(, "segments": [{"from_port": "top"}])")),
            "p.json: segment 1: from_port = \"top\", allowed left, right, stem");
  EXPECT_EQ(refusal(R"({"resources": [{"name": "t"}], "elements": [
      {"name": "a", "uses": {"t": 0.33333333333}}]})"),
            "p.json: resource 1: the values of t share no step of at most 9 decimals; give one "
            "(\"step\")");
}

TEST(ProblemFile, ReadsADenseMatrixWithHoles) {
  const auto read = parse_problem(
      R"({"elements": [{"name": "a"}, {"name": "b"}], "transition_matrix": [[null, 2], [4, null]]})",
      "p");
  ASSERT_EQ(read.problem.database.transitions.size(), 2U);
  EXPECT_EQ(read.problem.database.transitions[1].from, 1U);
  EXPECT_EQ(read.problem.database.transitions[1].cost, 2);
  EXPECT_EQ(read.problem.database.cost_step, 2.0);
}

TEST(ProblemFile, ReadsStructures) {
  const auto read = parse_problem(small_problem(kLength, R"(,
        "key_points": [{"name": "k", "classes": ["wall"]}, {"name": "l", "elements": ["b", "a"]}],
        "segments": [{"name": "north", "from": "k", "to": "l", "to_port": "stem",
                      "reversed": true, "may_be_empty": false, "bounds": {"length_m": 3}}])"),
                                  "p");
  const Structure& structure = read.problem.structure;
  ASSERT_EQ(structure.key_points.size(), 2U);
  EXPECT_EQ(structure.key_points[0].allowed, (std::vector<ElementIndex>{0}));
  EXPECT_EQ(structure.key_points[1].allowed, (std::vector<ElementIndex>{0, 1}));
  const Segment& segment = structure.segments.at(0);
  EXPECT_EQ(segment.from, 0U);
  EXPECT_EQ(segment.to, 1U);
  EXPECT_EQ(segment.to_port, Port::kStem);
  EXPECT_TRUE(segment.is_reversed);
  EXPECT_FALSE(segment.may_be_empty);
  EXPECT_EQ(segment.bounds[0], (Bounds{10, 10}));
}

TEST(ProblemFile, WrittenIsReadBackAsTheSame) {
  Rng rng = plat::testing::property_rng("round trip");
  for (int i = 0; i < plat::testing::iterations(200); ++i) {
    SequenceProblem problem = plat::testing::random_plain_problem(rng);
    problem.database.cost_step = 0.01;
    problem.database.resources[0].step = 0.2;
    problem.database.elements[0].arms = {problem.database.elements[0].uses, {}, {}};
    for (auto& arm : problem.database.elements[0].arms)
      arm.resize(problem.database.resources.size());
    problem.database.elements[0].classes = {"corner", "wall"};
    const std::string text = problem_json(problem);
    const auto read = parse_problem(text, "p");
    ASSERT_EQ(problem_json(read.problem), text);
    ASSERT_EQ(read.problem.bounds, problem.bounds);
    ASSERT_EQ(read.problem.database.elements[0].uses, problem.database.elements[0].uses);
    ASSERT_EQ(read.problem.database.elements[0].arms, problem.database.elements[0].arms);
    ASSERT_EQ(read.problem.database.transitions.size(), problem.database.transitions.size());
    for (std::size_t t = 0; t < problem.database.transitions.size(); ++t)
      ASSERT_EQ(read.problem.database.transitions[t].cost, problem.database.transitions[t].cost);
  }
}

/// A value that may stand anywhere in JSON.
std::string random_value(Rng& rng) {
  constexpr std::array<std::string_view, 12> kValues{"null",      "true",   "-1", "0.3",
                                                     "1e300",     "[]",     "{}", "\"a\"",
                                                     "[null, 1]", "[2, 1]", "7",  "\"\""};
  return std::string(kValues[rng.index(kValues.size())]);
}

TEST(ProblemFile, RefusesWhatIsBrokenAndNeverFailsOtherwise) {
  const std::string good = small_problem(kLength, R"(, "bounds": {"length_m": [2.4, null]},
        "key_points": [{"name": "k", "classes": ["wall"]}],
        "segments": [{"name": "n", "from": "k", "bounds": {"length_m": 3}}])");
  Rng rng = plat::testing::property_rng("broken");
  int refused = 0;
  for (int i = 0; i < plat::testing::iterations(3000); ++i) {
    std::string text = good;
    const std::size_t at = rng.index(text.size());
    if (rng.index(3) == 0) {
      text.erase(at, 1 + rng.index(8));
    } else {  // the value behind the next colon
      const std::size_t colon = text.find(':', at);
      if (colon == std::string::npos) continue;
      const std::size_t end = text.find_first_of(",}]", colon);
      text.replace(colon + 1, end - colon - 1, random_value(rng));
    }
    try {
      static_cast<void>(parse_problem(text, "p.json"));
    } catch (const InputError& error) {
      ++refused;
      ASSERT_EQ(std::string(error.what()).find("p.json: "), 0U) << text;
    }
  }
  EXPECT_GT(refused, plat::testing::iterations(1000));
}

TEST(ProblemFile, RefusesToWriteWhatAFileCannotTellApart) {
  SequenceDatabase database;
  database.elements = {{.name = "a"}, {.name = "a"}};
  EXPECT_THROW(problem_json(plain_sequence(database, {})), InputError);
}

}  // namespace
}  // namespace plat::sequences
