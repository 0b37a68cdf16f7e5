#include "parcels/obb_subdivider.h"

#include <gtest/gtest.h>

#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using Options = ObbSubdivider::Options;

std::vector<Parcel> divide(const Options& options, const blocks::Block& block,
                           std::uint64_t seed = 1) {
  Rng rng(seed);
  return ObbSubdivider(options).subdivide(block, rng).value();
}

TEST(ObbSubdivider, RegularSplitsHalveARectangleExactly) {
  const auto parcels =
      divide({.area_max_m2 = 801.0, .irregularity = 0.0, .snap_m = 0.0}, rectangle_block(160, 40));
  ASSERT_EQ(parcels.size(), 8U);
  for (const Parcel& parcel : parcels) EXPECT_EQ(area_m2(parcel.shape), 800.0);
}

TEST(ObbSubdivider, StopsBelowTheAreaBound) {
  Options options{.area_max_m2 = 1e6};
  EXPECT_EQ(divide(options, rectangle_block(160, 40)).size(), 1U);
  options.area_max_m2 = 3000.0;
  EXPECT_GT(divide(options, rectangle_block(160, 40)).size(), 1U);
}

TEST(ObbSubdivider, StopsBelowTheWidthBound) {
  const blocks::Block block = testing::with_streets_on(rectangle_block(160, 40), {1});
  EXPECT_EQ(divide({.width_max_m = 41.0}, block).size(), 1U) << "the front is the 40 m side";
  EXPECT_GT(divide({.width_max_m = 39.0}, block).size(), 1U);
}

TEST(ObbSubdivider, WithoutAccessToKeepEveryParcelIsBelowOneOfTheBounds) {
  Rng rng = testing::property_rng("Obb.Bounds");
  const Options options{.street_access = 0.0};
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    for (const Parcel& parcel : divide(options, block)) {
      const OrientedBox box = minimum_area_box(parcel.shape);
      EXPECT_TRUE(area_m2(parcel.shape) < options.area_max_m2 + 0.5 ||
                  box.width_m < options.width_max_m + 0.01)
          << area_m2(parcel.shape) << " m2, " << box.width_m << " m";
      ++parcels_seen;
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(100) * 5);
}

TEST(ObbSubdivider, WithStreetAccessOneEveryParcelHasAccess) {
  Rng rng = testing::property_rng("Obb.Access");
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(150))) {
    blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    // Half of the blocks lack streets on some sides.
    if (rng.index(2) == 0) block = testing::with_streets_on(std::move(block), {0, 2});
    for (const Parcel& parcel : divide({}, block, rng())) {
      ASSERT_GE(testing::frontage_by_distance_m(block, parcel.shape), kStreetAccess_m - 0.05);
      ++parcels_seen;
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(150) * 4);
}

TEST(ObbSubdivider, WithStreetAccessZeroSomeParcelsHaveNone) {
  const blocks::Block block = rectangle_block(200, 200);
  int without = 0;
  for (const Parcel& parcel : divide({.street_access = 0.0}, block))
    without += testing::frontage_by_distance_m(block, parcel.shape) < kStreetAccess_m ? 1 : 0;
  EXPECT_GT(without, 10);
}

