#include "parcels/skeleton_subdivider.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "parcels/coverage.h"
#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using Options = SkeletonSubdivider::Options;

std::vector<Parcel> divide(const Options& options, const blocks::Block& block,
                           std::uint64_t seed = 1) {
  Rng rng(seed);
  return SkeletonSubdivider(options).subdivide(block, rng).value();
}

TEST(SkeletonSubdivider, EveryParcelHasStreetAccess) {
  Rng rng = testing::property_rng("Skeleton.Access");
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

TEST(SkeletonSubdivider, NoParcelIsBelowTheLeastArea) {
  Rng rng = testing::property_rng("Skeleton.Small");
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const auto parcels = divide({}, block, rng());
    for (const Parcel& parcel : parcels) {
      if (parcels.size() == 1) continue;
      ASSERT_GE(area_m2(parcel.shape), 149.9);
    }
  }
}

TEST(SkeletonSubdivider, NoSmallParcelIsATriangle) {
  Rng rng = testing::property_rng("Skeleton.Triangles");
  int parcels_seen = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const auto parcels = divide({}, block, rng());
    for (const Parcel& parcel : parcels) {
      ++parcels_seen;
      if (parcels.size() == 1 || parcel.shape.outer.size() > 3) continue;
      EXPECT_GE(area_m2(parcel.shape), 0.5 * (150.0 + 900.0) - 0.5);
    }
  }
  EXPECT_GT(parcels_seen, testing::iterations(100) * 5);
}

TEST(SkeletonSubdivider, RectangleGivesQuadsOnly) {
  for (const auto corners : {CornerScheme::kStreetWidth, CornerScheme::kStreetLength}) {
    const auto parcels =
        divide({.irregularity = 0.0, .corners = corners}, rectangle_block(120, 50));
    ASSERT_EQ(parcels.size(), 16U) << "two rows of 120 / 15";
    for (const Parcel& parcel : parcels) {
      const OrientedBox box = minimum_area_box(parcel.shape);
      EXPECT_NEAR(area_m2(parcel.shape), box.area_m2(), 0.1);
      EXPECT_NEAR(area_m2(parcel.shape), 375.0, 0.5);
    }
  }
}

TEST(SkeletonSubdivider, WithoutStreetLabelsEveryOuterEdgeCounts) {
  const blocks::Block block = rectangle_block(120, 50);
  const auto labelled = divide({}, block);
  const auto bare = divide({}, testing::with_streets_on(block, {}));
  EXPECT_EQ(labelled, bare);
}

TEST(SkeletonSubdivider, StreetOnOneSideGivesLotsThroughTheBlock) {
  const auto block = testing::with_streets_on(rectangle_block(120, 50), {0});
  const auto parcels = divide({.irregularity = 0.0}, block);
  ASSERT_EQ(parcels.size(), 8U);
  for (const Parcel& parcel : parcels) EXPECT_NEAR(area_m2(parcel.shape), 750.0, 0.5);
}

