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

TEST(Settling, AVertexGoesToTheMeanOfItsTiles) {
  TileLayout layout = two_squares();
  layout.tiles[1].placement = Affine::translation({2, 1});
  layout = settled(std::move(layout));
  EXPECT_EQ(shape_of(layout, layout.tiles[0]).outer,
            (Ring{{0, 0}, {11, 0.5}, {11, 10.5}, {0, 10}}));
  EXPECT_EQ(shape_of(layout, layout.tiles[1]).outer,
            (Ring{{11, 0.5}, {22, 1}, {22, 11}, {11, 10.5}}));
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
  layout.tiles[1].placement = Affine::translation({2, 0});
  layout = settled(std::move(layout));
  // Two of four vertices are 1 m off.
  EXPECT_NEAR(closing_residuals_m(layout)[0], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(closing_residuals_m(layout)[1], std::sqrt(0.5), 1e-12);
}

TEST(Settling, TilesThatMoveTogetherAreNotBent) {
  TileLayout layout = two_squares();
  for (Tile& tile : layout.tiles) tile.placement = Affine::translation({3, 4});
  layout = settled(std::move(layout));
  EXPECT_EQ(closing_residuals_m(layout), (std::vector<double>{0.0, 0.0}));
}

}  // namespace
}  // namespace plat::tiles
