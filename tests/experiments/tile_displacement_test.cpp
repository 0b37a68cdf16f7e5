#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/working_grid.h"
#include "support/made_tile_layout.h"
#include "tile_displacement/displacement.h"
#include "tiles/tile_graph.h"

namespace plat::displacement {
namespace {

using tiles::Corner;
using tiles::Tile;
using tiles::TileGraph;
using tiles::TileLayout;

/// Vertices stand on the working grid, corners where placements have them do not.
constexpr double kRounding_m = 2.0 * kGridStep_m;

/// Five by five blocks, whose middle block is moved and whose outer blocks stay.
struct Moved {
  TileLayout layout;
  TileGraph graph;
  Displacement displacement;
};

Moved moved_middle(Point shift_m) {
  testing::MadeLayout made;
  made.blocks_x = 5;
  made.blocks_y = 5;
  Moved out{testing::made_layout(made), {}, {}};
  out.graph = tiles::graph_of(out.layout);
  out.displacement = undisplaced(out.layout);
  for (std::size_t i = 0; i < out.layout.tiles.size(); ++i) {
    if (out.layout.tiles[i].block != 12) continue;
    out.displacement.roles[i] = Role::kMoved;
    out.displacement.targets[i] = Affine::translation(shift_m) * out.displacement.targets[i];
  }
  hold_beyond(out.layout, 30.0, out.displacement);
  return out;
}

/// A row of parcels of one block, of which the west ones are free and the east ones stay.
Moved split_block(Point shift_m) {
  testing::MadeLayout made;
  made.blocks_x = 1;
  made.blocks_y = 1;
  made.parcels_south = 6;
  made.parcels_north = 6;
  Moved out{testing::made_layout(made), {}, {}};
  out.graph = tiles::graph_of(out.layout);
  out.displacement = undisplaced(out.layout);
  for (std::size_t i = 0; i < out.layout.tiles.size(); ++i) {
    const std::size_t column = i % 6;
    out.displacement.roles[i] = column == 0 ? Role::kMoved : column < 3 ? Role::kFree : Role::kHeld;
    if (column == 0)
      out.displacement.targets[i] = Affine::translation(shift_m) * out.displacement.targets[i];
  }
  return out;
}

Outcome outcome_of(const Moved& moved, const Way& way) {
  auto out = displaced(moved.layout, moved.graph, moved.displacement, way);
  if (!out) throw LogicError(out.error().message);
  return *std::move(out);
}

Errors errors_of(const Moved& moved, const Outcome& outcome) {
  return errors_of(moved.layout, moved.graph, moved.displacement.roles, outcome);
}

/// The farthest that two tiles have a vertex of theirs apart.
double widest_tear_m(const TileLayout& layout, const Outcome& outcome) {
  std::map<std::uint32_t, Point> first;
  double out = 0.0;
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    for (std::size_t c = 0; c < outcome.outer[i].size(); ++c) {
      const Point at = outcome.outer[i][c];
      const auto known = first.emplace(layout.tiles[i].rings.front()[c].vertex, at).first->second;
      out = std::max(out, distance(known, at));
    }
  }
  return out;
}

TEST(Warp, TearsNoVertexApartAlsoWhereATileThatMakesRoomMeetsOneThatIsToStay) {
  const Moved moved = split_block({4.0, 6.0});
  const Outcome outcome = outcome_of(moved, {"warp", Method::kWarp, {}});
  EXPECT_EQ(widest_tear_m(moved.layout, outcome), 0.0);
  const Errors errors = errors_of(moved, outcome);
  EXPECT_EQ(errors.gap_m, 0.0);
  EXPECT_EQ(errors.free_tiles, 4U);
  // What it takes for that: tiles that are to stay are bent and leave their place.
  EXPECT_EQ(errors.held_tiles, 6U);
  EXPECT_GT(errors.held_deformation, 0.01);
  EXPECT_GT(errors.largest_held_off_m, 0.05);
  EXPECT_GE(errors.largest_held_off_m, errors.held_off_m);
}

TEST(Warp, CarriesCornersOfMovedTilesToTheirTargets) {
  const Moved moved = moved_middle({9.0, -4.0});
  const Outcome outcome = outcome_of(moved, {"warp", Method::kWarp, {}});
  for (std::size_t i = 0; i < moved.layout.tiles.size(); ++i) {
    if (moved.displacement.roles[i] != Role::kMoved) continue;
    for (std::size_t c = 0; c < outcome.outer[i].size(); ++c) {
      const Corner& corner = moved.layout.tiles[i].rings.front()[c];
      EXPECT_LT(distance(outcome.outer[i][c], moved.displacement.targets[i](corner.rest)),
                kRounding_m);
    }
  }
}

TEST(Warp, WithoutADisplacementIsTheIdentityAlsoWhereVerticesAreOffTheirTilesCorners) {
  Moved moved = moved_middle({0.0, 0.0});
  for (tiles::LayoutVertex& vertex : moved.layout.vertices) vertex.at = vertex.at + Point{0.1, 0.1};
  const Outcome outcome = outcome_of(moved, {"warp", Method::kWarp, {}});
  const auto before = outer_rings(moved.layout);
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t c = 0; c < before[i].size(); ++c)
      EXPECT_LT(distance(outcome.outer[i][c], before[i][c]), kRounding_m);
  }
  const Errors errors = errors_of(moved, outcome);
  EXPECT_NEAR(errors.largest_held_off_m, std::hypot(0.1, 0.1), kRounding_m);
  EXPECT_LT(errors.closed_deformation, 1e-3);
}

