#include "tiles/tile_reach.h"

#include <gtest/gtest.h>

#include <vector>

namespace plat::tiles {
namespace {

/// A square of 2 m at rest, of which the layout has moved one corner.
TileLayout bent_square() {
  TileLayout out;
  out.vertices = {{{0, 0}}, {{2, 0}}, {{5, 3}}, {{0, 2}}};
  Tile tile;
  tile.rings = {{{0, {0, 0}}, {1, {2, 0}}, {2, {2, 2}}, {3, {0, 2}}}};
  out.tiles = {tile};
  return out;
}

TEST(TileReach, ABoxIsOfVerticesNowOrOfCornersAtAPlacement) {
  const TileLayout layout = bent_square();
  const Box now = box_of(layout, layout.tiles[0]);
  EXPECT_EQ(now.min, (Point{0, 0}));
  EXPECT_EQ(now.max, (Point{5, 3}));
  const Box there = box_at(layout.tiles[0], Affine::translation({10, 20}));
  EXPECT_EQ(there.min, (Point{10, 20}));
  EXPECT_EQ(there.max, (Point{12, 22}));
}

TEST(TileReach, BoxesAreAsFarAsTheirNearestPoints) {
  const Box box{{0, 0}, {2, 2}};
  EXPECT_EQ(distance_m(box, {{5, 6}, {7, 8}}), 5.0);
  EXPECT_EQ(distance_m({{5, 6}, {7, 8}}, box), 5.0);
  EXPECT_EQ(distance_m(box, {{4, 1}, {7, 8}}), 2.0);
  EXPECT_EQ(distance_m(box, {{1, 1}, {7, 8}}), 0.0);
}

TEST(TileReach, ABoxIsReachedFromTheNearestOfTheOthersAndAtTheReachItself) {
  const Box box{{0, 0}, {2, 2}};
  const std::vector<Box> around{{{90, 90}, {91, 91}}, {{5, 6}, {7, 8}}};
  EXPECT_TRUE(is_within_reach(box, around, 5.0));
  EXPECT_FALSE(is_within_reach(box, around, 4.99));
  EXPECT_FALSE(is_within_reach(box, {}, 1e9));
}

}  // namespace
}  // namespace plat::tiles
