// The contract of BlockSubdivider, over every registered strategy and many blocks.
#include <gtest/gtest.h>

#include "core/working_grid.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

std::vector<blocks::Block> test_blocks(const std::string& name, int count) {
  Rng rng = testing::property_rng(name);
  std::vector<blocks::Block> out;
  for (Polygon& polygon : testing::synthetic_blocks(rng, count)) {
    out.push_back(blocks::block_from_contour(BlockId{static_cast<std::uint32_t>(out.size())}, std::move(polygon)));
  }
  return out;
}

class BlockSubdividerContract : public ::testing::TestWithParam<std::string> {};

TEST_P(BlockSubdividerContract, ParcelsAreACoverageOnTheGrid) {
  const AnyBlockSubdivider subdivider = block_subdividers().make(GetParam());
  int divided = 0;
  const auto blocks = test_blocks("Contract.Coverage", testing::iterations(300));
  for (const blocks::Block& block : blocks) {
    Rng rng(derive_seed(1, {block.id.value}));
    const auto parcels = subdivider.subdivide(block, rng);
    ASSERT_TRUE(parcels) << GetParam() << " block " << block.id.value << ": " << failure_name(parcels.error().code) << ", " << parcels.error().message;
    const auto defect = find_coverage_defect(block.contour, *parcels, kContourTolerance_m);
    EXPECT_FALSE(defect) << GetParam() << " block " << block.id.value << ": " << defect->message;
    for (std::size_t i = 0; i < parcels->size(); ++i) {
      ASSERT_EQ((*parcels)[i].id.value, i);
      for_each_edge((*parcels)[i].shape, [](const Segment& s) { ASSERT_TRUE(is_on_grid(s.a)); });
    }
    divided += parcels->size() > 1 ? 1 : 0;
  }
  EXPECT_GT(divided, static_cast<int>(blocks.size()) * 3 / 4) << "most blocks must really be divided";
}

TEST_P(BlockSubdividerContract, SameStreamSameParcels) {
  const AnyBlockSubdivider subdivider = block_subdividers().make(GetParam());
  for (const blocks::Block& block : test_blocks("Contract.Same", 40)) {
    Rng first(7);
    Rng second(7);
    EXPECT_EQ(*subdivider.subdivide(block, first), *subdivider.subdivide(block, second));
  }
}

TEST_P(BlockSubdividerContract, FittingKeepsWhatTheStyleSaysNothingOf) {
  const ParcelStyle style{12, 500.0, 100.0, 15.0, 3.0};
  const AnyBlockSubdivider base = block_subdividers().make(GetParam());
  const OptionMap before = base.options();
  const OptionMap after = base.fitted(style).options();
  ASSERT_EQ(before.size(), after.size());
  int changed = 0;
  for (const auto& [key, value] : before) changed += after.at(key) == value ? 0 : 1;
  EXPECT_GT(changed, 0);
  EXPECT_LT(changed, static_cast<int>(before.size()));
  EXPECT_NO_THROW(block_subdividers().make(GetParam(), after)) << "fitted options are within their ranges";
}

INSTANTIATE_TEST_SUITE_P(Registry, BlockSubdividerContract, ::testing::ValuesIn(block_subdividers().names()));

struct NoVerb {};
static_assert(!BlockSubdivider<NoVerb>);

}  // namespace
}  // namespace plat::parcels