TEST(Solver, GapsAndObjectiveAreThoseMeasuredOfItsPlacementsAndHeldTilesAreNotDeformed) {
  const Moved moved = moved_middle({9.0, -4.0});
  Way way{"affine", Method::kSolver, {}};
  way.solver.rigidity = 1.0;
  const Outcome outcome = outcome_of(moved, way);
  const auto measured =
      tiles::measure_placements(moved.graph, outcome.solution.placements, way.solver);
  EXPECT_EQ(outcome.joint_gaps_m, measured.gaps_m);
  EXPECT_EQ(outcome.solution.gaps_m, measured.gaps_m);
  EXPECT_DOUBLE_EQ(outcome.solution.objective, measured.objective);
  EXPECT_GT(errors_of(moved, outcome).gap_m, 0.01);
  for (std::size_t i = 0; i < moved.layout.tiles.size(); ++i) {
    if (moved.displacement.roles[i] == Role::kFree) continue;
    EXPECT_EQ(outcome.solution.placements[i], moved.displacement.targets[i]);
  }
}

TEST(NoWay, GapsAtTheBorderOfWhatIsMovedAreDistancesOfCorners) {
  const Moved moved = split_block({3.0, 4.0});
  const Outcome outcome = outcome_of(moved, {"apart", Method::kNone, {}});
  std::size_t torn = 0;
  for (std::size_t j = 0; j < moved.graph.joints.size(); ++j) {
    const tiles::Joint& joint = moved.graph.joints[j];
    const bool is_border = (moved.displacement.roles[joint.a] == Role::kMoved) !=
                           (moved.displacement.roles[joint.b] == Role::kMoved);
    torn += is_border ? 1 : 0;
    EXPECT_NEAR(outcome.joint_gaps_m[j], is_border ? 5.0 : 0.0, kRounding_m);
  }
  EXPECT_GT(torn, 0U);
}

TEST(Errors, OfTilesThatAreToStayCountWhatTheirCornersLeaveTheirPlaceBy) {
  const Moved moved = split_block({0.0, 0.0});
  Outcome outcome = outcome_of(moved, {"apart", Method::kNone, {}});
  std::size_t held = 0;
  for (std::size_t i = 0; i < outcome.outer.size(); ++i) {
    if (moved.displacement.roles[i] != Role::kHeld) continue;
    // One of them is stretched to twice its width, another one carried off by 10 m.
    if (held == 0) {
      for (Point& p : outcome.outer[i]) p.x *= 2.0;
    } else if (held == 1) {
      for (Point& p : outcome.outer[i]) p = p + Point{6.0, 8.0};
    }
    ++held;
  }
  const Errors stretched = errors_of(moved, outcome);
  EXPECT_NEAR(stretched.held_deformation, 1.0 / 6.0, 1e-3);
  const auto& far = outcome.outer[3];
  double off_m = 10.0;
  double most_m = 10.0;
  for (const Point p : far) {
    off_m += std::abs(p.x) / 2.0 / static_cast<double>(far.size());
    most_m = std::max(most_m, std::abs(p.x) / 2.0);
  }
  EXPECT_NEAR(stretched.held_off_m, off_m / 6.0, kRounding_m);
  EXPECT_NEAR(stretched.largest_held_off_m, most_m, kRounding_m);
}

TEST(Reach, TilesBeyondItAndPinnedOnesStay) {
  Moved moved = split_block({3.0, 4.0});
  for (std::size_t i = 0; i < moved.layout.tiles.size(); ++i) {
    moved.displacement.roles[i] = i % 6 == 0 ? Role::kMoved : Role::kFree;
    moved.layout.tiles[i].is_pinned = i == 2;
  }
  hold_beyond(moved.layout, 20.0, moved.displacement);
  EXPECT_EQ(moved.displacement.roles[0], Role::kMoved);
  EXPECT_EQ(moved.displacement.roles[1], Role::kFree);
  EXPECT_EQ(moved.displacement.roles[2], Role::kHeld);
  EXPECT_EQ(moved.displacement.roles[8], Role::kFree);
  EXPECT_EQ(moved.displacement.roles[5], Role::kHeld);
}

}  // namespace
}  // namespace plat::displacement
