#include "parcels/lot.h"

#include <gtest/gtest.h>

#include "core/working_grid.h"
#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

constexpr SplitLine vertical(double x) { return {{x, 0}, {0, 1}}; }
constexpr SplitLine horizontal(double y) { return {{0, y}, {1, 0}}; }

Lot lot_of(Polygon contour) {
  return parcels::lot_of(blocks::block_from_contour(BlockId{}, std::move(contour)));
}

double total_area_m2(const SplitResult& result) {
  double sum = 0.0;
  for (const Lot& lot : result.lots) sum += area_m2(lot);
  return sum;
}

const Polygon kSquare{{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {}};
/// Two teeth upwards: a line across them cuts the lot into three.
const Polygon kComb{{{0, 0}, {30, 0}, {30, 30}, {20, 30}, {20, 10}, {10, 10}, {10, 30}, {0, 30}},
                    {}};
const Polygon kCourtyard{{{0, 0}, {30, 0}, {30, 30}, {0, 30}},
                         {{{10, 10}, {10, 20}, {20, 20}, {20, 10}}}};

TEST(SplitLot, ConvexIntoTwoLeftOfTheLineFirst) {
  const SplitResult result = split(lot_of(kSquare), vertical(10));
  ASSERT_EQ(result.lots.size(), 2U);
  EXPECT_EQ(area_m2(result.lots[0]), 300.0) << "left of the upward line";
  EXPECT_EQ(area_m2(result.lots[1]), 600.0);
  ASSERT_EQ(result.cuts.size(), 1U);
  EXPECT_EQ(length(result.cuts[0]), 30.0);
}

TEST(SplitLot, MissingTheLotLeavesItWhole) {
  for (const double x : {-1.0, 31.0}) {
    const SplitResult result = split(lot_of(kSquare), vertical(x));
    EXPECT_EQ(result.lots.size(), 1U);
    EXPECT_TRUE(result.cuts.empty());
  }
}

TEST(SplitLot, AlongAnEdgeLeavesItWhole) {
  for (const SplitLine& line : {vertical(0), vertical(30), horizontal(0), horizontal(30)}) {
    const SplitResult result = split(lot_of(kSquare), line);
    EXPECT_EQ(result.lots.size(), 1U);
    EXPECT_TRUE(result.cuts.empty());
  }
}

TEST(SplitLot, ConcaveIntoThree) {
  const SplitResult result = split(lot_of(kComb), horizontal(20));
  ASSERT_EQ(result.lots.size(), 3U);
  EXPECT_EQ(result.cuts.size(), 2U);
  EXPECT_EQ(total_area_m2(result), 700.0);
  EXPECT_EQ(area_m2(result.lots[2]), 500.0) << "the comb's back is right of the line, so last";
}

TEST(SplitLot, ThroughVerticesCutsInEqualHalves) {
  const SplitResult result = split(lot_of(kSquare), {{0, 0}, normalized(Point{1, 1})});
  ASSERT_EQ(result.lots.size(), 2U);
  EXPECT_EQ(area_m2(result.lots[0]), 450.0);
  EXPECT_EQ(result.lots[0].rings[0].size(), 3U);
  EXPECT_EQ(result.lots[1].rings[0].size(), 3U);
}

TEST(SplitLot, AcrossAHoleOpensIt) {
  const SplitResult result = split(lot_of(kCourtyard), vertical(15));
  ASSERT_EQ(result.lots.size(), 2U);
  EXPECT_EQ(result.cuts.size(), 2U);
  for (const Lot& lot : result.lots) {
    EXPECT_EQ(lot.rings.size(), 1U);
    EXPECT_EQ(area_m2(lot), 400.0);
  }
}

TEST(SplitLot, BesideAHoleKeepsItOnItsSide) {
  const SplitResult result = split(lot_of(kCourtyard), vertical(5));
  ASSERT_EQ(result.lots.size(), 2U);
  EXPECT_EQ(result.lots[0].rings.size(), 1U);
  EXPECT_EQ(result.lots[1].rings.size(), 2U);
  EXPECT_EQ(area_m2(result.lots[1]), 750.0 - 100.0);
}

TEST(SplitLot, ThroughACornerOfAHoleKeepsItAsAHoleThatTouches) {
  const Polygon contour{{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{{10, 15}, {20, 20}, {20, 10}}}};
  const SplitResult result = split(lot_of(contour), vertical(10));
  ASSERT_EQ(result.lots.size(), 2U);
  EXPECT_EQ(area_m2(result.lots[0]), 300.0);
  EXPECT_EQ(area_m2(result.lots[1]), 600.0 - 50.0);
  EXPECT_EQ(result.lots[1].rings.size(), 2U);
}

TEST(SplitLot, LandThatOnlyMeetsInAPointIsNotOneLot) {
  const Polygon contour{{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{{10, 15}, {20, 20}, {20, 10}}}};
  for (const Point up : {Point{0, 1}, Point{0, -1}}) {  // the hole on either side of the line
    const SplitResult first = split(lot_of(contour), {{10, 0}, up});
    ASSERT_EQ(first.lots.size(), 2U);
    const Lot& around = first.lots[area_m2(first.lots[0]) == 550.0 ? 0 : 1];
    const SplitResult second = split(around, {{15, 0}, up});
    EXPECT_EQ(second.lots.size(), 3U) << "above the touching corner, below it, and the rest";
    EXPECT_EQ(total_area_m2(second), 550.0);
  }
}

TEST(SplitLot, LabelsFollowTheirEdges) {
  const Lot lot = parcels::lot_of(testing::with_streets_on(testing::rectangle_block(30, 20), {0}));
  EXPECT_EQ(frontage_m(lot), 30.0);
  const SplitResult result = split(lot, vertical(10));
  ASSERT_EQ(result.lots.size(), 2U);
  EXPECT_EQ(frontage_m(result.lots[0]), 10.0);
  EXPECT_EQ(frontage_m(result.lots[1]), 20.0);
  for (const Lot& part : result.lots) {
    int contour_vertices = 0;
    for (const LotVertex& v : part.rings[0]) contour_vertices += v.is_contour_vertex ? 1 : 0;
    EXPECT_EQ(contour_vertices, 2) << "the ends of the cut are none";
  }
}

TEST(SplitLot, CutItselfFrontsNoStreet) {
  const SplitResult result = split(lot_of(kSquare), vertical(10));
  double sum = 0.0;
  for (const Lot& lot : result.lots) sum += frontage_m(lot);
  EXPECT_EQ(sum, 120.0);
}

TEST(SplitLot, ThroughAReflexVertexOfARandomBlockCutsIt) {
  // Two crossings coincide there but for rounding, and must be taken in the right order.
  Rng rng = testing::property_rng("SplitLot.Vertex");
  int reflex = 0;
  for (const Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(300))) {
    const Ring& ring = polygon.outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point before = ring[(i + ring.size() - 1) % ring.size()];
      const Point after = ring[(i + 1) % ring.size()];
      if (orientation(before, ring[i], after) > 0.0) continue;
      // Both neighbours lie on the same side of the bisector's normal.
      const Point bisector = normalized(normalized(before - ring[i]) + normalized(after - ring[i]));
      const SplitResult result = split(lot_of(polygon), {ring[i], perpendicular(bisector)});
      ASSERT_GE(result.lots.size(), 2U);
      ASSERT_NEAR(total_area_m2(result), area_m2(polygon),
                  4.0 * kGridStep_m * perimeter_m(polygon));
      ++reflex;
    }
  }
  EXPECT_GT(reflex, testing::iterations(300));
}

