#include "tiles/settling.h"

#include <gtest/gtest.h>

#include "core/working_grid.h"
#include "tiles/layout_construction.h"
#include "tiles/layout_defects.h"

namespace plat::tiles {
namespace {

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

TileLayout two_squares() {
  return construct_layout(std::vector<TilePiece>{{"a", "", 0, rectangle(0, 0, 10, 10)},
                                                 {"b", "", 0, rectangle(10, 0, 20, 10)}})
      .layout;
}

TEST(Settling, AJointGoesToTheMeanOfItsTilesAndTheirOtherVerticesGoAlong) {
  TileLayout layout = two_squares();
  layout.tiles[1].placement = Affine::translation({2, 1});
  layout = settled(std::move(layout));
  EXPECT_EQ(shape_of(layout, layout.tiles[0]).outer,
            (Ring{{1, 0.5}, {11, 0.5}, {11, 10.5}, {1, 10.5}}));
  EXPECT_EQ(shape_of(layout, layout.tiles[1]).outer,
            (Ring{{11, 0.5}, {21, 0.5}, {21, 10.5}, {11, 10.5}}));
}

TEST(Settling, ATileIsBentEvenlyBetweenItsJoints) {
  Polygon middle = rectangle(10, 0, 20, 10);
  middle.outer.insert(middle.outer.begin() + 1, {15, -1});
  TileLayout layout =
      construct_layout(std::vector<TilePiece>{{"a", "", 0, rectangle(0, 0, 10, 10)},
                                              {"b", "", 0, middle},
                                              {"c", "", 0, rectangle(20, 0, 30, 10)}})
          .layout;
  layout.tiles[2].placement = Affine::translation({2, 0});
  layout = settled(std::move(layout));
  EXPECT_EQ(shape_of(layout, layout.tiles[1]).outer,
            (Ring{{10, 0}, {15.5, -1}, {21, 0}, {21, 10}, {10, 10}}));
}

TEST(Settling, VerticesLieOnTheWorkingGrid) {
  TileLayout layout = two_squares();
  layout.tiles[0].placement = Affine::rotation(0.3);
  layout = settled(std::move(layout));
  for (const LayoutVertex& vertex : layout.vertices) EXPECT_TRUE(is_on_grid(vertex.at));
}

TEST(Settling, TwiceIsOnce) {
  TileLayout layout = two_squares();
  layout.tiles[0].placement = Affine::rotation(0.1);
  layout = settled(std::move(layout));
  EXPECT_EQ(settled(layout), layout);
}

TEST(Settling, TheResidualIsHowFarVerticesAreFromThePlacement) {
  TileLayout layout = two_squares();
  layout.tiles[1].placement = Affine::translation({4, 0});
  layout = settled(std::move(layout));
  EXPECT_NEAR(closing_residuals_m(layout)[0], 2.0, 1e-12);
  EXPECT_NEAR(closing_residuals_m(layout)[1], 2.0, 1e-12);
}

TEST(Settling, TilesThatMoveTogetherAreNotBent) {
  TileLayout layout = two_squares();
  for (Tile& tile : layout.tiles) tile.placement = Affine::translation({3, 4});
  layout = settled(std::move(layout));
  EXPECT_EQ(closing_residuals_m(layout), (std::vector<double>{0.0, 0.0}));
}

}  // namespace
}  // namespace plat::tiles
