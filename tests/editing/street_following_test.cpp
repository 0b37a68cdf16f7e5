#include "editing/street_following.h"

#include <gtest/gtest.h>

#include "editing/city_support.h"
#include "editing/tiled_city.h"

namespace plat::editing {
namespace {

using testing::carried;
using testing::grid_tiles;
using testing::tiled_grid_city;
using tiles::TileLayout;

/// Rounding of a map and its inverse at 1 km.
constexpr double kRounding_m = 1e-9;

/// The tiles of the blocks in some columns, carried by a map.
TileLayout with_blocks_carried(TileLayout layout, std::uint32_t first_tile, std::uint32_t count,
                               const Affine& map) {
  for (std::uint32_t i = first_tile; i < first_tile + count; ++i)
    layout.tiles[i].placement = map * layout.tiles[i].placement;
  return layout;
}

std::vector<Point> places() {
  std::vector<Point> out;
  for (double x = -20.0; x <= 320.0; x += 7.0) {
    for (double y = -20.0; y <= 260.0; y += 7.0) out.push_back({x, y});
  }
  return out;
}

TEST(StreetFollowing, ARigidMotionOfAllTilesIsThatOfTheStreets) {
  const TileLayout before = grid_tiles(4, 4);
  const Affine motion = Affine::translation({12.0, -7.0}) * Affine::rotation(0.4, {150.0, 120.0});
  const StreetFollowing following(before, carried(before, motion));
  for (const Point p : places())
    EXPECT_LT(distance(following(p), motion(p)), kRounding_m) << p.x << ' ' << p.y;
}

TEST(StreetFollowing, WhereNoTileMovesNoPointMoves) {
  const TileLayout before = grid_tiles(4, 4);
  const TileLayout turned = carried(before, Affine::rotation(0.7, {31.0, 17.0}));
  const StreetFollowing still(turned, turned);
  const StreetFollowing first(before,
                              with_blocks_carried(before, 0, 4, Affine::translation({3, 1})));
  for (const Point p : places()) {
    EXPECT_EQ(still(p), p);
    EXPECT_FALSE(still.reaches(p));
    // The first block ends at (94, 74).
    const Point beyond{std::max(p.x - 94.0, 0.0), std::max(p.y - 74.0, 0.0)};
    if (length(beyond) > kFollowReach_m) {
      EXPECT_EQ(first(p), p) << p.x << ' ' << p.y;
    }
  }
}

TEST(StreetFollowing, FadesBeyondTheLastTile) {
  const TileLayout before = grid_tiles(2, 2);
  const StreetFollowing following(before, carried(before, Affine::translation({10.0, 0.0})));
  const auto shift = [&](double x) { return following({x, 40.0}).x - x; };
  EXPECT_NEAR(shift(94.0 + 0.4 * kFollowReach_m), 10.0, kRounding_m);
  EXPECT_NEAR(shift(94.0 + 0.75 * kFollowReach_m), 5.0, kRounding_m);
  EXPECT_EQ(shift(94.0 + 1.01 * kFollowReach_m), 0.0);
}

TEST(StreetFollowing, IsTurnedWithTheTiles) {
  const TileLayout before = grid_tiles(4, 4);
  const Affine motion = Affine::rotation(0.1, {50.0, 40.0});
  const TileLayout after = with_blocks_carried(before, 4, 8, motion);
  const Affine turn = Affine::rotation(std::numbers::pi / 2.0, {0.0, 0.0});
  const StreetFollowing following(before, after);
  const StreetFollowing turned(carried(before, turn), carried(after, turn));
  for (const Point p : places())
    EXPECT_LT(distance(turned(turn(p)), turn(following(p))), 1e-6) << p.x << ' ' << p.y;
}

TEST(StreetFollowing, IsContinuous) {
  const TileLayout before = grid_tiles(4, 4);
  const TileLayout after = with_blocks_carried(before, 4, 4, Affine::translation({4.0, 2.0}));
  const StreetFollowing following(before, after);
  constexpr double kStep_m = 0.01;
  for (double x = -90.0; x < 400.0; x += kStep_m) {
    const Point a{x, 37.0};
    const Point b{x + kStep_m, 37.0};
    // Across a street of 12 m the shift changes from all to nothing.
    EXPECT_LT(distance(following(b) - b, following(a) - a), 2.0 * kStep_m) << x;
  }
}

TEST(StreetFollowing, TilesThatAreGoneTakeNothingAlong) {
  const TileLayout before = grid_tiles(3, 3);
  TileLayout after = carried(before, Affine::translation({5.0, 0.0}));
  after.links.clear();
  after.tiles.erase(after.tiles.begin(), after.tiles.begin() + 4);  // the south-western block
  const StreetFollowing following(before, after);
  EXPECT_EQ(following({0.0, 0.0}), Point(0.0, 0.0));
  // Between a tile that is gone and one that moved.
  EXPECT_NEAR(following({100.0, 40.0}).x, 105.0, kRounding_m);
}

TEST(WidthChanges, AreHowFarTheFrontsPart) {
  const City city = tiled_grid_city(3, 3);
  const TileLayout& before = *city.tiles();
  // The eastern blocks go 3 m east: the street between becomes wider, no other one does.
  TileLayout after = with_blocks_carried(before, 4, 4, Affine::translation({3.0, 0.0}));
  after = with_blocks_carried(after, 12, 4, Affine::translation({3.0, 0.0}));
  const auto changes = width_changes(city, before, StreetFollowing(before, after));
  ASSERT_EQ(changes.size(), 2U);
  for (const Point at : {Point{100.0, 40.0}, Point{100.0, 120.0}}) {
    const auto it = changes.find(testing::street_near(city, at));
    ASSERT_NE(it, changes.end());
    EXPECT_NEAR(it->second, 3.0, kRounding_m);
  }
}

TEST(WidthChanges, AreNoneWhereEverythingIsTurned) {
  const City city = tiled_grid_city(3, 3);
  const TileLayout after = carried(*city.tiles(), Affine::rotation(1.0, {30.0, 200.0}));
  EXPECT_TRUE(width_changes(city, *city.tiles(), StreetFollowing(*city.tiles(), after)).empty());
}

TEST(WidthChanges, AreAcrossTheStreetAsItIsTurned) {
  const City city = tiled_grid_city(3, 3);
  const Affine turn = Affine::rotation(1.0, {30.0, 200.0});
  TileLayout after = with_blocks_carried(*city.tiles(), 4, 4, Affine::translation({3.0, 0.0}));
  after = carried(with_blocks_carried(after, 12, 4, Affine::translation({3.0, 0.0})), turn);
  const auto changes = width_changes(city, *city.tiles(), StreetFollowing(*city.tiles(), after));
  ASSERT_EQ(changes.size(), 2U);
  for (const auto& [street, change_m] : changes) EXPECT_NEAR(change_m, 3.0, kRounding_m);
}

}  // namespace
}  // namespace plat::editing
