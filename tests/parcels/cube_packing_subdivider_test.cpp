#include "parcels/cube_packing_subdivider.h"

#include <gtest/gtest.h>

#include "parcels/lot_packing.h"
#include "parcels/made_blocks.h"
#include "parcels/parcel_measures.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using Options = CubePackingSubdivider::Options;

std::vector<Parcel> divide(const Options& options, const blocks::Block& block,
                           std::uint64_t seed = 1) {
  Rng rng(seed);
  return CubePackingSubdivider(options).subdivide(block, rng).value();
}

double least_rectangularity(const blocks::Block& block, const std::vector<Parcel>& parcels) {
  std::vector<Polygon> shapes;
  for (const Parcel& parcel : parcels) shapes.push_back(parcel.shape);
  double least = 1.0;
  for (const ParcelMeasures& m : measure_parcels(block, shapes))
    least = std::min(least, m.rectangularity);
  return least;
}

TEST(CubePackingSubdivider, TwoRowsOfLotsFillARectangle) {
  const auto parcels = divide({.lot_width_m = 16.0, .lot_depth_m = 30.0, .width_deviation = 0.0},
                              rectangle_block(160, 60));
  ASSERT_EQ(parcels.size(), 20U);
  for (const Parcel& parcel : parcels) EXPECT_NEAR(area_m2(parcel.shape), 480.0, 0.5);
}

TEST(CubePackingSubdivider, ALotIsMadeShallowerWhereItDoesNotFit) {
  // 50 m deep: 30 m from one street, 20 m from the other.
  const blocks::Block block = testing::with_streets_on(rectangle_block(160, 50), {0, 2});
  const auto areas = testing::sorted_areas(
      divide({.lot_width_m = 16.0, .lot_depth_m = 30.0, .width_deviation = 0.0}, block));
  ASSERT_EQ(areas.size(), 20U);
  EXPECT_NEAR(areas.front(), 480.0, 0.5);
  EXPECT_NEAR(areas.back(), 320.0, 0.5);
}

TEST(CubePackingSubdivider, LandBehindTheLotsIsJoinedToThem) {
  // 10 m behind each lot of the one row.
  const blocks::Block block = testing::with_streets_on(rectangle_block(160, 40), {0});
  const auto parcels =
      divide({.lot_width_m = 16.0, .lot_depth_m = 30.0, .width_deviation = 0.0}, block);
  ASSERT_EQ(parcels.size(), 10U);
  for (const Parcel& parcel : parcels) EXPECT_NEAR(area_m2(parcel.shape), 640.0, 0.5);
}

TEST(CubePackingSubdivider, LandLeftOverJoinsTheLotOfTheLongestBoundary) {
  // 10 m of front are left over on either side: beside a lot 30 m deep and behind one 12 m deep,
  // and the other way round. Both pieces go to the lots beside which they are longest.
  const blocks::Block block = testing::with_streets_on(rectangle_block(100, 42), {0, 2});
  const auto parcels = divide(
      {.lot_width_m = 30.0, .lot_depth_m = 30.0, .width_deviation = 0.0, .depth_min_share = 0.4},
      block);
  ASSERT_EQ(parcels.size(), 6U);
  EXPECT_NEAR(testing::sorted_areas(parcels).front(), 40.0 * 30.0, 10.0);
}

TEST(CubePackingSubdivider, ConcaveAreasMakeBadlyFormedParcels) {
  const Options options{.lot_width_m = 15.0, .lot_depth_m = 30.0, .width_deviation = 0.0};
  const blocks::Block straight = rectangle_block(150, 60);
  const blocks::Block concave = blocks::block_from_contour(
      BlockId{}, {{{0, 0}, {150, 0}, {150, 60}, {90, 60}, {55, 95}, {55, 160}, {0, 160}}, {}});
  EXPECT_GT(least_rectangularity(straight, divide(options, straight)), 0.95);
  EXPECT_LT(least_rectangularity(concave, divide(options, concave)), 0.8);
}

TEST(CubePackingSubdivider, ABlockInWhichNoLotFitsIsOneParcel) {
  EXPECT_EQ(divide({.lot_width_m = 100.0}, rectangle_block(60, 40)).size(), 1U);
  Rng rng(1);
  const auto fitted = CubePackingSubdivider({}).fitted({1, 500.0, 0.0, 20.0, 0.0});
  EXPECT_EQ(fitted.subdivide(rectangle_block(300, 100), rng)->size(), 1U);
}

TEST(CubePackingSubdivider, OneParcelAPackedLotAndEveryOneHasAccess) {
  Rng rng = testing::property_rng("CubePacking.Access");
  const Options options{.width_deviation = 0.2};
  const PackingSize size{options.lot_width_m, options.width_deviation, options.lot_depth_m,
                         options.depth_min_share * options.lot_depth_m};
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const std::uint64_t seed = rng();
    Rng same(seed);
    const auto lots = pack_lots(block, size, same);
    const auto parcels = divide(options, block, seed);
    ASSERT_EQ(parcels.size(), std::max<std::size_t>(1, lots.size()));
    for (const Parcel& parcel : parcels) {
      ASSERT_GE(testing::frontage_by_distance_m(block, parcel.shape), kStreetAccess_m);
      ++parcels_seen;
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(100) * 4);
}

TEST(CubePackingSubdivider, FittedLotsHaveTheMeanWidthAndArea) {
  const auto options = CubePackingSubdivider({.fit_deviations = 2.0})
                           .fitted({12, 480.0, 100.0, 16.0, 4.0})
                           .options();
  EXPECT_EQ(options.lot_width_m, 16.0);
  EXPECT_EQ(options.lot_depth_m, 30.0);
  EXPECT_EQ(options.width_deviation, 0.5);
}

TEST(LotPacking, LotsLieInsideTheBlockAndBesideEachOther) {
  Rng rng = testing::property_rng("LotPacking.Inside");
  std::size_t lots_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(60))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const auto lots = pack_lots(block, {12.0, 0.3, 25.0, 10.0}, rng);
    // Probes spread over every lot, a slack away from its sides: inside the block, in no other lot.
    for (std::size_t i = 0; i < lots.size(); ++i) {
      const Point along = normalized(lots[i].front.b - lots[i].front.a);
      const double width = length(lots[i].front);
      for (const double x : {0.05, 0.5, 0.95}) {
        for (const double y : {0.05, 0.5, 0.95}) {
          const double inset = 2.0 * kPackingSlack_m;
          const Point probe = lots[i].front.a + (inset + x * (width - 2.0 * inset)) * along +
                              (inset + y * (lots[i].depth_m - 2.0 * inset)) * perpendicular(along);
          ASSERT_EQ(locate(block.contour, probe), Side::kInside);
          for (std::size_t j = 0; j < lots.size(); ++j) {
            if (j == i) continue;
            const Point other = normalized(lots[j].front.b - lots[j].front.a);
            const Point local{dot(probe - lots[j].front.a, other),
                              cross(other, probe - lots[j].front.a)};
            ASSERT_FALSE(local.x > 0.0 && local.x < length(lots[j].front) && local.y > 0.0 &&
                         local.y < lots[j].depth_m)
                << "lots " << i << " and " << j;
          }
        }
      }
    }
    lots_seen += lots.size();
  }
  EXPECT_GT(lots_seen, static_cast<std::size_t>(testing::iterations(60) * 10));
}

}  // namespace
}  // namespace plat::parcels
