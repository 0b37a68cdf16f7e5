#include "buildings/skeleton_plan.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/failure.h"

namespace plat::buildings {
namespace {

using Kind = SkeletonKeyPoint::Kind;
constexpr FrontSide kL = FrontSide::kLeft;
constexpr FrontSide kR = FrontSide::kRight;

std::vector<Kind> kinds(const SkeletonPlan& plan) {
  std::vector<Kind> out;
  for (const SkeletonKeyPoint& key : plan.key_points) out.push_back(key.kind);
  return out;
}

std::string refusal(const BuildingSkeleton& skeleton) {
  try {
    static_cast<void>(plan_of(skeleton));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SkeletonPlan, TellsLeftFromRightEndsByTheFront) {
  const BuildingSkeleton south{{{0, 0}, {30, 0}}, {{0, 1, kR}}, {}};
  EXPECT_EQ(kinds(plan_of(south)), (std::vector{Kind::kLeftEnd, Kind::kRightEnd}));
  const BuildingSkeleton north{{{0, 0}, {30, 0}}, {{0, 1, kL}}, {}};
  EXPECT_EQ(kinds(plan_of(north)), (std::vector{Kind::kRightEnd, Kind::kLeftEnd}));
}

TEST(SkeletonPlan, WalksEveryEdgeWithItsFrontOnTheRight) {
  const BuildingSkeleton skeleton{{{0, 0}, {30, 0}}, {{0, 1, kL}}, {}};
  const SkeletonPlan plan = plan_of(skeleton);
  EXPECT_EQ(plan.rows.front().start, (Point{30, 0}));
  EXPECT_EQ(plan.rows.front().end, (Point{0, 0}));
}

TEST(SkeletonPlan, MeasuresTheTurnOfACornerAlongTheRows) {
  const BuildingSkeleton skeleton{{{0, 0}, {30, 0}, {30, 20}}, {{0, 1, kR}, {1, 2, kR}}, {}};
  const SkeletonPlan plan = plan_of(skeleton);
  ASSERT_EQ(kinds(plan), (std::vector{Kind::kLeftEnd, Kind::kCorner, Kind::kRightEnd}));
  EXPECT_NEAR(plan.key_points[1].turn_rad, std::numbers::pi / 2, 1e-12);
  const BuildingSkeleton inside{{{0, 0}, {30, 0}, {30, 20}}, {{0, 1, kL}, {1, 2, kL}}, {}};
  EXPECT_NEAR(plan_of(inside).key_points[1].turn_rad, -std::numbers::pi / 2, 1e-12);
}

TEST(SkeletonPlan, TellsTheSideOfAStemAndHowItsRowIsWalked) {
  // The bar looks south; the stem goes north, to the back, its front to the east.
  const BuildingSkeleton back{
      {{0, 0}, {20, 0}, {40, 0}, {20, 25}}, {{0, 1, kR}, {1, 2, kR}, {1, 3, kR}}, {}};
  SkeletonPlan plan = plan_of(back);
  ASSERT_EQ(plan.key_points[1].kind, Kind::kTee);
  EXPECT_EQ(plan.key_points[1].stem_side, StemSide::kBack);
  EXPECT_EQ(plan.rows[*plan.key_points[1].stem_row].from_port, PortRole::kStem);
  EXPECT_EQ(plan.key_points[3].kind, Kind::kRightEnd);

  const BuildingSkeleton front{
      {{0, 0}, {20, 0}, {40, 0}, {20, 25}}, {{0, 1, kL}, {1, 2, kL}, {1, 3, kL}}, {}};
  plan = plan_of(front);
  EXPECT_EQ(plan.key_points[1].stem_side, StemSide::kFront);
  EXPECT_EQ(plan.rows[*plan.key_points[1].stem_row].to_port, PortRole::kStem);
  EXPECT_EQ(plan.key_points[3].kind, Kind::kLeftEnd);
}

TEST(SkeletonPlan, MakesOneRowOfEdgesInOneLine) {
  const BuildingSkeleton skeleton{
      {{0, 0}, {10, 0}, {20, 0.05}, {30, 0}}, {{0, 1, kR}, {2, 1, kL}, {2, 3, kR}}, {}};
  const SkeletonPlan plan = plan_of(skeleton);
  ASSERT_EQ(plan.rows.size(), 1U);
  EXPECT_EQ(plan.rows.front().edges, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_DOUBLE_EQ(length_m(plan.rows.front()), 30.0);
}

TEST(SkeletonPlan, CutsWhereAnEdgeHasBoundsOfItsOwn) {
  const BuildingSkeleton skeleton{
      {{0, 0}, {10, 0}, {30, 0}}, {{0, 1, kR, {{"balconies", 1, 1}}}, {1, 2, kR}}, {}};
  EXPECT_EQ(kinds(plan_of(skeleton)), (std::vector{Kind::kLeftEnd, Kind::kCut, Kind::kRightEnd}));
}

TEST(SkeletonPlan, ClosesACourtyard) {
  const BuildingSkeleton skeleton{
      {{0, 0}, {40, 0}, {40, 30}, {0, 30}}, {{0, 1, kR}, {1, 2, kR}, {2, 3, kR}, {3, 0, kR}}, {}};
  const SkeletonPlan plan = plan_of(skeleton);
  EXPECT_EQ(plan.rows.size(), 4U);
  for (const SkeletonKeyPoint& key : plan.key_points) {
    EXPECT_EQ(key.kind, Kind::kCorner);
    EXPECT_EQ(plan.rows[*key.left_row].end, skeleton.nodes[key.node]);
    EXPECT_EQ(plan.rows[*key.right_row].start, skeleton.nodes[key.node]);
  }
}

TEST(SkeletonPlan, RefusesWhatNoBuildingCanBe) {
  const std::vector<Point> cross{{0, 0}, {20, 0}, {40, 0}, {20, 20}, {20, -20}};
  EXPECT_NE(refusal({cross, {{0, 1, kR}, {1, 2, kR}, {1, 3, kR}, {1, 4, kR}}, {}})
                .find("node 1 at (20.0, 0.0): 4 edges meet"),
            std::string::npos);
  EXPECT_NE(refusal({{{0, 0}, {30, 0}, {30, 20}}, {{0, 1, kR}, {1, 2, kL}}, {}})
                .find("node 1 at (30.0, 0.0): the front changes sides"),
            std::string::npos);
  EXPECT_NE(
      refusal({{{0, 0}, {20, 0}, {35, 12}, {35, -12}}, {{0, 1, kR}, {1, 2, kR}, {1, 3, kR}}, {}})
          .find("no two of them go on straight"),
      std::string::npos);
  EXPECT_NE(
      refusal({{{0, 0}, {20, 0}, {40, 0}, {30, 20}}, {{0, 1, kR}, {1, 2, kR}, {1, 3, kR}}, {}})
          .find("the stem stands at 63.4 degrees"),
      std::string::npos);
  EXPECT_NE(refusal({{{0, 0}, {30, 0}, {0, 1}}, {{0, 1, kR}, {1, 2, kR}}, {}}).find("a turn of"),
            std::string::npos);
  EXPECT_NE(refusal({{{0, 0}, {0, 0.1}}, {{0, 1, kR}}, {}}).find("edge 0 from node 0 to node 1"),
            std::string::npos);
  EXPECT_NE(refusal({{{0, 0}, {9, 0}}, {{0, 7, kR}}, {}}).find("edge 0: node 7, there are 2"),
            std::string::npos);
  EXPECT_NE(refusal({{{0, 0}, {9, 0}}, {{0, 1, kR}, {1, 0, kR}}, {}}).find("is there twice"),
            std::string::npos);
  EXPECT_NE(refusal({{{0, 0}, {9, 0}, {50, 0}, {59, 0}}, {{0, 1, kR}, {2, 3, kR}}, {}})
                .find("does not hang together"),
            std::string::npos);
  EXPECT_NE(refusal({{{0, 0}, {30, 0}, {30, 20}, {15, 20}, {15, -20}},
                     {{0, 1, kR}, {1, 2, kR}, {2, 3, kR}, {3, 4, kR}},
                     {}})
                .find("edges 0 and 3 cross"),
            std::string::npos);
}

}  // namespace
}  // namespace plat::buildings
