#include "harness/subdivision.h"

#include <gtest/gtest.h>

#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::harness {
namespace {

std::vector<blocks::Block> some_blocks(const std::string& name) {
  Rng rng = testing::property_rng(name);
  std::vector<blocks::Block> out;
  for (Polygon& shape : testing::synthetic_blocks(rng, 40)) {
    const BlockId id{static_cast<std::uint32_t>(out.size())};
    out.push_back(blocks::block_from_contour(id, std::move(shape)));
  }
  return out;
}

std::vector<DividedBlock> divide(const std::vector<blocks::Block>& blocks,
                                 const StrategyConfig& strategy,
                                 std::span<const parcels::ParcelStyle> styles, int jobs,
                                 int repetition = 0, std::uint64_t seed = 1) {
  Progress progress("test", blocks.size());
  return subdivide_blocks(blocks, strategy, styles, "set", seed, repetition, Jobs{jobs}, progress);
}

StrategyConfig strategy_named(const std::string& name) { return {name, name, {}, Fit::kPerBlock}; }

void expect_same(const std::vector<DividedBlock>& a, const std::vector<DividedBlock>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].seed, b[i].seed);
    EXPECT_EQ(a[i].options, b[i].options);
    ASSERT_EQ(a[i].parcels.has_value(), b[i].parcels.has_value());
    if (a[i].parcels) {
      EXPECT_EQ(*a[i].parcels, *b[i].parcels);
      EXPECT_EQ(a[i].measures, b[i].measures);
    }
  }
}

TEST(SubdivideBlocks, DoesNotDependOnTheNumberOfThreads) {
  const auto blocks = some_blocks("Subdivision.Threads");
  for (const std::string& name : parcels::block_subdividers().names()) {
    const auto one = divide(blocks, strategy_named(name), {}, 1);
    expect_same(one, divide(blocks, strategy_named(name), {}, 2));
    expect_same(one, divide(blocks, strategy_named(name), {}, 4));
  }
}

TEST(SubdivideBlocks, GivesABlockTheSameStreamForEveryStrategyAndAnotherPerRepetition) {
  const auto blocks = some_blocks("Subdivision.Seeds");
  const auto obb = divide(blocks, strategy_named("obb"), {}, 1);
  const auto voronoi = divide(blocks, strategy_named("voronoi"), {}, 1);
  const auto again = divide(blocks, strategy_named("obb"), {}, 1, 1);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    EXPECT_EQ(obb[i].seed, voronoi[i].seed);
    EXPECT_NE(obb[i].seed, again[i].seed);
  }
}

TEST(SubdivideBlocks, KeepsABlocksStreamWhenOtherBlocksGo) {
  auto blocks = some_blocks("Subdivision.Subset");
  const auto all = divide(blocks, strategy_named("obb"), {}, 1);
  blocks.erase(blocks.begin());
  const auto fewer = divide(blocks, strategy_named("obb"), {}, 1);
  for (std::size_t i = 0; i < fewer.size(); ++i) EXPECT_EQ(*fewer[i].parcels, *all[i + 1].parcels);
}

TEST(SubdivideBlocks, FitsToTheStyleUnlessAnOptionIsGiven) {
  const auto blocks = some_blocks("Subdivision.Fit");
  const std::vector<parcels::ParcelStyle> styles(blocks.size(), {12, 500.0, 100.0, 15.0, 3.0});
  StrategyConfig strategy = strategy_named("voronoi");
  EXPECT_EQ(divide(blocks, strategy, styles, 1)[0].options.at("area_mean_m2"), OptionValue(500.0));
  strategy.options = {{"area_mean_m2", 250.0}};
  EXPECT_EQ(divide(blocks, strategy, styles, 1)[0].options.at("area_mean_m2"), OptionValue(250.0));
  strategy.options.clear();
  strategy.fit = Fit::kNone;
  EXPECT_NE(divide(blocks, strategy, styles, 1)[0].options.at("area_mean_m2"), OptionValue(500.0));
}

TEST(SubdivideBlocks, ABlockWithoutObservedParcelsIsAFailure) {
  const auto blocks = some_blocks("Subdivision.NoStyle");
  const std::vector<parcels::ParcelStyle> styles(blocks.size());
  for (const DividedBlock& block : divide(blocks, strategy_named("obb"), styles, 2)) {
    ASSERT_FALSE(block.parcels);
    EXPECT_EQ(block.parcels.error().code, FailureCode::kNoObservation);
  }
}

}  // namespace
}  // namespace plat::harness