TEST(SkeletonSubdivider, BlockOfThousandsOfVerticesIsSimplifiedAndDivided) {
  Ring ring;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / 3000.0;
    const double radius = 100.0 + 0.3 * std::sin(40.0 * angle);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  const auto admitted = admit_polygon({ring, {}}, 10'000);
  ASSERT_TRUE(admitted);
  EXPECT_GT(divide({}, blocks::block_from_contour(BlockId{}, *admitted)).size(), 10U);
}

TEST(SkeletonSubdivider, TwinsHaveEquallyManyParcelsOfEqualAreas) {
  const Polygon shapes[] = {rectangle_block(170, 45).contour,
                            {{{0, 0}, {120, 0}, {120, 40}, {50, 40}, {50, 90}, {0, 90}}, {}},
                            {{{0, 0}, {120, 0}, {140, 60}, {-10, 50}}, {}}};
  const Options options{.irregularity = 0.0};
  for (const Polygon& shape : shapes) {
    const auto areas =
        testing::sorted_areas(divide(options, blocks::block_from_contour({}, shape)));
    EXPECT_GT(areas.size(), 4U);
    for (const auto twin : {testing::Twin::kTranslated, testing::Twin::kTurnedBy90,
                            testing::Twin::kMirrored, testing::Twin::kRotatedStart}) {
      const auto twins = testing::sorted_areas(
          divide(options, blocks::block_from_contour({}, testing::twin_of(shape, twin))));
      ASSERT_EQ(twins.size(), areas.size()) << "twin " << static_cast<int>(twin);
      for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(twins[i], areas[i], 2.0);
    }
  }
}

double patio_area_m2(const blocks::Block& block, const std::vector<Parcel>& parcels) {
  double sum = 0.0;
  for (const Parcel& p : parcels) {
    if (testing::frontage_by_distance_m(block, p.shape) < kStreetAccess_m) sum += area_m2(p.shape);
  }
  return sum;
}

TEST(SkeletonSubdivider, OffsetLeavesAPatioWithoutAccess) {
  const blocks::Block block = rectangle_block(150, 100);
  const auto parcels = divide({.irregularity = 0.0, .offset_m = 30.0}, block);
  EXPECT_NEAR(patio_area_m2(block, parcels), 90.0 * 40.0, 0.5);
  EXPECT_EQ(std::count_if(parcels.begin(), parcels.end(),
                          [&](const Parcel& p) {
                            return testing::frontage_by_distance_m(block, p.shape) < 1.0;
                          }),
            1);
  EXPECT_EQ(patio_area_m2(block, divide({}, block)), 0.0) << "no offset, no patio";
}

TEST(SkeletonSubdivider, InnerDivisionDividesThePatio) {
  const blocks::Block block = rectangle_block(250, 200);
  const auto count = [&](InnerDivision inner) {
    return divide({.offset_m = 30.0, .inner = inner}, block).size();
  };
  EXPECT_GT(count(InnerDivision::kObb), count(InnerDivision::kKeep) + 10);
  EXPECT_GT(count(InnerDivision::kSkeleton), count(InnerDivision::kKeep) + 10);
}

TEST(SkeletonSubdivider, WithPatiosParcelsAreACoverage) {
  Rng rng = testing::property_rng("Skeleton.Patios");
  int patios = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(200))) {
    blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    if (rng.index(3) == 0) block = testing::with_streets_on(std::move(block), {0, 2});
    const auto inner = static_cast<InnerDivision>(rng.index(3));
    const auto parcels = divide({.offset_m = rng.uniform(3.0, 40.0), .inner = inner}, block, rng());
    const auto defect = find_coverage_defect(block.contour, parcels, kContourTolerance_m);
    ASSERT_FALSE(defect) << defect->message;
    patios += patio_area_m2(block, parcels) > 0.0 ? 1 : 0;
  }
  EXPECT_GT(patios, testing::iterations(200) / 4);
}

TEST(SkeletonSubdivider, RowsTooShallowForTwoAreOne) {
  // Expected depth 525 / 15 = 35 m: two rows of 10 m are too shallow, one of 20 m is what fits.
  const blocks::Block block = rectangle_block(120, 20);
  const auto one = divide({.irregularity = 0.0}, block);
  ASSERT_EQ(one.size(), 8U);
  for (const Parcel& p : one) EXPECT_NEAR(area_m2(p.shape), 15.0 * 20.0, 0.5);
  const auto two = divide({.area_min_m2 = 0.0, .irregularity = 0.0, .shallow_share = 0.0}, block);
  EXPECT_EQ(two.size(), 16U);
}

