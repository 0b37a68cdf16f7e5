#include "sequences/structure_check.h"

#include <gtest/gtest.h>

#include "core/failure.h"
#include "sequences/compiled_problem.h"

namespace plat::sequences {
namespace {

/// Two elements and a chain: free end - key point 0 - key point 1 - free end.
SequenceProblem chain() {
  SequenceProblem problem;
  problem.database.resources = {{"length", 1.0}};
  problem.database.elements = {{.name = "a", .uses = {1}}, {.name = "b", .uses = {2}}};
  problem.database.transitions = {{.from = 0, .to = 1, .cost = 1}, {.from = 1, .to = 0, .cost = 1}};
  problem.structure.key_points = {{"door", {0, 1}}, {"gate", {1}}};
  problem.structure.segments.resize(3);
  problem.structure.segments[0].to = 0;
  problem.structure.segments[1].from = 0;
  problem.structure.segments[1].to = 1;
  problem.structure.segments[1].name = "wall";
  problem.structure.segments[2].from = 1;
  problem.bounds = {{0, 20}};
  return problem;
}

std::string refusal(const SequenceProblem& problem) {
  try {
    compile(problem);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(StructureCheck, AcceptsAChain) { EXPECT_EQ(refusal(chain()), ""); }

TEST(StructureCheck, RefusesKeyPointsWithoutElementsThatThereAre) {
  SequenceProblem problem = chain();
  problem.structure.key_points[0].allowed = {};
  EXPECT_EQ(refusal(problem), "key point 0 (door): no element is allowed");
  problem.structure.key_points[0].allowed = {1, 0};
  EXPECT_EQ(refusal(problem), "key point 0 (door): the allowed elements are not ascending");
  problem.structure.key_points[0].allowed = {1, 2};
  EXPECT_EQ(refusal(problem), "key point 0 (door): element 2 is allowed, of 2");
}

TEST(StructureCheck, RefusesBoundsThatAreNone) {
  SequenceProblem problem = chain();
  problem.structure.segments[1].bounds = {{3, 2}};
  EXPECT_EQ(refusal(problem),
            "segment 1 (wall): bounds 3..2 on resource 0, allowed 0 <= min <= max");
  problem.structure.segments[1].bounds = {{}, {}};
  EXPECT_EQ(refusal(problem), "segment 1 (wall): 2 bounds, of 1 resources");
  problem = chain();
  problem.bounds = {{-1, 2}};
  EXPECT_EQ(refusal(problem), "problem: bounds -1..2 on resource 0, allowed 0 <= min <= max");
}

TEST(StructureCheck, RefusesSegmentsThatDoNotJoinTheRest) {
  SequenceProblem problem = chain();
  problem.structure.segments[1].to.reset();
  EXPECT_EQ(refusal(problem), "key point 1 (gate): not connected with key point 0 (door)");
  problem.structure.segments[1].from.reset();
  EXPECT_EQ(refusal(problem), "segment 1 (wall): touches no key point");
  problem = chain();
  problem.structure.segments[2].from = 7;
  EXPECT_EQ(refusal(problem), "segment 2: key point 7, of 2");
  problem = chain();
  problem.structure.segments.clear();
  EXPECT_EQ(refusal(problem), "structure: no segment");
  problem = chain();
  problem.structure.key_points.resize(1);
  problem.structure.segments.resize(1);
  problem.structure.segments[0].to = 0;
  EXPECT_EQ(refusal(problem), "");
}

TEST(StructureCheck, RefusesTwoSegmentsAtOnePort) {
  SequenceProblem problem = chain();
  problem.structure.segments[2].from_port = Port::kLeft;
  EXPECT_EQ(refusal(problem), "key point 1 (gate): two segments at one port");
}

TEST(StructureCheck, NamesTheElementsOfACircleThatCostsAndConsumesNothing) {
  SequenceProblem problem = chain();
  problem.database.elements.insert(problem.database.elements.begin(),
                                   Element{.name = "corner", .uses = {1}, .is_filling = false});
  for (auto& transition : problem.database.transitions) {
    ++transition.from;
    ++transition.to;
    transition.cost = 0;
  }
  EXPECT_EQ(refusal(problem), "");
  problem.bounds = {};
  const std::string why = refusal(problem);
  EXPECT_NE(why.find("in a circle"), std::string::npos) << why;
  EXPECT_NE(why.find("; elements: a, b"), std::string::npos) << why;
}

TEST(StructureCheck, TellsAPlainSequence) {
  EXPECT_TRUE(is_plain(plain_sequence({}, {}).structure));
  EXPECT_FALSE(is_plain(chain().structure));
  EXPECT_FALSE(is_plain({}));
}

}  // namespace
}  // namespace plat::sequences