TEST(ObbSubdivider, EditAtOneEndLeavesTheParcelsOfTheOtherEnd) {
  const auto parcels_between = [](const blocks::Block& block, double from, double to) {
    std::vector<Ring> out;
    for (const Parcel& parcel : divide({.snap_m = 0.0}, block)) {
      const Box box = box_of(parcel.shape);
      if (box.min.x >= from && box.max.x <= to) out.push_back(parcel.shape.outer);
    }
    return out;
  };
  // A 400 x 40 m block, and the same with a notch near one end or the other: the box stays.
  const blocks::Block whole = rectangle_block(400, 40);
  const blocks::Block right_end = blocks::block_from_contour(
      BlockId{}, {{{0, 0}, {400, 0}, {400, 40}, {395, 40}, {390, 15}, {385, 40}, {0, 40}}, {}});
  const blocks::Block left_end = blocks::block_from_contour(
      BlockId{}, {{{0, 0}, {400, 0}, {400, 40}, {15, 40}, {10, 15}, {5, 40}, {0, 40}}, {}});
  const auto left = parcels_between(whole, 0.0, 150.0);
  const auto right = parcels_between(whole, 250.0, 400.0);
  EXPECT_GT(left.size(), 4U);
  EXPECT_GT(right.size(), 4U);
  EXPECT_EQ(left, parcels_between(right_end, 0.0, 150.0));
  EXPECT_EQ(right, parcels_between(left_end, 250.0, 400.0));
  EXPECT_NE(left, parcels_between(left_end, 0.0, 150.0)) << "the edit must change something";
}

TEST(ObbSubdivider, SplitGoesThroughANearVertex) {
  // A vertex of the contour 0.7 m off the middle of the long side.
  const blocks::Block block = blocks::block_from_contour(
      BlockId{}, {{{0, 0}, {50.7, 0.5}, {100, 0}, {100, 30}, {0, 30}}, {}});
  const auto xs_of_first_cut = [&](double snap_m) {
    const auto parcels =
        divide({.area_max_m2 = 2000.0, .irregularity = 0.0, .snap_m = snap_m}, block);
    EXPECT_EQ(parcels.size(), 2U);
    return box_of(parcels[0].shape).max.x;
  };
  EXPECT_NEAR(xs_of_first_cut(1.0), 50.7, 0.001);
  EXPECT_NEAR(xs_of_first_cut(0.5), 50.0, 0.001);
}

TEST(ObbSubdivider, ShiftedSplitThatWouldBeTooSmallIsMadeInTheMiddle) {
  const blocks::Block block = rectangle_block(40, 40);
  Options options{.area_min_m2 = 799.0, .area_max_m2 = 1000.0, .irregularity = 1.0, .snap_m = 0.0};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const double area : testing::sorted_areas(divide(options, block, seed)))
      ASSERT_GE(area, 799.0);
  }
}

TEST(ObbSubdivider, BlockObservedAsOneParcelStaysWhole) {
  const ParcelStyle one{1, 500.0, 0.0, 20.0, 0.0};
  const ObbSubdivider fitted = ObbSubdivider({}).fitted(one);
  Rng rng(1);
  EXPECT_EQ(fitted.subdivide(rectangle_block(300, 100), rng)->size(), 1U);
}

TEST(ObbSubdivider, TwinsHaveEquallyManyParcelsOfEqualAreas) {
  const Polygon shapes[] = {rectangle_block(170, 45).contour,
                            {{{0, 0}, {120, 0}, {120, 40}, {50, 40}, {50, 90}, {0, 90}}, {}},
                            {{{0, 0}, {120, 0}, {140, 60}, {-10, 50}}, {}}};
  // No randomness: mirrored shifts would go the other way. Snapping is off as it may meet ties.
  const Options options{.irregularity = 0.0, .snap_m = 0.0};
  for (const Polygon& shape : shapes) {
    const auto areas =
        testing::sorted_areas(divide(options, blocks::block_from_contour({}, shape)));
    EXPECT_GT(areas.size(), 4U);
    for (const auto twin : {testing::Twin::kTranslated, testing::Twin::kTurnedBy90,
                            testing::Twin::kMirrored, testing::Twin::kRotatedStart}) {
      const auto twins = testing::sorted_areas(
          divide(options, blocks::block_from_contour({}, testing::twin_of(shape, twin))));
      ASSERT_EQ(twins.size(), areas.size()) << "twin " << static_cast<int>(twin);
      for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(twins[i], areas[i], 0.5);
    }
  }
}

}  // namespace
}  // namespace plat::parcels
