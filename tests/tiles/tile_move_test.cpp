#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tiles/reconfiguration_support.h"

namespace plat::tiles {
namespace {

using namespace plat::testing;  // NOLINT: the support of this test

TEST(MoveTiles, AMovedTileIsPinnedWhereItWasMovedTo) {
  const TileLayout layout = made_layout({});
  const TileId id = layout.tiles[40].id;
  const Affine motion = Affine::translation({1.5, 2.0});
  const auto moved = move_tiles(layout, {{id}}, motion, small_city_options());
  ASSERT_TRUE(moved) << moved.error().message;
  const Tile& tile = tile_of(moved->layout, id);
  EXPECT_EQ(tile.placement, motion * layout.tiles[40].placement);
  EXPECT_TRUE(tile.is_pinned);
  EXPECT_GT(moved->report.moved.size(), 10U);
  EXPECT_TRUE(std::ranges::count(moved->report.moved, id));
  EXPECT_EQ(defect_of(moved->layout), "");
}

TEST(MoveTiles, TheIdentityPinsAndMovesNothing) {
  const TileLayout layout = made_layout({});
  const auto moved = move_tiles(layout, {{layout.tiles[3].id}}, {}, small_city_options());
  ASSERT_TRUE(moved);
  EXPECT_TRUE(moved->report.moved.empty());
  TileLayout expected = layout;
  expected.tiles[3].is_pinned = true;
  EXPECT_EQ(moved->layout, expected);
}

TEST(MoveTiles, TilesBeyondReachAndPinnedOnesStayWhereTheyAre) {
  TileLayout layout = made_layout({});
  const TileId pinned = layout.tiles[42].id;
  layout.tiles[42].is_pinned = true;
  auto options = small_city_options();
  options.reach_m = 40.0;
  const auto moved =
      move_tiles(layout, {{layout.tiles[40].id}}, Affine::translation({1.0, 1.0}), options);
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(tile_of(moved->layout, pinned).placement, Affine{});
  std::size_t stayed = 0;
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    const bool is_far = distance(centroid(shape_of(layout, layout.tiles[i])),
                                 centroid(shape_of(layout, layout.tiles[40]))) > 120.0;
    if (!is_far) continue;
    ++stayed;
    EXPECT_EQ(moved->layout.tiles[i].placement, layout.tiles[i].placement);
  }
  EXPECT_GT(stayed, 10U);
}

TEST(MoveTiles, LaterMovesKeepEarlierPins) {
  const TileLayout layout = made_layout({});
  const auto options = small_city_options();
  const TileId first = layout.tiles[0].id;
  const TileId second = layout.tiles[44].id;
  const Affine turn = Affine::rotation(0.05, middle_of(layout, first));
  const auto one = move_tiles(layout, {{first}}, turn, options);
  ASSERT_TRUE(one) << one.error().message;
  const auto two = move_tiles(one->layout, {{second}}, Affine::translation({1, -1}), options);
  ASSERT_TRUE(two) << two.error().message;
  EXPECT_EQ(tile_of(two->layout, first).placement, turn);
}

TEST(MoveTiles, AGroupMovesAsOne) {
  const TileLayout layout = made_layout({});
  const std::vector<TileId> group{layout.tiles[36].id, layout.tiles[37].id, layout.tiles[40].id};
  const Affine turn = Affine::rotation(0.04, middle_of(layout, group[0]));
  const auto moved = move_tiles(layout, group, turn, small_city_options());
  ASSERT_TRUE(moved) << moved.error().message;
  for (const TileId id : group) EXPECT_EQ(tile_of(moved->layout, id).placement, turn);
}

TEST(MoveTiles, ATurnedCityGivesTheTurnedResult) {
  const Affine turn = Affine::rotation(0.7, {100, 50});
  const TileLayout layout = made_layout({});
  const TileLayout turned = made_layout({.turn = turn});
  ASSERT_EQ(layout.tiles.size(), turned.tiles.size());
  const Affine motion = Affine::translation({2.0, 1.0});
  const Affine turned_motion = turn * motion * *turn.inverse();
  auto options = small_city_options();
  options.reach_m = 30.0;
  const auto a = move_tiles(layout, {{layout.tiles[40].id}}, motion, options);
  // The reach is measured between boxes along the axes: what is held is said by pins.
  TileLayout held = turned;
  for (std::size_t i = 0; i < held.tiles.size(); ++i)
    held.tiles[i].is_pinned = i != 40 && a && a->layout.tiles[i].placement == Affine{};
  options.reach_m.reset();
  const auto b = move_tiles(held, {{turned.tiles[40].id}}, turned_motion, options);
  ASSERT_TRUE(a && b);
  EXPECT_GT(a->report.moved.size(), 5U);
  constexpr double kRounding_m = 0.02;  // both cities are rounded to the grid before they are moved
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    const Point expected = turn(centroid(shape_of(a->layout, a->layout.tiles[i])));
    EXPECT_LT(distance(centroid(shape_of(b->layout, b->layout.tiles[i])), expected), kRounding_m);
  }
}

