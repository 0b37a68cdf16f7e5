#include "parcels/border_voronoi_subdivider.h"

#include <gtest/gtest.h>

#include "parcels/coverage.h"
#include "parcels/fronts.h"
#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using Options = BorderVoronoiSubdivider::Options;

std::vector<Parcel> divide(const Options& options, const blocks::Block& block,
                           std::uint64_t seed = 1) {
  Rng rng(seed);
  return BorderVoronoiSubdivider(options).subdivide(block, rng).value();
}

TEST(BorderVoronoiSubdivider, AFrontGetsAsManySitesAsSpacingsFit) {
  // 160 / 20 on each long side, 40 / 20 on each short one.
  EXPECT_EQ(divide({.spacing_m = 20.0, .spacing_deviation = 0.0}, rectangle_block(160, 40)).size(),
            20U);
}

TEST(BorderVoronoiSubdivider, ParcelsOfAStraightFrontHaveTheSpacingsWidth) {
  const blocks::Block block = testing::with_streets_on(rectangle_block(200, 40), {0});
  const auto parcels = divide({.spacing_m = 20.0, .spacing_deviation = 0.0}, block);
  ASSERT_EQ(parcels.size(), 10U);
  for (const Parcel& parcel : parcels) {
    EXPECT_NEAR(area_m2(parcel.shape), 800.0, 0.1);
    EXPECT_NEAR(box_of(parcel.shape).width(), 20.0, 0.01);
  }
}

TEST(BorderVoronoiSubdivider, ABlockShorterThanASpacingIsOneParcel) {
  EXPECT_EQ(divide({.spacing_m = 1000.0}, rectangle_block(60, 30)).size(), 1U);
  const ParcelStyle one{1, 1800.0, 0.0, 30.0, 0.0};
  Rng rng(1);
  EXPECT_EQ(BorderVoronoiSubdivider({}).fitted(one).subdivide(rectangle_block(60, 30), rng)->size(),
            1U);
}

TEST(BorderVoronoiSubdivider, TheSetbackMovesTheCutBetweenTheStreetsOfACorner) {
  // Sites at 15 m from the corner along the long side, at 12.5 m along the short one.
  const auto areas = [](double setback_m) {
    return testing::sorted_areas(
        divide({.spacing_m = 30.0, .spacing_deviation = 0.0, .setback_m = setback_m},
               rectangle_block(120, 50)));
  };
  ASSERT_EQ(areas(1.0).size(), 12U);
  ASSERT_EQ(areas(10.0).size(), 12U);
  EXPECT_GT(std::abs(areas(1.0).back() - areas(10.0).back()), 5.0);
}

TEST(BorderVoronoiSubdivider, OneParcelASiteEvenWhereTheBlockIsThinnerThanTheSetback) {
  Rng rng = testing::property_rng("BorderVoronoi.Sites");
  const Options options{.spacing_m = 12.0, .spacing_deviation = 0.3, .setback_m = 60.0};
  int divided = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    int sites = 0;
    for (const Front& front : fronts_of(block))
      sites += static_cast<int>(std::round(length_m(front) / options.spacing_m));
    const auto parcels = divide(options, block, rng());
    ASSERT_FALSE(find_coverage_defect(block.contour, parcels, kContourTolerance_m));
    EXPECT_LE(static_cast<int>(parcels.size()), std::max(1, sites));
    // Sites in the tips of spikes may be given up, or meet on the grid.
    EXPECT_GE(static_cast<int>(parcels.size()), sites * 9 / 10);
    divided += parcels.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(divided, testing::iterations(90));
}

TEST(BorderVoronoiSubdivider, SitesStandOnStreetsOnly) {
  const blocks::Block block = testing::with_streets_on(rectangle_block(200, 40), {0, 2});
  for (const Parcel& parcel : divide({}, block))
    EXPECT_GT(testing::frontage_by_distance_m(block, parcel.shape), 5.0);
}

TEST(BorderVoronoiSubdivider, FittingTakesSpacingAndSpreadFromTheWidths) {
  const auto fitted =
      BorderVoronoiSubdivider({.fit_deviations = 2.0}).fitted({12, 500.0, 100.0, 16.0, 4.0});
  EXPECT_EQ(fitted.options().spacing_m, 16.0);
  EXPECT_EQ(fitted.options().spacing_deviation, 0.5);
}

}  // namespace
}  // namespace plat::parcels
