#include "parcels/min_box_subdivider.h"

#include <gtest/gtest.h>

#include "core/oriented_box.h"
#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using Options = MinBoxSubdivider::Options;

std::vector<Parcel> divide(const Options& options, const blocks::Block& block,
                           std::uint64_t seed = 1) {
  Rng rng(seed);
  return MinBoxSubdivider(options).subdivide(block, rng).value();
}

TEST(MinBoxSubdivider, CoversARectangleByEqualLots) {
  const auto parcels = divide({.lot_width_m = 16.0, .lot_depth_m = 30.0, .width_deviation = 0.0},
                              rectangle_block(160, 60));
  ASSERT_EQ(parcels.size(), 20U);
  for (const Parcel& parcel : parcels) EXPECT_NEAR(area_m2(parcel.shape), 480.0, 0.1);
}

TEST(MinBoxSubdivider, ABoxTakesAWholeNumberOfRowsAndLots) {
  // 2.4 rows and 9.7 lots of the wanted size: 2 and 10.
  const auto parcels = divide({.lot_width_m = 16.5, .lot_depth_m = 25.0, .width_deviation = 0.0},
                              rectangle_block(160, 60));
  EXPECT_EQ(parcels.size(), 20U);
}

TEST(MinBoxSubdivider, InnerLotsHaveNoStreetAccess) {
  const blocks::Block block = rectangle_block(120, 90);
  int without = 0;
  for (const Parcel& parcel : divide({.width_deviation = 0.0}, block))
    without += testing::frontage_by_distance_m(block, parcel.shape) < kStreetAccess_m ? 1 : 0;
  EXPECT_EQ(without, 6) << "three rows of eight: the middle one but for its ends";
}

TEST(MinBoxSubdivider, EveryCutRunsAlongOrAcrossTheBox) {
  // Parcels inside the contour have no other edges than cuts.
  const blocks::Block block = blocks::block_from_contour(
      BlockId{}, {{{0, 0}, {150, 20}, {170, 120}, {60, 140}, {-10, 80}}, {}});
  const Point axis = minimum_area_box(block.contour).axis;
  int seen = 0;
  for (const Parcel& parcel : divide({.width_deviation = 0.2}, block)) {
    if (testing::frontage_by_distance_m(block, parcel.shape) > 0.0) continue;
    for_each_edge(parcel.shape, [&](const Segment& s) {
      const Point along = normalized(s.b - s.a);
      EXPECT_LT(std::min(std::abs(cross(along, axis)), std::abs(dot(along, axis))), 0.002);
      ++seen;
    });
  }
  EXPECT_GT(seen, 20);
}

TEST(MinBoxSubdivider, NoParcelIsSmallerThanTheBoundUnlessTheBlockIs) {
  Rng rng = testing::property_rng("MinBox.Small");
  const Options options{.area_min_m2 = 200.0};
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const auto parcels = divide(options, block, rng());
    if (parcels.size() == 1) continue;
    for (const Parcel& parcel : parcels) {
      EXPECT_GT(area_m2(parcel.shape), 199.9);
      ++parcels_seen;
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(100) * 5);
}

TEST(MinBoxSubdivider, BlockObservedAsOneParcelStaysWhole) {
  Rng rng(1);
  const auto fitted = MinBoxSubdivider({}).fitted({1, 500.0, 0.0, 20.0, 0.0});
  EXPECT_EQ(fitted.subdivide(rectangle_block(300, 100), rng)->size(), 1U);
}

TEST(MinBoxSubdivider, FittedLotsHaveTheMeanWidthAndArea) {
  const auto options = MinBoxSubdivider({}).fitted({12, 480.0, 100.0, 16.0, 4.0}).options();
  EXPECT_EQ(options.lot_width_m, 16.0);
  EXPECT_EQ(options.lot_depth_m, 30.0);
  EXPECT_EQ(options.width_deviation, 0.25);
  EXPECT_EQ(options.area_min_m2, 280.0);
}

}  // namespace
}  // namespace plat::parcels
