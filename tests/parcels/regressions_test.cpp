// Each test is a defect that was found and fixed, named after it.
#include <gtest/gtest.h>

#include <chrono>

#include "blocks/block.h"
#include "core/validity.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"

namespace plat::parcels {
namespace {

blocks::Block rectangle(double width_m, double height_m) {
  return blocks::block_from_contour(
      {0}, {{{0, 0}, {width_m, 0}, {width_m, height_m}, {0, height_m}}, {}});
}

Expected<std::vector<Parcel>> divide(const char* strategy, const OptionMap& options,
                                     const blocks::Block& block) {
  Rng rng(1);
  return block_subdividers().make(strategy, options).subdivide(block, rng);
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Regression, LotsFarTooSmallForTheBlockAreAFailureNotAFullMemory) {
  const blocks::Block district = rectangle(12000, 9000);
  const std::map<std::string, OptionMap> smallest{
      {"obb", {{"area_max_m2", 1.0}, {"width_max_m", 0.5}, {"street_access", 0.0}}},
      {"skeleton", {{"width_min_m", 0.0}, {"width_max_m", 0.5}}},
      {"voronoi", {{"area_mean_m2", 1.0}}},
      {"border_voronoi", {{"spacing_m", 0.5}}},
      {"min_box", {{"lot_width_m", 0.5}, {"lot_depth_m", 0.5}}},
      {"cube_packing", {{"lot_width_m", 0.5}}},
      {"parish_mueller", {{"area_max_m2", 1.0}}},
      {"recursive", {{"area_min_m2", 0.0}, {"area_max_m2", 1.0}, {"width_min_m", 0.0}}}};
  // A hybrid hands a block to one of the others.
  for (const std::string& name : block_subdividers().names())
    EXPECT_TRUE(smallest.contains(name) || name == "hybrid") << name;
  for (const auto& [name, options] : smallest) {
    const auto found = divide(name.c_str(), options, district);
    ASSERT_FALSE(found) << name;
    EXPECT_EQ(found.error().code, FailureCode::kNoConvergence) << name;
    EXPECT_NE(found.error().message.find("raise"), std::string::npos) << name;
  }
}

TEST(Regression, HundredsOfSlicesThatShareAGuideDoNotLieOnTopOfEachOther) {
  // One street on three sides: every slice turns into the ridge of the skeleton, towards the
  // fourth.
  blocks::Block block = rectangle(1000, 40);
  for (std::size_t i = 0; i < 4; ++i) block.edges[0][i].logical_street = i == 3 ? 1 : 0;
  const double seconds = seconds_of([&] {
    const auto parcels = divide(
        "skeleton", {{"area_min_m2", 0.0}, {"width_min_m", 1.5}, {"width_max_m", 1.5}}, block);
    ASSERT_TRUE(parcels);
    EXPECT_GT(parcels->size(), 500U);
    EXPECT_FALSE(find_coverage_defect(block.contour, *parcels, kContourTolerance_m));
  });
  EXPECT_LT(seconds, 5.0);
}

TEST(Regression, SlicesThatCrossAsALatticeAreBounded) {
  // Two sides face one street, two face none: the slices of both cross behind the others.
  blocks::Block block = rectangle(500, 400);
  for (std::size_t i = 0; i < 4; ++i) {
    block.edges[0][i] = {};
    if (i == 0 || i == 3) block.edges[0][i].logical_street = 0;
  }
  const auto found = divide("skeleton", {{"width_min_m", 0.0}, {"width_max_m", 0.5}}, block);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, FailureCode::kNoConvergence);
}

TEST(Regression, AContourThatPassesItsOwnVertexWithinAGridStepIsAFailure) {
  // The long edge runs 0.4 grid steps below the tip at (10, 0): noding bends it through the tip.
  constexpr double kStep = 1.0 / 1024.0;
  Polygon needle{{{-2, -kStep}, {18, 0}, {30, 15}, {17, 10}, {10, 0}, {8, 30}, {-20, 10}}, {}};
  ASSERT_FALSE(find_defect(needle)) << "strictly simple as it is";
  const blocks::Block block = blocks::block_from_contour({0}, needle);
  for (const std::string& name : block_subdividers().names()) {
    const auto found = divide(name.c_str(), {}, block);
    if (!found) {
      EXPECT_EQ(found.error().code, FailureCode::kNotSimple) << name;
      continue;
    }
    const auto defect = find_coverage_defect(block.contour, *found, kContourTolerance_m);
    EXPECT_FALSE(defect) << name << ": " << defect->message;
  }
}

TEST(Regression, CutsThatDrawTheContourOffItselfAreLeftOut) {
  // A spike 295 m long and 16 mm wide with a cut along it and many across: noding drew a side of
  // it two grid steps off, half a step more than a coverage may.
  blocks::Block block = blocks::block_from_contour(BlockId{}, {{{-598.2548828125, 1230.962890625},
                                                                {-478.716796875, 1374.0224609375},
                                                                {-700.05859375, 1569.7744140625},
                                                                {-478.7060546875, 1374.0341796875},
                                                                {-319.451171875, 1564.625},
                                                                {-555.5546875, 1761.9111328125},
                                                                {-834.359375, 1428.2490234375}},
                                                               {}});
  for (const std::size_t i : {1, 5, 6}) block.edges[0][i] = {};
  Rng rng(derive_seed(1, {19706}));
  const auto found = block_subdividers()
                         .make("recursive", {{"area_max_m2", 520.0827588264658},
                                             {"area_min_m2", 1.0},
                                             {"width_min_m", 2.2715721897198815}})
                         .subdivide(block, rng);
  ASSERT_TRUE(found);
  EXPECT_GT(found->size(), 100U);
  const auto defect = find_coverage_defect(block.contour, *found, kContourTolerance_m);
  EXPECT_FALSE(defect) << defect->message;
}

}  // namespace
}  // namespace plat::parcels