TEST(SkeletonSubdivider, ShallowRowsFaceTheWiderStreet) {
  blocks::Block block = rectangle_block(120, 20);
  // The front of the wider street bends, that of the other one is straight: slices stay
  // perpendicular to the wider one's.
  block.contour.outer = {{0, 0}, {120, 12}, {120, 32}, {0, 20}};
  block.edges[0][0].street_width_m = 30.0;
  const auto parcels = divide({.irregularity = 0.0}, block);
  ASSERT_GT(parcels.size(), 4U);
  const Point along = normalized(Point{120, 12});
  int across = 0;
  for (const Parcel& p : parcels) {
    for_each_edge(p.shape, [&](const Segment& s) {
      across += std::abs(dot(normalized(s.b - s.a), along)) < 0.01 ? 1 : 0;
    });
  }
  EXPECT_GE(across, 2 * static_cast<int>(parcels.size() - 1));
}

TEST(SkeletonSubdivider, LargeLotsAreCutOnceMoreFromTheStreet) {
  const blocks::Block block = rectangle_block(200, 160);
  const auto parcels = divide({.irregularity = 0.0}, block);
  const auto uncut = divide({.area_max_m2 = 1e9, .irregularity = 0.0, .shallow_share = 0.0}, block);
  EXPECT_GT(parcels.size(), uncut.size());
  for (const Parcel& p : parcels) {
    const double front_m = testing::frontage_by_distance_m(block, p.shape);
    EXPECT_TRUE(area_m2(p.shape) <= 900.0 || front_m < 15.0 + 0.1)
        << "only a lot too narrow to be halved stays large";
  }
}

TEST(SkeletonSubdivider, TraceShowsTheStepsOfTheSameDivision) {
  const blocks::Block block = rectangle_block(150, 100);
  const SkeletonSubdivider subdivider({.irregularity = 0.0, .offset_m = 30.0});
  Rng rng(1);
  SubdivisionTrace trace;
  EXPECT_EQ(subdivider.subdivide(block, rng, trace).value(), divide(subdivider.options(), block));
  std::map<TraceStep, int> count;
  for (const auto& line : trace.lines()) ++count[line.step];
  EXPECT_EQ(count[TraceStep::kSkeletonArc], 4) << "the diagonals up to the offset";
  EXPECT_EQ(count[TraceStep::kOffset], 4);
  EXPECT_GT(count[TraceStep::kSlice], 10);
}

ParcelStyle style_with(std::size_t count, double area_m2, double deviation_m2) {
  ParcelStyle style;
  style.count = count;
  style.area_mean_m2 = area_m2;
  style.area_deviation_m2 = deviation_m2;
  style.width_mean_m = 15.0;
  style.width_deviation_m = 1.0;
  return style;
}

TEST(SkeletonSubdivider, FittedBoundsAreMeanAndDeviations) {
  const auto fit = [](const ParcelStyle& style) {
    return SkeletonSubdivider(Options{}).fitted(style).options();
  };
  const Options wide = fit(style_with(20, 400.0, 300.0));
  EXPECT_EQ(wide.area_min_m2, -200.0);
  EXPECT_EQ(wide.area_max_m2, 1000.0);
  EXPECT_EQ(wide.width_min_m, 13.0);
  EXPECT_EQ(wide.width_max_m, 17.0);
  const Options narrow = fit(style_with(20, 300.0, 1.0));
  EXPECT_EQ(narrow.area_min_m2, 150.0) << "merging a lot above half the mean moves it away";
  EXPECT_EQ(narrow.area_max_m2, 400.0) << "as does halving one below four thirds";
}

TEST(SkeletonSubdivider, ABlockObservedAsOneParcelStaysOne) {
  const blocks::Block block = rectangle_block(120, 50);
  ParcelStyle style = style_with(1, 6000.0, 0.0);
  style.width_mean_m = 50.0;
  Rng rng(1);
  EXPECT_EQ(SkeletonSubdivider(Options{}).fitted(style).subdivide(block, rng)->size(), 1U);
}

}  // namespace
}  // namespace plat::parcels
