#include "parcels/recursive_subdivider.h"

#include <gtest/gtest.h>

#include "core/oriented_box.h"
#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using Options = RecursiveSubdivider::Options;

std::vector<Parcel> divide(const Options& options, const blocks::Block& block,
                           std::uint64_t seed = 1) {
  Rng rng(seed);
  return RecursiveSubdivider(options).subdivide(block, rng).value();
}

TEST(RecursiveSubdivider, TheFirstSplitRunsAlongTheBox) {
  const auto parcels =
      divide({.area_min_m2 = 3100.0, .jitter = 0.0, .stop_early = 0.0}, rectangle_block(160, 40));
  ASSERT_EQ(parcels.size(), 2U);
  for (const Parcel& parcel : parcels) EXPECT_EQ(box_of(parcel.shape).width(), 160.0);
}

TEST(RecursiveSubdivider, LaterSplitsRunAcrossTheLongEdges) {
  const auto parcels =
      divide({.area_min_m2 = 350.0, .jitter = 0.0, .stop_early = 0.0}, rectangle_block(160, 40));
  ASSERT_EQ(parcels.size(), 16U);
  for (const Parcel& parcel : parcels) EXPECT_EQ(area_m2(parcel.shape), 400.0);
}

TEST(RecursiveSubdivider, TheJitterKeepsSplitsWithinTheMiddle) {
  const Options options{.area_min_m2 = 2000.0, .jitter = 0.1, .stop_early = 0.0};
  double least = 1.0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto areas = testing::sorted_areas(divide(options, rectangle_block(160, 40), seed));
    ASSERT_EQ(areas.size(), 2U);
    least = std::min(least, areas[1] / 6400.0);
  }
  EXPECT_GE(least, 0.4);
  EXPECT_LT(least, 0.42) << "the whole range is used";
}

TEST(RecursiveSubdivider, SquareNeighboursWinOverALittleMoreLength) {
  // The bottom, 90 m, stands at right angles to its neighbours; the top, 100 m, does not. A split
  // along the box would leave the rear without access.
  const blocks::Block block = testing::with_streets_on(
      blocks::block_from_contour(BlockId{},
                                 {{{0, 0}, {90, 0}, {90, 20}, {105, 28}, {5, 28}, {0, 20}}, {}}),
      {0});
  const auto cut_x = [&](double squareness) {
    const auto parcels = divide(
        {.area_min_m2 = 1200.0, .jitter = 0.0, .stop_early = 0.0, .squareness = squareness}, block);
    EXPECT_EQ(parcels.size(), 2U);
    return std::min(box_of(parcels[0].shape).max.x, box_of(parcels[1].shape).max.x);
  };
  EXPECT_EQ(cut_x(0.0), 55.0);
  EXPECT_EQ(cut_x(5.0), 45.0);
}

TEST(RecursiveSubdivider, NoBoxIsBelowTheBoundsUnlessTheBlocksIs) {
  Rng rng = testing::property_rng("Recursive.Bounds");
  const Options options{.area_min_m2 = 250.0, .width_min_m = 9.0};
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const auto parcels = divide(options, block, rng());
    for (const Parcel& parcel : parcels) {
      if (parcels.size() == 1) continue;
      const OrientedBox box = minimum_area_box(parcel.shape);
      EXPECT_GE(box.width_m, 9.0 - 0.01);
      EXPECT_GE(box.area_m2(), 250.0 - 1.0);
      ++parcels_seen;
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(100) * 5);
}

TEST(RecursiveSubdivider, EveryParcelHasStreetAccess) {
  Rng rng = testing::property_rng("Recursive.Access");
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(150))) {
    blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    if (rng.index(2) == 0) block = testing::with_streets_on(std::move(block), {0, 2});
    for (const Parcel& parcel : divide({}, block, rng())) {
      ASSERT_GE(testing::frontage_by_distance_m(block, parcel.shape), kStreetAccess_m - 0.05);
      ++parcels_seen;
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(150) * 4);
}

TEST(RecursiveSubdivider, AboutHalfOfTheLotsWithinTheLargestSizeStopEarly) {
  // A block within the largest size: either it stops at once or it is split.
  int stopped = 0;
  constexpr int kSeeds = 400;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed)
    stopped += divide({.area_min_m2 = 300.0}, rectangle_block(40, 20), seed).size() == 1 ? 1 : 0;
  EXPECT_NEAR(stopped, kSeeds / 2, 60);
}

TEST(RecursiveSubdivider, LargerLotsNeverStopEarly) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (const Parcel& parcel : divide({.area_min_m2 = 1.0, .width_min_m = 1.0, .stop_early = 1.0},
                                       rectangle_block(160, 40), seed))
      EXPECT_LE(area_m2(parcel.shape), 800.0);
  }
}

TEST(RecursiveSubdivider, BlockObservedAsOneParcelStaysWhole) {
  Rng rng(1);
  const auto fitted = RecursiveSubdivider({}).fitted({1, 500.0, 0.0, 20.0, 0.0});
  EXPECT_EQ(fitted.subdivide(rectangle_block(300, 100), rng)->size(), 1U);
}

TEST(RecursiveSubdivider, FittedBoundsAreMeanAndDeviations) {
  const auto options = RecursiveSubdivider({}).fitted({12, 480.0, 100.0, 16.0, 4.0}).options();
  EXPECT_EQ(options.area_min_m2, 280.0);
  EXPECT_EQ(options.area_max_m2, 680.0);
  EXPECT_EQ(options.width_min_m, 8.0);
}

}  // namespace
}  // namespace plat::parcels
