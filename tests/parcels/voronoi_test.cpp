#include <gtest/gtest.h>

#include <cmath>

#include "core/working_grid.h"
#include "parcels/made_blocks.h"
#include "parcels/voronoi_diagram.h"
#include "parcels/voronoi_subdivider.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using Options = VoronoiSubdivider::Options;
using Rows = VoronoiSubdivider::Rows;

std::uint32_t nearest_by_brute_force(const std::vector<Point>& sites, Point p) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < sites.size(); ++i) {
    if (squared_length(sites[i] - p) < squared_length(sites[best] - p)) best = i;
  }
  return best;
}

/// From the nearest site to `p`, no edge is crossed; to any other site, one is.
void expect_edges_separate(const std::vector<Point>& sites, const std::vector<VoronoiEdge>& edges,
                           Point p) {
  const std::uint32_t nearest = nearest_by_brute_force(sites, p);
  const auto crossed = [&](Point site) {
    return std::any_of(edges.begin(), edges.end(), [&](const VoronoiEdge& e) {
      return orientation(site, p, e.segment.a) * orientation(site, p, e.segment.b) < 0.0 &&
             orientation(e.segment.a, e.segment.b, site) *
                     orientation(e.segment.a, e.segment.b, p) <
                 0.0;
    });
  };
  for (std::uint32_t i = 0; i < sites.size(); ++i)
    ASSERT_EQ(crossed(sites[i]), i != nearest) << "site " << i << " of " << sites.size();
}

TEST(VoronoiEdges, SeparateEveryPointFromAllButItsNearestSite) {
  Rng rng = testing::property_rng("VoronoiEdges.Random");
  const Box window{{0, 0}, {100, 60}};
  const auto anywhere = [&] { return Point{rng.uniform(1, 99), rng.uniform(1, 59)}; };
  for (int i = 0; i < testing::iterations(60); ++i) {
    std::vector<Point> sites;
    for (std::uint64_t k = 2 + rng.index(14); k > 0; --k) sites.push_back(anywhere());
    const auto edges = voronoi_edges(sites, window);
    for (int k = 0; k < 20; ++k) expect_edges_separate(sites, edges, anywhere());
  }
}

TEST(VoronoiEdges, SitesOnALineAreSeparatedByLines) {
  const std::vector<Point> sites{{10, 10}, {20, 20}, {40, 40}};
  const auto edges = voronoi_edges(sites, {{0, 0}, {50, 50}});
  ASSERT_EQ(edges.size(), 2U);
  Rng rng = testing::property_rng("VoronoiEdges.Line");
  for (int k = 0; k < 50; ++k)
    expect_edges_separate(sites, edges, {rng.uniform(1, 49), rng.uniform(1, 49)});
}

TEST(VoronoiEdges, StayInTheWindowAndLieHalfWay) {
  Rng rng = testing::property_rng("VoronoiEdges.Window");
  const Box window{{0, 0}, {100, 60}};
  std::vector<Point> sites;
  for (int k = 0; k < 30; ++k) sites.push_back({rng.uniform(1, 99), rng.uniform(1, 59)});
  for (const VoronoiEdge& e : voronoi_edges(sites, window)) {
    for (const Point p : {e.segment.a, e.segment.b}) {
      EXPECT_TRUE(window.expanded(1e-9).contains(p));
      EXPECT_NEAR(distance(p, sites[e.left_site]), distance(p, sites[e.right_site]), 1e-6);
    }
    EXPECT_GT(orientation(e.segment.a, e.segment.b, sites[e.left_site]) *
                  -orientation(e.segment.a, e.segment.b, sites[e.right_site]),
              0.0)
        << "one site on each side";
  }
}

TEST(VoronoiEdges, FourSitesOnACircleAreNoTrouble) {
  const std::vector<Point> sites{{10, 10}, {30, 10}, {30, 30}, {10, 30}};
  Rng rng = testing::property_rng("VoronoiEdges.Circle");
  const auto edges = voronoi_edges(sites, {{0, 0}, {40, 40}});
  for (int k = 0; k < 50; ++k)
    expect_edges_separate(sites, edges, {rng.uniform(1, 39), rng.uniform(1, 39)});
}

std::vector<Parcel> divide(const Options& options, const blocks::Block& block,
                           std::uint64_t seed = 1) {
  Rng rng(seed);
  return VoronoiSubdivider(options).subdivide(block, rng).value();
}

