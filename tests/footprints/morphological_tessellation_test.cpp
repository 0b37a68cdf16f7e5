#include "footprints/morphological_tessellation.h"

#include <gtest/gtest.h>

#include <chrono>

#include "blocks/block_assignment.h"
#include "blocks/block_extraction.h"
#include "core/validity.h"
#include "core/working_grid.h"
#include "geodata/layer_io.h"
#include "parcels/coverage.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "streets/street_width.h"
#include "support/data_folder.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::footprints {
namespace {

Polygon rectangle(double x, double y, double w, double h) {
  return {{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, {}};
}

blocks::Block block_of(const Polygon& contour) {
  return blocks::block_from_contour(BlockId{0}, contour);
}

void expect_coverage(const blocks::Block& block, const Tessellation& t) {
  const auto defect =
      parcels::find_coverage_defect(block.contour, t.plots, parcels::kContourTolerance_m);
  EXPECT_FALSE(defect) << defect->message;
  EXPECT_EQ(t.plots.size(), t.footprint_of_plot.size());
}

TEST(MorphologicalTessellation, TwoEqualSquaresMeetInAStraightMiddleLine) {
  const blocks::Block block = block_of(rectangle(0, 0, 60, 30));
  const std::vector<Polygon> footprints{rectangle(5, 5, 20, 20), rectangle(35, 5, 20, 20)};
  const auto t = MorphologicalTessellation().tessellate(block, footprints);
  ASSERT_TRUE(t) << t.error().message;
  expect_coverage(block, *t);
  ASSERT_EQ(t->plots.size(), 2U);
  EXPECT_EQ(t->footprint_of_plot, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_DOUBLE_EQ(area_m2(t->plots[0].shape), 900.0);
  EXPECT_EQ(box_of(t->plots[0].shape).max.x, 30.0);
  EXPECT_EQ(t->plots[0].shape.outer.size(), 4U);
}

TEST(MorphologicalTessellation, RowHousesPartAtTheirPartyWalls) {
  const blocks::Block block = block_of(rectangle(0, 0, 40, 30));
  std::vector<Polygon> footprints;
  for (int i = 0; i < 5; ++i) footprints.push_back(rectangle(8.0 * i, 3, 8, 12));
  const auto t = MorphologicalTessellation().tessellate(block, footprints);
  ASSERT_TRUE(t) << t.error().message;
  expect_coverage(block, *t);
  ASSERT_EQ(t->plots.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(area_m2(t->plots[i].shape), 240.0, 6.0);
    EXPECT_EQ(locate(t->plots[i].shape, centroid(footprints[i])), Side::kInside);
  }
}

TEST(MorphologicalTessellation, OneFootprintTakesTheWholeBlock) {
  const blocks::Block block = block_of(rectangle(0, 0, 40, 30));
  const auto t =
      MorphologicalTessellation().tessellate(block, std::vector<Polygon>{rectangle(3, 3, 9, 9)});
  ASSERT_TRUE(t);
  ASSERT_EQ(t->plots.size(), 1U);
  EXPECT_DOUBLE_EQ(area_m2(t->plots[0].shape), 1200.0);
}

TEST(MorphologicalTessellation, AnEnclosedFootprintGetsAnIsland) {
  const blocks::Block block = block_of(rectangle(0, 0, 80, 80));
  Polygon ring = rectangle(10, 10, 60, 60);
  ring.holes.push_back({{20, 20}, {20, 60}, {60, 60}, {60, 20}});
  const std::vector<Polygon> footprints{ring, rectangle(35, 35, 10, 10)};
  const auto t = MorphologicalTessellation().tessellate(block, footprints);
  ASSERT_TRUE(t) << t.error().message;
  expect_coverage(block, *t);
  ASSERT_EQ(t->plots.size(), 2U);
  EXPECT_EQ(t->plots[0].shape.holes.size(), 1U);
  EXPECT_EQ(locate(t->plots[1].shape, {40, 40}), Side::kInside);
}

TEST(MorphologicalTessellation, FootprintsTooSmallGetNoPlot) {
  const blocks::Block block = block_of(rectangle(0, 0, 40, 30));
  const std::vector<Polygon> footprints{rectangle(1, 1, 2, 2), rectangle(10, 5, 9, 9)};
  const auto t = MorphologicalTessellation().tessellate(block, footprints);
  ASSERT_TRUE(t);
  EXPECT_EQ(t->footprint_of_plot, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(t->without_plot, (std::vector<std::uint32_t>{0}));
}

TEST(MorphologicalTessellation, ABlockWithoutFootprintsIsAFailure) {
  const blocks::Block block = block_of(rectangle(0, 0, 40, 30));
  const auto t = MorphologicalTessellation().tessellate(block, {});
  ASSERT_FALSE(t);
  EXPECT_EQ(t.error().code, FailureCode::kNoObservation);
}

TEST(MorphologicalTessellation, ThinFootprintsKeepOneSample) {
  const blocks::Block block = block_of(rectangle(0, 0, 40, 30));
  const std::vector<Polygon> footprints{rectangle(1, 1, 30, 0.5), rectangle(10, 15, 9, 9)};
  const auto t = MorphologicalTessellation().tessellate(block, footprints);
  ASSERT_TRUE(t);
  expect_coverage(block, *t);
  EXPECT_EQ(t->plots.size(), 2U);
}

TEST(MorphologicalTessellation, CoversAnyBlockWhateverTheOrderOfFootprints) {
  int covered = 0;
  Rng rng = testing::property_rng("CoversAnyBlockWhateverTheOrderOfFootprints");
  const int cases = testing::iterations(60);
  for (int c = 0; c < cases; ++c) {
    const blocks::Block block = block_of(testing::synthetic_blocks(rng, 1).front());
    const Box box = box_of(block.contour);
    std::vector<Polygon> footprints;
    const auto count = static_cast<int>(2 + rng.index(20));
    for (int i = 0; i < count; ++i) {
      footprints.push_back(rectangle(snap(rng.uniform(box.min.x, box.max.x)),
                                     snap(rng.uniform(box.min.y, box.max.y)),
                                     snap(rng.uniform(3, 20)), snap(rng.uniform(3, 20))));
    }
    const auto t = MorphologicalTessellation().tessellate(block, footprints);
    ASSERT_TRUE(t) << t.error().message;
    expect_coverage(block, *t);
    EXPECT_TRUE(std::is_sorted(t->footprint_of_plot.begin(), t->footprint_of_plot.end(),
                               std::less_equal<std::uint32_t>()))
        << "a footprint has two plots";
    for (const parcels::Parcel& plot : t->plots)
      EXPECT_FALSE(find_ogc_defect(plot.shape)) << "plot " << plot.id.value;
    covered += t->plots.size() > 1 ? 1 : 0;
    std::reverse(footprints.begin(), footprints.end());
    const auto twin = MorphologicalTessellation().tessellate(block, footprints);
    ASSERT_TRUE(twin) << twin.error().message;
    EXPECT_EQ(twin->plots.size(), t->plots.size());
  }
  EXPECT_GT(covered, cases / 2);
}

TEST(AssignToBlocks, GoesByAnInteriorPoint) {
  const std::vector<blocks::Block> blocks{block_of(rectangle(0, 0, 40, 30)),
                                          block_of(rectangle(50, 0, 40, 30))};
  const std::vector<Polygon> footprints{
      rectangle(60, 5, 5, 5), rectangle(41, 5, 8, 5), rectangle(30, 5, 12, 5), {}};
  const blocks::BlockAssignment found = blocks::assign_to_blocks(blocks, footprints);
  EXPECT_EQ(found.of_block[0], (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(found.of_block[1], (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(found.outside, (std::vector<std::uint32_t>{1, 3}));
}

TEST(MorphologicalTessellation, SanFranciscoIsCoveredBlockByBlock) {
  PLAT_REAL_DATA_OR_SKIP(path, "san_francisco_us/san_francisco_us.gpkg");
  using geodata::GeometryKind;
  const auto roads = geodata::read_layer({path, "road"}, {.kind = GeometryKind::kLine});
  const auto buildings = geodata::read_layer({path, "building"}, {.frame = roads.frame});
  auto clean = streets::build_network(streets::import_streets(roads).streets);
  streets::assign_widths(clean.network, {});
  const auto found = blocks::extract_blocks(clean.network);
  ASSERT_GT(found.blocks.size(), 100U);
  std::vector<Polygon> footprints;
  for (const auto& feature : buildings.features)
    footprints.insert(footprints.end(), feature.polygons.begin(), feature.polygons.end());

  const auto start = std::chrono::steady_clock::now();
  const blocks::BlockAssignment assigned = blocks::assign_to_blocks(found.blocks, footprints);
  const MorphologicalTessellation tessellation;
  std::size_t plots = 0;
  std::size_t own_plot = 0;
  std::size_t tessellated = 0;
  geodata::Layer layer{"plots", GeometryKind::kPolygon, roads.frame, {}, {}};
  std::vector<std::pair<std::size_t, Tessellation>> results;
  for (std::size_t b = 0; b < found.blocks.size(); ++b) {
    std::vector<Polygon> own;
    for (const std::uint32_t i : assigned.of_block[b]) own.push_back(footprints[i]);
    auto t = tessellation.tessellate(found.blocks[b], own);
    if (!t) {
      EXPECT_EQ(t.error().code, FailureCode::kNoObservation) << t.error().message;
      continue;
    }
    ++tessellated;
    for (std::size_t k = 0; k < t->plots.size(); ++k) {
      const Polygon& footprint = own[t->footprint_of_plot[k]];
      if (locate(t->plots[k].shape, snap(interior_point(footprint))) != Side::kOutside) ++own_plot;
    }
    plots += t->plots.size();
    results.emplace_back(b, std::move(*t));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  for (const auto& [b, t] : results) expect_coverage(found.blocks[b], t);
  EXPECT_GT(tessellated, 100U);
  EXPECT_GT(plots, 8000U);
  EXPECT_GT(own_plot, plots * 98 / 100);
  EXPECT_LT(seconds.count(), 60.0);
  RecordProperty("plots", static_cast<int>(plots));
  fmt::print(
      "{} blocks, {} tessellated, {} footprints, {} plots, {} hold their footprint, {:.2f} s\n",
      found.blocks.size(), tessellated, footprints.size(), plots, own_plot, seconds.count());
}

}  // namespace
}  // namespace plat::footprints
