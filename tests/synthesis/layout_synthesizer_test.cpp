#include "synthesis/layout_synthesizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

#include "parcels/obb_subdivider.h"
#include "parcels/voronoi_subdivider.h"
#include "synthesis/grid_grower.h"

namespace plat::synthesis {
namespace {

using parcels::AnyBlockSubdivider;
using parcels::VoronoiSubdivider;
using streets::AnyStreetGrower;
using testing::grid_points;
using testing::GridGrower;

LayoutSite grid_site(std::optional<double> parcel_area_m2 = 500.0) {
  LayoutSite site;
  site.growth.points = grid_points(6, 5, {160.0, 80.0}, parcel_area_m2);
  return site;
}

template <class G, class S>
Layout synthesized(const G& grower, const S& subdivider, const LayoutSite& site, int jobs = 1,
                   std::uint64_t seed = 1) {
  auto layout =
      LayoutSynthesizer<G, S>(grower, subdivider, {.seed = seed}).synthesize(site, Jobs{jobs});
  EXPECT_TRUE(layout.has_value());
  return *std::move(layout);
}

Layout grid_layout(const LayoutSite& site, int jobs = 1, std::uint64_t seed = 1) {
  return synthesized(GridGrower({}), VoronoiSubdivider({}), site, jobs, seed);
}

void expect_same(const Layout& a, const Layout& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.network.nodes, b.network.nodes);
  ASSERT_EQ(a.network.streets.size(), b.network.streets.size());
  for (std::size_t s = 0; s < a.network.streets.size(); ++s) {
    EXPECT_EQ(a.network.streets[s].line, b.network.streets[s].line);
    EXPECT_EQ(a.network.streets[s].width_m, b.network.streets[s].width_m);
  }
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].block.contour, b.blocks[i].block.contour);
    EXPECT_EQ(a.blocks[i].block.edges, b.blocks[i].block.edges);
    EXPECT_EQ(a.blocks[i].strategy, b.blocks[i].strategy);
    EXPECT_EQ(a.blocks[i].options, b.blocks[i].options);
    EXPECT_EQ(a.blocks[i].seed, b.blocks[i].seed);
    ASSERT_EQ(a.blocks[i].parcels.has_value(), b.blocks[i].parcels.has_value());
    if (a.blocks[i].parcels) {
      EXPECT_EQ(*a.blocks[i].parcels, *b.blocks[i].parcels);
    }
  }
  EXPECT_EQ(a.failures.size(), b.failures.size());
}

/// A street of an existing network, 12 m wide.
streets::Street existing_street(Point from, Point to) {
  streets::Street street;
  street.line = {from, to};
  street.width_m = 12.0;
  street.width_source = streets::WidthSource::kAttribute;
  street.source_id = "old";
  return street;
}

streets::StreetNetwork existing_network(std::vector<streets::Street> streets) {
  streets::StreetNetwork out;
  for (const auto& street : streets) {
    out.nodes.push_back(street.line.front());
    out.nodes.push_back(street.line.back());
  }
  std::sort(out.nodes.begin(), out.nodes.end());
  out.nodes.erase(std::unique(out.nodes.begin(), out.nodes.end()), out.nodes.end());
  for (auto& street : streets) {
    const auto node = [&](Point p) {
      return static_cast<std::uint32_t>(std::find(out.nodes.begin(), out.nodes.end(), p) -
                                        out.nodes.begin());
    };
    street.id = {static_cast<std::uint32_t>(out.streets.size())};
    street.from = node(street.line.front());
    street.to = node(street.line.back());
    out.streets.push_back(std::move(street));
  }
  return out;
}

TEST(LayoutSynthesizer, GoesFromPointsToParcels) {
  const Layout layout = grid_layout(grid_site());
  EXPECT_EQ(layout.points.size(), 30U);
  EXPECT_EQ(layout.network.streets.size(), 5U * 5U + 6U * 4U);
  EXPECT_EQ(layout.segments.size(), layout.network.streets.size());
  EXPECT_EQ(layout.blocks.size(), 5U * 4U);
  EXPECT_EQ(layout.dual.size(), 4U * 4U + 5U * 3U);
  EXPECT_GT(parcel_count(layout), layout.blocks.size() * 10);
  EXPECT_TRUE(layout.failures.empty());
  EXPECT_TRUE(layout.left_alone.empty());
}

