#include "tiles/layout_stiffening_internal.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tiles/layout_construction.h"
#include "tiles/reconfiguration_support.h"

namespace plat::tiles {
namespace {

using namespace plat::testing;  // NOLINT: the support of this test

constexpr std::uint32_t kWest = 0;
constexpr std::uint32_t kNeedle = 3;
constexpr std::uint32_t kEast = 4;

/// Five tiles in a row; the fourth has a needle down along the fifth, half a metre long and 1 mm
/// wide, as parcel 132-148 of Cambridge has. The first one is pinned.
TileLayout row_with_needle() {
  const std::vector<TilePiece> pieces{
      {"west", "", 0, {{{-60, 0}, {-40, 0}, {-40, 20}, {-60, 20}}, {}}},
      {"far", "", 0, {{{-40, 0}, {-20, 0}, {-20, 20}, {-40, 20}}, {}}},
      {"near", "", 0, {{{-20, 0}, {0, 0}, {0, 20}, {-20, 20}}, {}}},
      {"needle", "", 0, {{{0, 0}, {19.999, 0}, {20, -0.5}, {20, 20}, {0, 20}}, {}}},
      {"east", "", 0, {{{20, -0.5}, {40, -0.5}, {40, 20}, {20, 20}}, {}}}};
  TileLayout layout = construct_layout(pieces).layout;
  layout.tiles.at(kWest).is_pinned = true;
  return layout;
}

const Affine kMotion = Affine::translation({-4.0, 0.0});

Expected<Reconfiguration> east_moved(const TileLayout& layout) {
  return move_tiles(layout, {{layout.tiles.at(kEast).id}}, kMotion, {});
}

TEST(LayoutStiffening, TilesThatOverlapGiveWayLessThanThoseAround) {
  const TileLayout layout = row_with_needle();
  ASSERT_EQ(layout.tiles.size(), 5U);
  const auto moved = east_moved(layout);
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(defect_of(moved->layout), "");
  EXPECT_GE(moved->report.stiffened, 2U);
  EXPECT_GE(moved->report.rounds, 2U);
}

TEST(LayoutStiffening, WhatIsHeldStaysHeld) {
  const TileLayout layout = row_with_needle();
  const auto moved = east_moved(layout);
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(moved->layout.tiles[kWest].placement, Affine{});
  EXPECT_EQ(moved->layout.tiles[kEast].placement, kMotion);
}

TEST(LayoutStiffening, ErrorsAreThoseOfTheLayoutWithoutIt) {
  const auto moved = east_moved(row_with_needle());
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_NEAR(moved->report.objective, objective_of(moved->layout, {}), 1e-9);
}

TEST(LayoutStiffening, TheSameInputGivesTheSame) {
  const auto one = east_moved(row_with_needle());
  const auto two = east_moved(row_with_needle());
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->layout, two->layout);
}

TEST(LayoutStiffening, WhereNothingOverlapsNothingIsStiffer) {
  const TileLayout layout = made_layout({});
  const auto moved = move_tiles(layout, {{layout.tiles[40].id}}, Affine::translation({1.5, 2.0}),
                                small_city_options());
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(moved->report.stiffened, 0U);
  EXPECT_EQ(moved->report.rounds, 1U);
}

TEST(LayoutStiffening, TilesThatAreHeldOnEachOtherAreRefusedAndNothingChanges) {
  const TileLayout layout = row_with_needle();
  TileLayout copy = layout;
  const auto moved =
      move_tiles(copy, {{copy.tiles[kEast].id}}, Affine::translation({-90.0, 0.0}), {});
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, FailureCode::kTilesOverlap);
  EXPECT_EQ(copy, layout);
}

TEST(LayoutStiffening, ATileAndItsJointsWeighMoreOthersDoNot) {
  const TileGraph graph = graph_of(row_with_needle());
  const TileGraph stiffer = detail::stiffened(graph, std::vector{1.0, 1.0, 1.0, 1.0, 4.0});
  EXPECT_EQ(stiffer.tiles[kWest].rigidity, 1.0);
  EXPECT_EQ(stiffer.tiles[kNeedle].rigidity, 1.0);
  EXPECT_EQ(stiffer.tiles[kEast].rigidity, 4.0);
  ASSERT_FALSE(stiffer.joints.empty());
  for (const Joint& joint : stiffer.joints)
    EXPECT_EQ(joint.weight, std::max(joint.a, joint.b) == kEast ? 4.0 : 1.0);
}

TEST(LayoutSolver, OwnWeightsMultiplyThoseOfTheOptions) {
  const TileGraph graph = graph_of(row_with_needle());
  const std::vector<Affine> targets{Affine{}, kMotion * Affine::rotation(0.1, {30, 10})};
  SolverOptions options;
  options.keep_size = 0.5;
  const auto solve = [&](const TileGraph& of, const SolverOptions& with) {
    return LayoutSolver::make(of, {kWest, kEast}, with).value().solve(targets).value();
  };
  TileGraph rigid = graph;
  for (TileNode& node : rigid.tiles) node.rigidity = 8.0;
  TileGraph joined = graph;
  for (Joint& joint : joined.joints) joint.weight = 0.125;
  SolverOptions rigid_options = options;
  rigid_options.rigidity = 8.0;
  const Affine expected = solve(graph, rigid_options).placements[kNeedle];
  const Point corner{20, 20};
  EXPECT_LT(distance(solve(rigid, options).placements[kNeedle](corner), expected(corner)), 1e-6);
  EXPECT_LT(distance(solve(joined, options).placements[kNeedle](corner), expected(corner)), 1e-6);
  EXPECT_GT(distance(solve(graph, options).placements[kNeedle](corner), expected(corner)), 1e-3);
}

TEST(LayoutSolver, WeightsOutOfRangeAreRefused) {
  TileGraph graph = graph_of(row_with_needle());
  graph.joints.front().weight = -1.0;
  EXPECT_EQ(LayoutSolver::make(graph, {kWest}, {}).error().code, FailureCode::kOutOfRange);
  graph = graph_of(row_with_needle());
  graph.tiles.back().rigidity = -1.0;
  EXPECT_EQ(LayoutSolver::make(graph, {kWest}, {}).error().code, FailureCode::kOutOfRange);
}

}  // namespace
}  // namespace plat::tiles
