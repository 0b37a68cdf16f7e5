// `hybrid` and what experiments/block_style fitted for it.
#include "parcels/block_style.h"

#include <gtest/gtest.h>

#include <set>

#include "geodata/scratch_folder.h"
#include "harness/build_info.h"
#include "harness/csv.h"
#include "harness/experiment_config.h"
#include "parcels/hybrid_subdivider.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

std::string name_of(BlockStyle style) {
  HybridSubdivider::Options options;
  options.style = style;
  return std::get<std::string>(to_option_map(options).at("style"));
}

TEST(BlockStyleTree, IsWhatTheExperimentWrote) {
  harness::CsvTable table("node,feature,threshold,below,above,style,blocks");
  for (std::size_t i = 0; i < block_style_tree().size(); ++i) {
    const StyleNode& node = block_style_tree()[i];
    if (node.feature) {
      table.add_row(i, node.feature->name, node.threshold, node.below, node.above,
                    name_of(node.style), node.blocks);
    } else {
      table.add_row(i, "", "", "", "", name_of(node.style), node.blocks);
    }
  }
  const auto golden = harness::experiments_folder() / "block_style" / "tree.csv";
  EXPECT_EQ(table.text(), testing::bytes_of(golden.string()));
}

TEST(BlockStyleTree, ReachesEveryLeafAndEndsThere) {
  Rng rng = testing::property_rng("BlockStyle.Leaves");
  std::set<BlockStyle> answers;
  std::set<BlockStyle> leaves;
  for (const StyleNode& node : block_style_tree()) {
    if (!node.feature) leaves.insert(node.style);
  }
  for (int i = 0; i < 500; ++i) {
    ParcelStyle style{rng.index(6) + 1, 500.0, rng.uniform(0.0, 1500.0), 15.0,
                      rng.uniform(0.0, 20.0)};
    style.aspect_ratio_mean = rng.uniform(1.0, 3.0);
    answers.insert(block_style_of(style));
  }
  EXPECT_EQ(answers, leaves);
  EXPECT_NO_THROW(static_cast<void>(block_style_of({}))) << "a block without parcels";
}

TEST(BlockStyleTree, SplitsAtItsThresholds) {
  ParcelStyle style{3, 500.0, 0.0, 15.0, 0.0};
  EXPECT_EQ(block_style_of(style), BlockStyle::kVoronoi);
  style.aspect_ratio_mean = 2.0;
  EXPECT_EQ(block_style_of(style), BlockStyle::kRecursive);
  style.count = 4;
  EXPECT_EQ(block_style_of(style), BlockStyle::kMinBox);
  style.width_deviation_m = 0.5 * style.width_mean_m;
  EXPECT_EQ(block_style_of(style), BlockStyle::kRecursive);
  style.width_deviation_m = style.width_mean_m;
  EXPECT_EQ(block_style_of(style), BlockStyle::kMinBox);
  style.area_deviation_m2 = 2.0 * style.area_mean_m2;
  EXPECT_EQ(block_style_of(style), BlockStyle::kSkeleton);
}

TEST(HybridSubdivider, MakesTheParcelsOfTheStrategyThatItsStyleNames) {
  const harness::ExperimentConfig config = harness::read_config("block_style");
  const ParcelStyle style{14, 420.0, 110.0, 13.0, 3.0};
  const AnyBlockSubdivider hybrid = block_subdividers().make("hybrid");
  Rng draw = testing::property_rng("Hybrid.Same");
  for (Polygon& shape : testing::synthetic_blocks(draw, 10)) {
    const blocks::Block block = blocks::block_from_contour(BlockId{0}, std::move(shape));
    for (const harness::StrategyConfig& strategy : config.strategies) {
      OptionMap options = hybrid.fitted(style).options();
      options.insert_or_assign("style", strategy.name);
      Rng first(3);
      Rng second(3);
      const auto by_hybrid = block_subdividers().make("hybrid", options).subdivide(block, first);
      const auto by_itself = block_subdividers()
                                 .make(strategy.name, strategy.options)
                                 .fitted(style)
                                 .subdivide(block, second);
      ASSERT_TRUE(by_hybrid && by_itself);
      EXPECT_EQ(*by_hybrid, *by_itself) << strategy.name;
    }
  }
}

TEST(HybridSubdivider, FittedNamesTheStyleOfTheTree) {
  const ParcelStyle style{30, 400.0, 900.0, 15.0, 3.0, 2.0, 1.0, 1.0, 1.0};
  const OptionMap options = block_subdividers().make("hybrid").fitted(style).options();
  EXPECT_EQ(options.at("style"), OptionValue(name_of(block_style_of(style))));
  EXPECT_EQ(options.at("area_deviation_m2"), OptionValue(900.0));
}

}  // namespace
}  // namespace plat::parcels