TEST(SplitLot, AreasAndFrontageAddUpOnRandomBlocks) {
  Rng rng = testing::property_rng("SplitLot.Random");
  int cut = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(300))) {
    const Lot lot = lot_of(polygon);
    const double angle = rng.uniform(0, 3.14);
    const SplitResult result =
        split(lot, {interior_point(polygon), {std::cos(angle), std::sin(angle)}});
    const double slack = 4.0 * kGridStep_m * perimeter_m(polygon);
    ASSERT_NEAR(total_area_m2(result), area_m2(polygon), slack);
    double front = 0.0;
    for (const Lot& part : result.lots) front += frontage_m(part);
    ASSERT_NEAR(front, frontage_m(lot), 0.1);
    cut += result.lots.size() >= 2 ? 1 : 0;
  }
  EXPECT_EQ(cut, testing::iterations(300)) << "a line through the inside always cuts";
}

TEST(FrontWidth, IsTheBoxSideAlongTheLongestStreetEdge) {
  const blocks::Block block = testing::rectangle_block(30, 20);
  const auto width = [&](const std::vector<std::uint32_t>& streets) {
    const Lot lot = parcels::lot_of(testing::with_streets_on(block, streets));
    return front_width_m(lot, minimum_area_box(lot));
  };
  EXPECT_EQ(width({0}), 30.0);
  EXPECT_EQ(width({1}), 20.0);
  EXPECT_EQ(width({0, 1}), 30.0);
  EXPECT_EQ(width({}), 20.0) << "the shorter side where there is no street";
}

}  // namespace
}  // namespace plat::parcels
