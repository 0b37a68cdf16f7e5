// What no city should hold, and every editor will: ties that are missing, too many or
// contradictory.
#include <gtest/gtest.h>

#include <limits>

#include "support/made_tile_city.h"
#include "support/property.h"
#include "tiles/layout_solver.h"

namespace plat::tiles {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TileNode square(double x) { return {{x, 5.0}, 7.0}; }

Joint property(std::uint32_t a, std::uint32_t b, Point at) {
  return {a, at, b, at, JointKind::kProperty};
}

bool is_sound(const LayoutSolution& solution) {
  return std::isfinite(solution.objective) &&
         std::ranges::all_of(solution.placements, &Affine::is_finite);
}

void expect_same_map(const Affine& a, const Affine& b, double tolerance = 1e-6) {
  EXPECT_NEAR(a.xx, b.xx, tolerance);
  EXPECT_NEAR(a.xy, b.xy, tolerance);
  EXPECT_NEAR(a.yx, b.yx, tolerance);
  EXPECT_NEAR(a.yy, b.yy, tolerance);
  EXPECT_NEAR(a.shift.x, b.shift.x, 100.0 * tolerance);
  EXPECT_NEAR(a.shift.y, b.shift.y, 100.0 * tolerance);
}

FailureCode code_of(const Expected<LayoutSolver>& solver) {
  return solver ? FailureCode{} : solver.error().code;
}

TEST(LayoutSolverDegenerate, WhatNothingConnectsToAHeldTileStaysWhereItRests) {
  const TileGraph graph{{square(5), square(15), square(100), square(110)},
                        {property(0, 1, {10, 0}), property(0, 1, {10, 10}),
                         property(2, 3, {105, 0}), property(2, 3, {105, 10})}};
  const auto solver = LayoutSolver::make(graph, {0}, {});
  ASSERT_TRUE(solver);
  const Affine moved = Affine::translation({3, 4});
  const Affine kept = Affine::rotation(0.3, {7, 7});
  const auto solution = solver->solve({{moved}}, std::vector<Affine>{{}, {}, kept, moved});
  ASSERT_TRUE(solution);
  expect_same_map(solution->placements[1], moved);
  EXPECT_EQ(solution->placements[2], kept);
  EXPECT_EQ(solution->placements[3], moved);
  const auto at_rest = solver->solve({{moved}});
  ASSERT_TRUE(at_rest);
  EXPECT_EQ(at_rest->placements[2], Affine{});
}

TEST(LayoutSolverDegenerate, NothingHeldChangesNothing) {
  const TileGraph graph = graph_of(MadeCity{});
  const auto solver = LayoutSolver::make(graph, {}, {});
  ASSERT_TRUE(solver);
  const auto solution = solver->solve({});
  ASSERT_TRUE(solution);
  EXPECT_EQ(solution->placements, std::vector<Affine>(graph.tiles.size()));
}

TEST(LayoutSolverDegenerate, EverythingHeldIsOnlyMeasured) {
  const TileGraph graph{{square(5), square(15)}, {property(0, 1, {10, 0})}};
  const auto solver = LayoutSolver::make(graph, {0, 1}, {});
  ASSERT_TRUE(solver);
  const auto solution = solver->solve({{Affine{}, Affine::translation({3, 4})}});
  ASSERT_TRUE(solution);
  EXPECT_DOUBLE_EQ(solution->gaps_m[0], 5.0);
  EXPECT_GT(solution->objective, 25.0 - 1e-9);
}

TEST(LayoutSolverDegenerate, AnEmptyLayoutIsSolved) {
  const auto solver = LayoutSolver::make({}, {}, {});
  ASSERT_TRUE(solver);
  const auto solution = solver->solve({});
  ASSERT_TRUE(solution);
  EXPECT_TRUE(solution->placements.empty());
  EXPECT_EQ(solution->mean_property_gap_m, 0.0);
  EXPECT_EQ(solution->mean_street_gap_m, 0.0);
  EXPECT_EQ(solution->mean_deformation, 0.0);
}

TEST(LayoutSolverDegenerate, ATileOnOneJointTurnsWithItsNeighbour) {
  const TileGraph graph{{square(5), square(15)}, {property(0, 1, {10, 10})}};
  const Affine turned = Affine::rotation(1.0, {50, 50});
  for (const double rigidity : {0.0, 1.0, 1e4}) {
    const auto solver = LayoutSolver::make(graph, {0}, {rigidity, 0.25});
    ASSERT_TRUE(solver);
    const auto solution = solver->solve({{turned}});
    ASSERT_TRUE(solution);
    expect_same_map(solution->placements[1], turned);
  }
}

TEST(LayoutSolverDegenerate, CollinearJointsAtNoRigidityKeepTheMapAcrossThem) {
  // Three joints on the line x = 10 fix an affine map along it only.
  const TileGraph graph{
      {square(5), square(15)},
      {property(0, 1, {10, 0}), property(0, 1, {10, 5}), property(0, 1, {10, 10})}};
  const auto solver = LayoutSolver::make(graph, {0}, {0.0, 0.25});
  ASSERT_TRUE(solver);
  const Affine sheared{1.0, 0.2, 0.0, 1.1, {30.0, 2.0}};
  const auto solution = solver->solve({{sheared}});
  ASSERT_TRUE(solution);
  expect_same_map(solution->placements[1], sheared, 1e-5);
  EXPECT_LT(solution->objective, 1e-9);
}

TEST(LayoutSolverDegenerate, ContradictoryTargetsShareTheGapAndSayTheResidual) {
  // The middle of three tiles, the outer ones pulled apart by 8 m.
  const TileGraph graph{{square(5), square(15), square(25)},
                        {property(0, 1, {10, 0}), property(0, 1, {10, 10}), property(1, 2, {20, 0}),
                         property(1, 2, {20, 10})}};
  const auto solver = LayoutSolver::make(graph, {0, 2}, {1e4, 0.25});
  ASSERT_TRUE(solver);
  const auto solution =
      solver->solve({{Affine::translation({-4, 0}), Affine::translation({4, 0})}});
  ASSERT_TRUE(solution);
  EXPECT_GT(solution->objective, 10.0);
  EXPECT_GT(solution->mean_property_gap_m, 1.0);
  for (std::size_t j = 1; j < 4; ++j) EXPECT_NEAR(solution->gaps_m[j], solution->gaps_m[0], 1e-6);
}

TEST(LayoutSolverDegenerate, AtNoStreetWeightBlocksAreOnTheirOwn) {
  const TileGraph graph{{square(5), square(15), square(37)},
                        {property(0, 1, {10, 0}),
                         property(0, 1, {10, 10}),
                         {1, {26, 5}, 2, {26, 5}, JointKind::kStreet}}};
  const auto solver = LayoutSolver::make(graph, {0}, {1.0, 0.0});
  ASSERT_TRUE(solver);
  const auto solution = solver->solve({{Affine::translation({9, 0})}});
  ASSERT_TRUE(solution);
  expect_same_map(solution->placements[1], Affine::translation({9, 0}));
  EXPECT_EQ(solution->placements[2], Affine{});
  EXPECT_NEAR(solution->mean_street_gap_m, 9.0, 1e-6);
  EXPECT_LT(solution->objective, 1e-12);
}

TEST(LayoutSolverDegenerate, ATileJoinedToItselfIsSolved) {
  TileGraph graph{{square(5), square(15)}, {property(0, 1, {10, 0}), property(0, 1, {10, 10})}};
  graph.joints.push_back({1, {20, 0}, 1, {20, 10}, JointKind::kStreet});
  const auto solver = LayoutSolver::make(graph, {0}, {});
  ASSERT_TRUE(solver);
  const auto solution = solver->solve({{Affine{}}});
  ASSERT_TRUE(solution);
  EXPECT_TRUE(is_sound(*solution));
}

TEST(LayoutSolverDegenerate, TinyTilesAndFarJointsLeaveNoNaN) {
  Rng rng = plat::testing::property_rng("TinyTilesAndFarJoints");
  int solved = 0;
  for (int i = 0; i < plat::testing::iterations(300); ++i) {
    TileGraph graph = graph_of(MadeCity{.blocks_x = 2, .blocks_y = 2, .seed = rng()});
    for (TileNode& node : graph.tiles) {
      if (rng.index(4) == 0) node.radius_m = std::pow(10.0, rng.uniform(-12, 0));
    }
    // Several vertices fall into one, and joints are lost.
    for (Joint& joint : graph.joints) {
      if (rng.index(4) == 0) joint.rest_a = joint.rest_b = graph.tiles[joint.a].centroid;
    }
    std::erase_if(graph.joints, [&](const Joint&) { return rng.index(4) == 0; });
    const SolverOptions options{rng.index(2) == 0 ? 0.0 : 1e4, rng.index(2) == 0 ? 1e-6 : 1.0,
                                rng.index(2) == 0 ? 0.0 : 1.0};
    const auto solver = LayoutSolver::make(graph, {0, 17}, options);
    if (!solver) continue;
    const Affine motion = Affine::rotation(0.5, {20, 20});
    const auto solution = solver->solve({{motion, motion}});
    ASSERT_TRUE(solution);
    EXPECT_TRUE(is_sound(*solution));
    // All joints that have lost a point still agree, as every point is where it is at rest.
    EXPECT_LT(solution->objective, 1e-6);
    ++solved;
  }
  EXPECT_EQ(solved, plat::testing::iterations(300));
}

TEST(LayoutSolverDegenerate, WhatIsOutOfRangeIsAFailure) {
  const TileGraph good{{square(5), square(15)}, {property(0, 1, {10, 0})}};
  EXPECT_EQ(code_of(LayoutSolver::make(good, {2}, {})), FailureCode::kOutOfRange);
  EXPECT_EQ(code_of(LayoutSolver::make(good, {1, 0}, {})), FailureCode::kOutOfRange);
  EXPECT_EQ(code_of(LayoutSolver::make(good, {1, 1}, {})), FailureCode::kOutOfRange);
  EXPECT_EQ(code_of(LayoutSolver::make(good, {0}, {-1.0, 0.25})), FailureCode::kOutOfRange);
  EXPECT_EQ(code_of(LayoutSolver::make(good, {0}, {kNaN, 0.25})), FailureCode::kOutOfRange);
  EXPECT_EQ(code_of(LayoutSolver::make(good, {0}, {1.0, kInfinity})), FailureCode::kOutOfRange);
  EXPECT_EQ(code_of(LayoutSolver::make(good, {0}, {1.0, 1.0, 1.5})), FailureCode::kOutOfRange);
  for (const double radius_m : {0.0, -1.0, kNaN, kInfinity}) {
    TileGraph bad = good;
    bad.tiles[1].radius_m = radius_m;
    EXPECT_EQ(code_of(LayoutSolver::make(bad, {0}, {})), FailureCode::kOutOfRange) << radius_m;
  }
  TileGraph bad = good;
  bad.tiles[0].centroid.x = kNaN;
  EXPECT_EQ(code_of(LayoutSolver::make(bad, {0}, {})), FailureCode::kOutOfRange);
  bad = good;
  bad.joints[0].rest_b.y = kInfinity;
  EXPECT_EQ(code_of(LayoutSolver::make(bad, {0}, {})), FailureCode::kOutOfRange);
  bad = good;
  bad.joints[0].b = 7;
  EXPECT_EQ(code_of(LayoutSolver::make(bad, {0}, {})), FailureCode::kOutOfRange);
}

TEST(LayoutSolverDegenerate, TargetsWithoutAreaAreAFailure) {
  const TileGraph graph{{square(5), square(15)}, {property(0, 1, {10, 0})}};
  const auto solver = LayoutSolver::make(graph, {0}, {});
  ASSERT_TRUE(solver);
  for (const Affine& target :
       {Affine{1, 0, 0, 0, {}}, Affine{kNaN, 0, 0, 1, {}}, Affine{1, 0, 0, 1, {kInfinity, 0}}}) {
    const auto solution = solver->solve({{target}});
    ASSERT_FALSE(solution);
    EXPECT_EQ(solution.error().code, FailureCode::kOutOfRange);
  }
  const auto solution = solver->solve({{Affine{}}}, std::vector<Affine>(2, {kNaN, 0, 0, 1, {}}));
  ASSERT_FALSE(solution);
  EXPECT_EQ(solution.error().code, FailureCode::kOutOfRange);
}

}  // namespace
}  // namespace plat::tiles
