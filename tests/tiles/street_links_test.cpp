#include "tiles/street_links.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "tiles/layout_construction.h"

namespace plat::tiles {
namespace {

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

/// Rectangles, each a block.
TileLayout blocks_of(const std::vector<Polygon>& shapes, std::span<const StreetLine> streets = {},
                     const ConstructionOptions& options = {}) {
  std::vector<TilePiece> pieces;
  for (std::uint32_t b = 0; b < shapes.size(); ++b)
    pieces.push_back({std::to_string(b), "", b, shapes[b]});
  return construct_layout(pieces, streets, options).layout;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_of(const TileLayout& layout) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const StreetLink& link : layout.links) pairs.emplace(link.a, link.b);
  return pairs;
}

TEST(StreetLinks, FrontsThatFaceEachOtherAreLinkedHalfWay) {
  const TileLayout layout = blocks_of({rectangle(0, 0, 30, 30), rectangle(42, 0, 72, 30)});
  ASSERT_EQ(layout.links.size(), 2U);  // near both ends, each seen from both sides
  for (const StreetLink& link : layout.links) {
    EXPECT_EQ(link.rest_a.x, 36.0);
    EXPECT_EQ(link.rest_a, link.rest_b);
    EXPECT_EQ(link.width_m, 12.0);
  }
}

TEST(StreetLinks, LieOnTheCentreLineWhereThereIsOne) {
  const StreetLine line{{{40, -50}, {40, 80}}, 10.0};
  const TileLayout layout =
      blocks_of({rectangle(0, 0, 30, 30), rectangle(42, 0, 72, 30)}, std::vector{line});
  ASSERT_EQ(layout.links.size(), 2U);
  for (const StreetLink& link : layout.links) EXPECT_EQ(link.rest_a.x, 40.0);
}

TEST(StreetLinks, DoNotPassThroughTiles) {
  const TileLayout layout =
      blocks_of({rectangle(0, 0, 30, 30), rectangle(40, -5, 45, 35), rectangle(55, 0, 85, 30)});
  EXPECT_EQ(pairs_of(layout), (std::set<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}, {1, 2}}));
}

TEST(StreetLinks, AreNoLongerThanTheirReach) {
  EXPECT_TRUE(blocks_of({rectangle(0, 0, 30, 30), rectangle(91, 0, 120, 30)}).links.empty());
  ConstructionOptions options;
  options.links.reach_m = 62.0;
  EXPECT_EQ(
      blocks_of({rectangle(0, 0, 30, 30), rectangle(91, 0, 120, 30)}, {}, options).links.size(),
      2U);
}

TEST(StreetLinks, LongFrontsHaveMore) {
  const TileLayout layout = blocks_of({rectangle(0, 0, 200, 30), rectangle(0, 42, 200, 70)});
  EXPECT_EQ(layout.links.size(), 6U);
}

TEST(StreetLinks, NeighboursThatTouchHaveNone) {
  const TileLayout layout =
      construct_layout(
          std::vector<TilePiece>{
              {"a", "", 0, {{{0, 0}, {30, 0}, {30, 10}, {12, 10}, {12, 20}, {0, 20}}, {}}},
              {"b", "", 0, {{{30, 10}, {30, 40}, {16, 40}, {16, 10}}, {}}}})
          .layout;
  EXPECT_TRUE(layout.links.empty());  // b stands 4 m from a's upright, and on its foot
}

TEST(StreetLinks, JoinAGridOfBlocksWithTwoLinksForEachStreetSide) {
  std::vector<Polygon> shapes;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      shapes.push_back(rectangle(60.0 * c, 50.0 * r, 60.0 * c + 48.0, 50.0 * r + 38.0));
  }
  const TileLayout layout = blocks_of(shapes);
  EXPECT_EQ(pairs_of(layout).size(), 12U);
  for (const auto& [a, b] : pairs_of(layout)) {
    std::size_t count = 0;
    for (const StreetLink& link : layout.links) count += link.a == a && link.b == b ? 1 : 0;
    EXPECT_GE(count, 2U);
  }
}

}  // namespace
}  // namespace plat::tiles
