#include "parcels/parish_mueller_subdivider.h"

#include <gtest/gtest.h>

#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using Interior = ParishMuellerSubdivider::Interior;
using Options = ParishMuellerSubdivider::Options;

std::vector<Parcel> divide(const Options& options, const blocks::Block& block,
                           std::uint64_t seed = 1) {
  Rng rng(seed);
  return ParishMuellerSubdivider(options).subdivide(block, rng).value();
}

TEST(ParishMuellerSubdivider, HalvesTheLongestParallelSides) {
  const auto parcels =
      divide({.area_max_m2 = 801.0, .irregularity = 0.0}, rectangle_block(160, 40));
  ASSERT_EQ(parcels.size(), 8U);
  for (const Parcel& parcel : parcels) EXPECT_EQ(area_m2(parcel.shape), 800.0);
}

TEST(ParishMuellerSubdivider, TheLongestPairIsDividedBeforeAShorterOne) {
  // One split: across the 100 m sides, not the 60 m ones.
  const auto parcels =
      divide({.area_max_m2 = 3001.0, .irregularity = 0.0}, rectangle_block(100, 60));
  ASSERT_EQ(parcels.size(), 2U);
  EXPECT_EQ(box_of(parcels[0].shape).height(), 60.0);
}

TEST(ParishMuellerSubdivider, ALongSideWithoutAParallelOneIsPassedOver) {
  // The 170 m slope has no counterpart; top and bottom are parallel.
  const blocks::Block block =
      blocks::block_from_contour(BlockId{}, {{{0, 0}, {240, 0}, {100, 96}, {0, 96}}, {}});
  const auto parcels = divide({.area_max_m2 = 0.9 * area_m2(block.contour),
                               .parallel_within_deg = 5.0,
                               .irregularity = 0.0},
                              block);
  ASSERT_EQ(parcels.size(), 2U);
  // In the middle of where top and bottom face each other.
  EXPECT_EQ(std::min(box_of(parcels[0].shape).width(), box_of(parcels[1].shape).width()), 50.0);
}

TEST(ParishMuellerSubdivider, ATriangleIsDividedAcrossItsLongestSide) {
  const blocks::Block block =
      blocks::block_from_contour(BlockId{}, {{{0, 0}, {100, 0}, {20, 50}}, {}});
  const auto parcels = divide({.area_max_m2 = 2000.0, .irregularity = 0.0}, block);
  ASSERT_EQ(parcels.size(), 2U);
  EXPECT_EQ(box_of(parcels[0].shape).width(), 50.0);
}

TEST(ParishMuellerSubdivider, NoParcelThatIsKeptExceedsTheThreshold) {
  Rng rng = testing::property_rng("ParishMueller.Threshold");
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    for (const Parcel& parcel : divide({.area_max_m2 = 600.0}, block, rng())) {
      EXPECT_LE(area_m2(parcel.shape), 601.0);
      ++parcels_seen;
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(100) * 8);
}

TEST(ParishMuellerSubdivider, InteriorLotsAreKeptOrJoined) {
  const blocks::Block block = rectangle_block(200, 200);
  int kept = 0;
  for (const Parcel& parcel : divide({}, block))
    kept += testing::frontage_by_distance_m(block, parcel.shape) < kStreetAccess_m ? 1 : 0;
  EXPECT_GT(kept, 10);
  for (const Parcel& parcel : divide({.interior = Interior::kJoin}, block))
    EXPECT_GE(testing::frontage_by_distance_m(block, parcel.shape), kStreetAccess_m);
}

TEST(ParishMuellerSubdivider, WithInteriorJoinedEveryParcelHasAccess) {
  Rng rng = testing::property_rng("ParishMueller.Access");
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    if (rng.index(2) == 0) block = testing::with_streets_on(std::move(block), {0, 2});
    for (const Parcel& parcel : divide({.interior = Interior::kJoin}, block, rng())) {
      ASSERT_GE(testing::frontage_by_distance_m(block, parcel.shape), kStreetAccess_m - 0.05);
      ++parcels_seen;
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(100) * 4);
}

TEST(ParishMuellerSubdivider, BlockObservedAsOneParcelStaysWhole) {
  Rng rng(1);
  const auto fitted = ParishMuellerSubdivider({}).fitted({1, 500.0, 0.0, 20.0, 0.0});
  EXPECT_EQ(fitted.subdivide(rectangle_block(300, 100), rng)->size(), 1U);
}

TEST(ParishMuellerSubdivider, FittedThresholdIsTheMeanAndDeviations) {
  EXPECT_EQ(ParishMuellerSubdivider({}).fitted({12, 480.0, 100.0, 16.0, 4.0}).options().area_max_m2,
            680.0);
}

}  // namespace
}  // namespace plat::parcels