TEST(VoronoiSubdivider, NumberOfParcelsIsTheBlocksAreaOverTheMean) {
  for (const Rows rows : {Rows::kOne, Rows::kTwo, Rows::kAutomatic}) {
    Options options{.rows = rows};
    EXPECT_EQ(divide(options, rectangle_block(150, 30)).size(), 10U);
    options.area_mean_m2 = 900.0;
    EXPECT_EQ(divide(options, rectangle_block(150, 30)).size(), 5U) << "odd in two rows, too";
  }
}

TEST(VoronoiSubdivider, BlockSmallerThanTheMeanStaysWhole) {
  EXPECT_EQ(divide({.area_mean_m2 = 1e6}, rectangle_block(150, 30)).size(), 1U);
}

TEST(VoronoiSubdivider, OneRowOfEqualParcelsWithoutSpread) {
  const auto parcels =
      divide({.area_deviation_m2 = 0.0, .rows = Rows::kOne}, rectangle_block(150, 30));
  ASSERT_EQ(parcels.size(), 10U);
  for (const Parcel& parcel : parcels) {
    EXPECT_NEAR(area_m2(parcel.shape), 450.0, 0.5);
    EXPECT_NEAR(box_of(parcel.shape).height(), 30.0, 0.01) << "from side to side";
  }
}

TEST(VoronoiSubdivider, TwoRowsAreBackToBack) {
  const auto parcels =
      divide({.area_deviation_m2 = 0.0, .rows = Rows::kTwo}, rectangle_block(150, 60));
  ASSERT_EQ(parcels.size(), 20U);
  for (const Parcel& parcel : parcels) EXPECT_NEAR(box_of(parcel.shape).height(), 30.0, 0.01);
}

TEST(VoronoiSubdivider, AutomaticRowsComeNearestToTheExpectedAspectRatio) {
  // 20 parcels of 150 x 60 m: one row gives 7.5 x 60 m (ratio 8), two rows 15 x 30 m (ratio 2).
  const Options options{.area_deviation_m2 = 0.0, .aspect_ratio = 2.0};
  const auto depth = [&](double ratio) {
    Options o = options;
    o.aspect_ratio = ratio;
    return box_of(divide(o, rectangle_block(150, 60))[0].shape).height();
  };
  EXPECT_NEAR(depth(2.0), 30.0, 0.01);
  EXPECT_NEAR(depth(8.0), 60.0, 0.01);
}

TEST(VoronoiSubdivider, AreasSpreadAsAskedFor) {
  const auto deviation = [&](double wanted) {
    const Options options{.area_deviation_m2 = wanted, .rows = Rows::kOne};
    const auto parcels = divide(options, rectangle_block(6000, 30));
    double squares = 0.0;
    for (const Parcel& p : parcels)
      squares += (area_m2(p.shape) - 450.0) * (area_m2(p.shape) - 450.0);
    return std::sqrt(squares / static_cast<double>(parcels.size()));
  };
  // A cell's width is the mean of two spacings, so that its deviation is smaller by sqrt(2) at
  // least.
  EXPECT_GT(deviation(150.0), 60.0);
  EXPECT_LT(deviation(150.0), 150.0);
  EXPECT_LT(deviation(50.0), 0.5 * deviation(150.0));
}

TEST(VoronoiSubdivider, ParcelCountIsNearTheWantedOneOnRandomBlocks) {
  Rng rng = testing::property_rng("Voronoi.Count");
  int checked = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(150))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const auto count = static_cast<double>(divide({}, block, rng()).size());
    const double wanted = std::max(1.0, std::round(area_m2(block.contour) / 450.0));
    // A site may fall outside (second row, courtyard), and no parcel comes without a site.
    ASSERT_LE(count, wanted);
    checked += count == wanted ? 1 : 0;
  }
  EXPECT_GT(checked, testing::iterations(150) * 2 / 3);
}

TEST(VoronoiSubdivider, TwinsHaveEquallyManyParcelsOfEqualAreas) {
  const Polygon shapes[] = {rectangle_block(170, 45).contour,
                            {{{0, 0}, {120, 0}, {120, 40}, {50, 40}, {50, 90}, {0, 90}}, {}},
                            {{{0, 0}, {120, 0}, {140, 60}, {-10, 50}}, {}}};
  const Options options{.area_deviation_m2 = 0.0};
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

}  // namespace
}  // namespace plat::parcels