TEST(MoveTiles, OverlapsAreRefusedWithTheTilesNamed) {
  const TileLayout layout = made_layout({});
  auto options = small_city_options();
  options.reach_m = 0.0;
  const auto moved =
      move_tiles(layout, {{layout.tiles[40].id}}, Affine::translation({60, 0}), options);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, FailureCode::kTilesOverlap);
  EXPECT_NE(moved.error().message.find("tile "), std::string::npos) << moved.error().message;
}

TEST(MoveTiles, ContradictoryPinsLeaveAGapThatIsReported) {
  const TileLayout layout = made_layout({});
  auto options = small_city_options();
  const auto one = move_tiles(layout, {{layout.tiles[36].id}}, {}, options);
  ASSERT_TRUE(one);
  const auto two =
      move_tiles(one->layout, {{layout.tiles[37].id}}, Affine::translation({1.0, 0.0}), options);
  ASSERT_TRUE(two) << two.error().message;
  EXPECT_GT(two->report.mean_property_gap_m, 0.0);
  EXPECT_GT(two->report.objective, 0.5);
  EXPECT_TRUE(std::isfinite(two->report.objective));
  EXPECT_EQ(defect_of(two->layout), "");
}

TEST(MoveTiles, UnknownTilesAndMapsThatAreNoMotionAreRefused) {
  const TileLayout layout = made_layout({});
  const std::vector<TileId> one{layout.tiles[3].id};
  const auto code = [&](std::span<const TileId> tiles, const Affine& motion) {
    const auto moved = move_tiles(layout, tiles, motion, small_city_options());
    return moved ? FailureCode{} : moved.error().code;
  };
  EXPECT_EQ(code({{TileId{9999}}}, {}), FailureCode::kUnknownEntity);
  EXPECT_EQ(code({}, {}), FailureCode::kUnknownEntity);
  EXPECT_EQ(code(one, {.xx = -1.0}), FailureCode::kOutOfRange);
  EXPECT_EQ(code(one, {.xx = 0.0}), FailureCode::kOutOfRange);
  EXPECT_EQ(code(one, Affine::translation({std::nan(""), 0})), FailureCode::kOutOfRange);
  EXPECT_EQ(code(one, Affine::translation({1e9, 0})), FailureCode::kOutOfRange);
}

TEST(Relax, TilesThatAreLetGoComeBack) {
  const TileLayout layout = with_pinned_corners(made_layout({}));
  auto options = small_city_options();
  options.reach_m.reset();
  const TileId id = layout.tiles[40].id;
  const auto moved = move_tiles(layout, {{id}}, Affine::translation({2, 2}), options);
  ASSERT_TRUE(moved) << moved.error().message;
  const auto free = unpin_tiles(moved->layout, {{id}});
  ASSERT_TRUE(free);
  EXPECT_FALSE(tile_of(*free, id).is_pinned);
  EXPECT_EQ(free->vertices, moved->layout.vertices);
  const auto back = relax(*free, options);
  ASSERT_TRUE(back);
  constexpr double kRounding_m = 0.01;
  for (std::size_t v = 0; v < layout.vertices.size(); ++v)
    EXPECT_LT(distance(back->layout.vertices[v].at, layout.vertices[v].at), kRounding_m);
  EXPECT_FALSE(unpin_tiles(layout, {{TileId{9999}}}));
}

TEST(Relax, SameInputSameBytes) {
  const TileLayout layout = with_pinned_corners(made_layout({}));
  const auto options = small_city_options();
  const auto moved = [&] {
    return move_tiles(layout, {{layout.tiles[40].id}}, Affine::rotation(0.02, {120, 100}), options);
  };
  const auto a = moved();
  const auto b = moved();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->layout, b->layout);
}

}  // namespace
}  // namespace plat::tiles