TEST(LayoutSynthesizer, ParcelsAreACoverageOfTheirBlock) {
  const Layout layout = grid_layout(grid_site());
  for (const LayoutBlock& block : layout.blocks) {
    ASSERT_TRUE(block.parcels);
    EXPECT_FALSE(parcels::find_coverage_defect(block.block.contour, *block.parcels,
                                               parcels::kContourTolerance_m));
    double sum_m2 = 0.0;
    for (const parcels::Parcel& parcel : *block.parcels) sum_m2 += area_m2(parcel.shape);
    EXPECT_DOUBLE_EQ(sum_m2, area_m2(block.block.contour));
  }
}

TEST(LayoutSynthesizer, TypesAndNamesGiveTheSameLayout) {
  const LayoutSite site = grid_site();
  const Layout typed = grid_layout(site);
  Registry<AnyStreetGrower> growers;
  growers.add<GridGrower>();
  const Layout named =
      synthesized(growers.make("grid"), parcels::block_subdividers().make("voronoi"), site);
  expect_same(typed, named);
  EXPECT_EQ(named.blocks.front().strategy, "voronoi");
}

TEST(LayoutSynthesizer, DoesNotDependOnTheNumberOfThreads) {
  const LayoutSite site = grid_site();
  const Layout one = grid_layout(site, 1);
  expect_same(one, grid_layout(site, 2));
  expect_same(one, grid_layout(site, 5));
}

TEST(LayoutSynthesizer, EachBlockHasAStreamOfItsOwnAndAnotherWithAnotherSeed) {
  const Layout layout = grid_layout(grid_site());
  const Layout other = grid_layout(grid_site(), 1, 2);
  EXPECT_NE(layout.blocks[0].seed, layout.blocks[1].seed);
  EXPECT_NE(layout.blocks[0].seed, other.blocks[0].seed);
}

TEST(LayoutSynthesizer, ParcelsHaveTheAreaThatThePointsStore) {
  for (const double wanted_m2 : {250.0, 500.0, 900.0}) {
    const Layout layout = grid_layout(grid_site(wanted_m2));
    double sum_m2 = 0.0;
    double worst = 0.0;
    for (const LayoutBlock& block : layout.blocks) {
      for (const parcels::Parcel& parcel : *block.parcels) {
        sum_m2 += area_m2(parcel.shape);
        worst = std::max(worst, std::abs(area_m2(parcel.shape) / wanted_m2 - 1.0));
      }
    }
    const double mean_m2 = sum_m2 / static_cast<double>(parcel_count(layout));
    EXPECT_NEAR(mean_m2 / wanted_m2, 1.0, 0.05) << wanted_m2;
    EXPECT_LT(worst, 0.35) << wanted_m2 << ": no deviation is stored, so lots are alike";
  }
}

TEST(LayoutSynthesizer, AreasFollowThePointsFromBlockToBlock) {
  LayoutSite site;
  site.growth.points = grid_points(4, 5, {160.0, 80.0}, 300.0);
  for (const auto& point : grid_points(4, 5, {160.0, 80.0}, 900.0, {640.0, 0.0}))
    site.growth.points.push_back(point);
  const Layout layout = grid_layout(site);
  for (const LayoutBlock& block : layout.blocks) {
    const double x = centroid(block.block.contour).x;
    const double mean_m2 =
        area_m2(block.block.contour) / static_cast<double>(block.parcels->size());
    if (x < 480.0) {
      EXPECT_NEAR(mean_m2, 300.0, 30.0);
    } else if (x > 640.0) {
      EXPECT_NEAR(mean_m2, 900.0, 90.0);
    } else {
      EXPECT_NEAR(block.style.area_mean_m2, 600.0, 1e-9);
      EXPECT_GT(block.style.area_deviation_m2, 300.0);
    }
  }
}

