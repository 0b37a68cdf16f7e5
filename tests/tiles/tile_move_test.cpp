#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/made_tile_layout.h"
#include "tiles/layout_defects.h"
#include "tiles/reconfiguration.h"

namespace plat::tiles {
namespace {

using plat::testing::made_layout;
using plat::testing::MadeLayout;

TEST(MoveTiles, AMovedTileIsPinnedWhereItWasMovedTo) {
  const TileLayout layout = made_layout({});
  const TileId id = layout.tiles[40].id;
  const Affine motion = Affine::translation({1.5, 2.0});
  const auto moved = move_tiles(layout, {{id}}, motion, {});
  ASSERT_TRUE(moved) << moved.error().message;
  const Tile& tile = moved->layout.tiles[*find_tile(moved->layout, id)];
  EXPECT_EQ(tile.placement, motion * layout.tiles[40].placement);
  EXPECT_TRUE(tile.is_pinned);
  EXPECT_GT(moved->report.moved.size(), 1U);
  EXPECT_TRUE(std::ranges::count(moved->report.moved, id));
  EXPECT_EQ(find_layout_defect(moved->layout), std::nullopt);
}

TEST(MoveTiles, TheIdentityMovesNothing) {
  const TileLayout layout = made_layout({});
  const auto moved = move_tiles(layout, {{layout.tiles[3].id}}, {}, {});
  ASSERT_TRUE(moved);
  EXPECT_TRUE(moved->report.moved.empty());
  EXPECT_EQ(moved->layout.vertices, layout.vertices);
  EXPECT_TRUE(moved->layout.tiles[3].is_pinned);
}

}  // namespace
}  // namespace plat::tiles
