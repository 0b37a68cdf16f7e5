// The contract of BlockSubdivider, over every registered strategy and many blocks.
#include <gtest/gtest.h>

#include "core/working_grid.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"
#include "parcels/exact_coverage.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

std::vector<blocks::Block> test_blocks(const std::string& name, int count) {
  Rng rng = testing::property_rng(name);
  std::vector<blocks::Block> out;
  for (Polygon& polygon : testing::synthetic_blocks(rng, count)) {
    out.push_back(blocks::block_from_contour(BlockId{static_cast<std::uint32_t>(out.size())},
                                             std::move(polygon)));
  }
  return out;
}

class BlockSubdividerContract : public ::testing::TestWithParam<std::string> {
 protected:
  const AnyBlockSubdivider subdivider_ = block_subdividers().make(GetParam());
};

TEST_P(BlockSubdividerContract, ParcelsAreACoverageOnTheGrid) {
  int divided = 0;
  const auto blocks = test_blocks("Contract.Coverage", testing::iterations(300));
  for (const blocks::Block& block : blocks) {
    Rng rng(derive_seed(1, {block.id.value}));
    const auto parcels = subdivider_.subdivide(block, rng);
    ASSERT_TRUE(parcels) << "block " << block.id.value << ": " << parcels.error().message;
    const auto defect = find_coverage_defect(block.contour, *parcels, kContourTolerance_m);
    EXPECT_FALSE(defect) << "block " << block.id.value << ": " << defect->message;
    for (std::size_t i = 0; i < parcels->size(); ++i) {
      ASSERT_EQ((*parcels)[i].id.value, i);
      ASSERT_GT(area_m2((*parcels)[i].shape), 0.0);
      for_each_edge((*parcels)[i].shape, [](const Segment& s) { ASSERT_TRUE(is_on_grid(s.a)); });
    }
    divided += parcels->size() > 1 ? 1 : 0;
  }
  EXPECT_GT(divided, static_cast<int>(blocks.size()) * 3 / 4)
      << "most blocks must really be divided";
}

TEST_P(BlockSubdividerContract, ParcelsAreACoverageByTheExactOracle) {
  int divided = 0;
  const auto blocks = test_blocks("Contract.Exact", testing::iterations(100));
  for (const blocks::Block& block : blocks) {
    Rng rng(derive_seed(2, {block.id.value}));
    const auto parcels = subdivider_.subdivide(block, rng);
    ASSERT_TRUE(parcels);
    const auto defect =
        testing::find_exact_coverage_defect(block.contour, *parcels, kContourTolerance_m);
    EXPECT_FALSE(defect) << "block " << block.id.value << ": " << *defect;
    divided += parcels->size() > 1 ? 1 : 0;
  }
  EXPECT_GT(divided, static_cast<int>(blocks.size()) * 3 / 4);
}

TEST_P(BlockSubdividerContract, SameStreamSameParcels) {
  for (const blocks::Block& block : test_blocks("Contract.Same", 40)) {
    Rng first(7);
    Rng second(7);
    EXPECT_EQ(*subdivider_.subdivide(block, first), *subdivider_.subdivide(block, second));
  }
}

TEST_P(BlockSubdividerContract, AnotherStreamGivesOtherParcels) {
  int differ = 0;
  const auto blocks = test_blocks("Contract.Other", 20);
  for (const blocks::Block& block : blocks) {
    Rng first(7);
    Rng second(8);
    differ += *subdivider_.subdivide(block, first) == *subdivider_.subdivide(block, second) ? 0 : 1;
  }
  EXPECT_GT(differ, static_cast<int>(blocks.size()) * 3 / 4);
}

TEST_P(BlockSubdividerContract, DoesNotModifyItsInput) {
  for (const blocks::Block& block : test_blocks("Contract.Input", 10)) {
    const blocks::Block before = block;
    Rng rng(7);
    ASSERT_TRUE(subdivider_.subdivide(block, rng));
    EXPECT_EQ(block.contour, before.contour);
    EXPECT_EQ(block.edges, before.edges);
  }
}

TEST_P(BlockSubdividerContract, TinyBlockIsOneParcelOrAFailure) {
  const Polygon tiny{{{0, 0}, {kGridStep_m, 0}, {0, kGridStep_m}}, {}};
  Rng rng(7);
  const auto parcels = subdivider_.subdivide(blocks::block_from_contour(BlockId{}, tiny), rng);
  if (parcels) {
    EXPECT_EQ(parcels->size(), 1U);
  }
}

TEST_P(BlockSubdividerContract, FittingKeepsWhatTheStyleSaysNothingOf) {
  const ParcelStyle style{12, 500.0, 100.0, 15.0, 3.0};
  const OptionMap before = subdivider_.options();
  const OptionMap after = subdivider_.fitted(style).options();
  ASSERT_EQ(before.size(), after.size());
  int changed = 0;
  for (const auto& [key, value] : before) changed += after.at(key) == value ? 0 : 1;
  EXPECT_GT(changed, 0);
  EXPECT_LT(changed, static_cast<int>(before.size()));
  EXPECT_NO_THROW(static_cast<void>(block_subdividers().make(GetParam(), after)))
      << "fitted options are within their ranges";
}

TEST_P(BlockSubdividerContract, FittedOptionsAreWithinTheirRangesForAnyStyle) {
  Rng rng = testing::property_rng("Contract.AnyStyle");
  for (int i = 0; i < testing::iterations(200); ++i) {
    const double area = std::exp(rng.uniform(-4.0, 13.0));
    const double width = std::exp(rng.uniform(-5.0, 6.0));
    const ParcelStyle style{rng.index(50) + 1, area, area * rng.uniform(0.0, 3.0), width,
                            width * rng.uniform(0.0, 3.0)};
    EXPECT_NO_THROW(static_cast<void>(
        block_subdividers().make(GetParam(), subdivider_.fitted(style).options())))
        << "area " << style.area_mean_m2 << " width " << style.width_mean_m;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, BlockSubdividerContract,
                         ::testing::ValuesIn(block_subdividers().names()),
                         [](const auto& each) { return each.param; });

struct NoVerb {};
static_assert(!BlockSubdivider<NoVerb>);

}  // namespace
}  // namespace plat::parcels