TEST(LayoutSynthesizer, BlocksWhosePointsKnowNoParcelsTakeTheMeanOfTheLayout) {
  LayoutSite site = grid_site(std::nullopt);
  site.growth.points.front().parcel_area_m2 = 400.0;
  const Layout layout = grid_layout(site);
  std::size_t from_layout = 0;
  for (const LayoutBlock& block : layout.blocks) {
    EXPECT_DOUBLE_EQ(block.style.area_mean_m2, 400.0);
    from_layout += block.style_source == StyleSource::kLayout ? 1 : 0;
  }
  EXPECT_EQ(from_layout, layout.blocks.size() - 1);
}

TEST(LayoutSynthesizer, WithoutAnyParcelsTheSubdividerIsUsedAsItWasGiven) {
  const Layout layout =
      synthesized(GridGrower({}), VoronoiSubdivider({.area_mean_m2 = 777.0}), grid_site({}));
  for (const LayoutBlock& block : layout.blocks) {
    EXPECT_EQ(block.style_source, StyleSource::kNone);
    EXPECT_EQ(block.options.at("area_mean_m2"), OptionValue(777.0));
  }
}

TEST(LayoutSynthesizer, ExistingStreetsComeFirstAndTheirBlocksAreTold) {
  LayoutSite site;
  // An old block west of the new ones, its east side open for them.
  site.growth.existing =
      existing_network({existing_street({-160, 0}, {0, 0}), existing_street({-160, 80}, {0, 80}),
                        existing_street({-160, 0}, {-160, 80}), existing_street({0, 0}, {0, 80})});
  site.existing_segments = {{0, 3}, {0, 4}, {1, 5}, {1, 6}};
  site.existing_points = grid_points(2, 2, {160.0, 80.0}, 1000.0, {-160.0, 0.0});
  site.growth.points = grid_points(3, 2, {160.0, 80.0}, 400.0, {160.0, 0.0});
  const Layout layout = grid_layout(site);
  ASSERT_EQ(layout.existing_count, 4U);
  for (std::size_t s = 0; s < layout.network.streets.size(); ++s) {
    EXPECT_EQ(layout.network.streets[s].source_id, s < 4 ? "old" : "");
    ASSERT_TRUE(layout.segments[s]);
    EXPECT_EQ(layout.segments[s]->street >= 7, s >= 4) << "numbers of grown streets follow";
  }
  ASSERT_EQ(layout.blocks.size(), 4U);
  for (const LayoutBlock& block : layout.blocks) {
    const double x = centroid(block.block.contour).x;
    EXPECT_EQ(block.is_existing, x < 0.0);
    EXPECT_EQ(block.style_source, StyleSource::kPoints);
    // Points of the existing city count for the blocks there and at the seam.
    EXPECT_DOUBLE_EQ(block.style.area_mean_m2, x < 0.0 ? 1000.0 : (x < 160.0 ? 700.0 : 400.0));
  }
}

TEST(LayoutSynthesizer, StreetsWithoutAWidthGetOneAndOthersKeepTheirs) {
  LayoutSite site = grid_site();
  for (std::size_t i = 0; i < site.growth.points.size(); i += 2)
    site.growth.points[i].a.width_m = 0.0;
  const Layout layout = grid_layout(site);
  std::size_t assumed = 0;
  for (const streets::Street& street : layout.network.streets) {
    EXPECT_GT(street.width_m, 0.0);
    if (street.width_source == streets::WidthSource::kAssumed) {
      ++assumed;
    } else {
      EXPECT_DOUBLE_EQ(street.width_m, 10.0);
    }
  }
  EXPECT_GT(assumed, 10U);
  EXPECT_LT(assumed, layout.network.streets.size());
}

/// Divides nothing.
struct RefusingSubdivider {
  [[nodiscard]] Expected<std::vector<parcels::Parcel>> subdivide(const blocks::Block&, Rng&) const {
    return fail(FailureCode::kTooSmall, "never");
  }
  [[nodiscard]] RefusingSubdivider fitted(const parcels::ParcelStyle&) const { return *this; }
};

