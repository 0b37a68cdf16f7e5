#include "tiles/tile_layout.h"

#include <gtest/gtest.h>

namespace plat::tiles {
namespace {

using similarity::EdgeLabel;

/// Two squares side by side in one block.
TileLayout two_squares() {
  TileLayout layout;
  for (const Point p : {Point{0, 0}, {10, 0}, {20, 0}, {20, 10}, {10, 10}, {0, 10}})
    layout.vertices.push_back({p, true});
  const auto tile = [&](std::vector<std::uint32_t> ring) {
    Tile out;
    out.id = {layout.next_id++};
    std::vector<Corner> corners;
    for (const std::uint32_t v : ring) corners.push_back({v, layout.vertices[v].at});
    out.rings.push_back(corners);
    layout.tiles.push_back(out);
  };
  tile({0, 1, 4, 5});
  tile({1, 2, 3, 4});
  return layout;
}

TEST(TileLayout, ATileIsWhereItsVerticesAreNow) {
  TileLayout layout = two_squares();
  layout.vertices[1].at = {12, 1};
  EXPECT_EQ(shape_of(layout, layout.tiles[0]).outer, (Ring{{0, 0}, {12, 1}, {10, 10}, {0, 10}}));
  EXPECT_EQ(rest_shape_of(layout.tiles[0]).outer, (Ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
}

TEST(TileLayout, EdgesThatAnotherTileHasAreProperty) {
  const TileLayout layout = two_squares();
  EXPECT_EQ(labelled_shape_of(layout, 0).edges,
            (std::vector{EdgeLabel::kStreet, EdgeLabel::kProperty, EdgeLabel::kStreet,
                         EdgeLabel::kStreet}));
}

TEST(TileLayout, TilesAreFoundByTheirIds) {
  TileLayout layout = two_squares();
  layout.tiles.erase(layout.tiles.begin());
  EXPECT_EQ(find_tile(layout, {1}), 0U);
  EXPECT_EQ(find_tile(layout, {0}), std::nullopt);
}

}  // namespace
}  // namespace plat::tiles