/// Leaves most of the block out.
struct CarelessSubdivider {
  [[nodiscard]] Expected<std::vector<parcels::Parcel>> subdivide(const blocks::Block& block,
                                                                 Rng&) const {
    const Ring& ring = block.contour.outer;
    return std::vector<parcels::Parcel>{{{0}, {{ring[0], ring[1], ring[2]}, {}}}};
  }
  [[nodiscard]] CarelessSubdivider fitted(const parcels::ParcelStyle&) const { return *this; }
};

TEST(LayoutSynthesizer, ABlockThatCannotBeDividedIsARowWithItsPlace) {
  const Layout layout = synthesized(GridGrower({}), RefusingSubdivider{}, grid_site());
  ASSERT_EQ(layout.failures.size(), layout.blocks.size());
  for (const LayoutFailure& row : layout.failures) {
    EXPECT_EQ(row.stage, SynthesisStage::kParcels);
    EXPECT_EQ(row.failure.code, FailureCode::kTooSmall);
    EXPECT_EQ(locate(row.shape, row.place), Side::kInside);
  }
}

TEST(LayoutSynthesizer, ParcelsThatDoNotCoverTheirBlockAreARow) {
  const Layout layout = synthesized(GridGrower({}), CarelessSubdivider{}, grid_site());
  ASSERT_EQ(layout.failures.size(), layout.blocks.size());
  EXPECT_EQ(layout.failures.front().failure.code, FailureCode::kNotCovered);
}

TEST(LayoutSynthesizer, AFaceTooSmallForABlockIsARow) {
  LayoutSite site;
  site.growth.points = grid_points(3, 2, {160.0, 80.0}, 500.0);
  for (const auto& point : grid_points(1, 2, {160.0, 80.0}, 500.0, {330.25, 0.0}))
    site.growth.points.push_back(point);
  const Layout layout = grid_layout(site);
  ASSERT_EQ(layout.failures.size(), 1U);
  EXPECT_EQ(layout.failures.front().stage, SynthesisStage::kBlocks);
  EXPECT_EQ(layout.blocks.size(), 2U);
}

TEST(LayoutSynthesizer, ASiteThatCannotBeUsedIsTheGrowersFailure) {
  LayoutSite site = grid_site();
  site.growth.boundary = Polygon{};
  const auto layout =
      LayoutSynthesizer(GridGrower({}), VoronoiSubdivider({})).synthesize(site, Jobs{1});
  ASSERT_FALSE(layout);
  EXPECT_EQ(layout.error().code, FailureCode::kEmptyGeometry);
}

TEST(LayoutSynthesizer, ASiteWithoutPointsIsAnEmptyLayout) {
  const Layout layout = grid_layout({});
  EXPECT_TRUE(layout.network.streets.empty());
  EXPECT_TRUE(layout.blocks.empty());
  EXPECT_TRUE(layout.failures.empty());
}

TEST(LayoutSynthesizer, TellsItsWatcherOfEveryStageAndStep) {
  struct Counter {
    std::vector<std::pair<SynthesisStage, std::size_t>> stages;
    std::size_t steps = 0;
    std::mutex mutex;
    void begin(SynthesisStage stage, std::size_t count) { stages.emplace_back(stage, count); }
    void step() {
      const std::lock_guard lock(mutex);
      ++steps;
    }
  } counter;
  const auto layout = LayoutSynthesizer(GridGrower({}), VoronoiSubdivider({}))
                          .synthesize(grid_site(), Jobs{2}, counter);
  ASSERT_TRUE(layout);
  ASSERT_EQ(counter.stages.size(), std::size(kSynthesisStages));
  std::size_t steps = 0;
  for (std::size_t i = 0; i < counter.stages.size(); ++i) {
    EXPECT_EQ(counter.stages[i].first, kSynthesisStages[i]);
    steps += counter.stages[i].second;
  }
  EXPECT_EQ(counter.steps, steps);
  EXPECT_EQ(counter.stages.back().second, layout->blocks.size());
}

}  // namespace
}  // namespace plat::synthesis
