#include "parcels/partition.h"

#include <gtest/gtest.h>

#include "core/working_grid.h"
#include "parcels/coverage.h"
#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;

BlockPartition partition_of(const blocks::Block& block, const std::vector<Segment>& cuts) {
  return BlockPartition::cut(block, cuts).value();
}

void expect_coverage(const blocks::Block& block, const BlockPartition& partition) {
  const auto defect = find_coverage_defect(block.contour, partition.parcels(), kContourTolerance_m);
  EXPECT_FALSE(defect) << defect->message;
}

TEST(BlockPartition, WithoutCutsIsOneParcelWithTheBlocksContour) {
  const blocks::Block block = rectangle_block(40, 20);
  const auto parcels = partition_of(block, {}).parcels();
  ASSERT_EQ(parcels.size(), 1U);
  EXPECT_EQ(area_m2(parcels[0].shape), 800.0);
  EXPECT_EQ(parcels[0].shape.outer.size(), 4U);
}

TEST(BlockPartition, CutsBeyondTheBlockDoNoHarm) {
  const blocks::Block block = rectangle_block(40, 20);
  const BlockPartition partition =
      partition_of(block, {{{10, -5}, {10, 25}}, {{-50, 40}, {90, 40}}, {{50, -10}, {50, 30}}});
  ASSERT_EQ(partition.cell_count(), 2U);
  EXPECT_EQ(partition.area_m2(0) + partition.area_m2(1), 800.0);
  expect_coverage(block, partition);
}

TEST(BlockPartition, CutsThatDangleAreIgnored) {
  const blocks::Block block = rectangle_block(40, 20);
  const BlockPartition partition =
      partition_of(block, {{{10, 0}, {10, 15}}, {{20, 5}, {30, 5}}, {{30, 5}, {32, 9}}});
  EXPECT_EQ(partition.cell_count(), 1U);
  EXPECT_EQ(partition.parcels().front().shape.outer.size(), 4U) << "no vertex where it started";
}

TEST(BlockPartition, CutsAlongTheContourSeparateNothing) {
  const blocks::Block block = rectangle_block(40, 20);
  EXPECT_EQ(partition_of(block, {{{0, 0}, {40, 0}}, {{40, 5}, {40, 15}}}).cell_count(), 1U);
}

TEST(BlockPartition, CrossingCutsMakeFourCells) {
  const blocks::Block block = rectangle_block(40, 20);
  const BlockPartition partition = partition_of(block, {{{20, 0}, {20, 20}}, {{0, 10}, {40, 10}}});
  EXPECT_EQ(partition.cell_count(), 4U);
  expect_coverage(block, partition);
}

TEST(BlockPartition, LoopOfCutsInsideIsAnInnerCellNumberedLast) {
  const blocks::Block block = rectangle_block(40, 20);
  const BlockPartition partition = partition_of(
      block, {{{10, 5}, {20, 5}}, {{20, 5}, {20, 15}}, {{20, 15}, {10, 15}}, {{10, 15}, {10, 5}}});
  ASSERT_EQ(partition.cell_count(), 2U);
  EXPECT_EQ(partition.cell_area_m2(1), 100.0);
  EXPECT_EQ(partition.cell_polygon(0).holes.size(), 1U);
  EXPECT_EQ(partition.frontage_m(1), 0.0);
  expect_coverage(block, partition);
}

TEST(BlockPartition, RegionsAreNumberedAlongTheContour) {
  const blocks::Block block = rectangle_block(40, 20);
  const BlockPartition partition = partition_of(block, {{{10, 0}, {10, 20}}, {{30, 0}, {30, 20}}});
  ASSERT_EQ(partition.regions(), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(partition.area_m2(0), 200.0);
  EXPECT_EQ(partition.area_m2(1), 400.0);
  EXPECT_EQ(partition.area_m2(2), 200.0);
}

TEST(BlockPartition, BordersSumSharedLengthPerNeighbour) {
  const blocks::Block block = rectangle_block(40, 20);
  // A column of 10 m on the left, the rest in two rows of 5 and 15 m.
  const BlockPartition partition = partition_of(block, {{{10, 0}, {10, 20}}, {{10, 5}, {40, 5}}});
  ASSERT_EQ(partition.cell_count(), 3U);
  const auto borders = partition.borders(0);
  ASSERT_EQ(borders.size(), 2U);
  EXPECT_LT(borders[0].neighbour, borders[1].neighbour);
  EXPECT_EQ(borders[0].length_m + borders[1].length_m, 20.0);
  EXPECT_EQ(partition.area_m2(*partition.longest_neighbour(0)), 450.0);
}

TEST(BlockPartition, LongestNeighbourOfEqualsIsTheLowerNumber) {
  const blocks::Block block = rectangle_block(30, 20);
  const BlockPartition partition = partition_of(block, {{{10, 0}, {10, 20}}, {{20, 0}, {20, 20}}});
  EXPECT_EQ(partition.longest_neighbour(1), 0U);
}

TEST(BlockPartition, OnlyRegionHasNoNeighbour) {
  EXPECT_FALSE(partition_of(rectangle_block(30, 20), {}).longest_neighbour(0));
}

TEST(BlockPartition, FrontageCountsStreetEdgesOnly) {
  const blocks::Block block = testing::with_streets_on(rectangle_block(40, 20), {0, 3});
  const BlockPartition partition = partition_of(block, {{{10, 0}, {10, 20}}});
  EXPECT_EQ(partition.frontage_m(0), 10.0 + 20.0);
  EXPECT_EQ(partition.frontage_m(1), 30.0);
}

TEST(BlockPartition, JoinKeepsTheNumberAndAddsUp) {
  const blocks::Block block = rectangle_block(40, 20);
  BlockPartition partition = partition_of(block, {{{10, 0}, {10, 20}}, {{30, 0}, {30, 20}}});
  partition.join(2, 1);
  EXPECT_EQ(partition.regions(), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(partition.region_of_cell(1), 2U);
  EXPECT_EQ(partition.area_m2(2), 600.0);
  EXPECT_EQ(partition.frontage_m(2), 30.0 + 30.0 + 20.0);
  EXPECT_EQ(area_m2(partition.polygon(2)), 600.0);
  expect_coverage(block, partition);
}

TEST(BlockPartition, JoiningARegionToItselfIsOurFault) {
  BlockPartition partition = partition_of(rectangle_block(40, 20), {});
  EXPECT_THROW(partition.join(0, 0), LogicError);
}

TEST(BlockPartition, RegionsJoinedAroundAnotherHaveAHole) {
  const blocks::Block block = rectangle_block(30, 30);
  const std::vector<Segment> lattice{
      {{10, 0}, {10, 30}}, {{20, 0}, {20, 30}}, {{0, 10}, {30, 10}}, {{0, 20}, {30, 20}}};
  BlockPartition partition = partition_of(block, lattice);
  ASSERT_EQ(partition.cell_count(), 9U);
  for (std::uint32_t r = 1; r < 8; ++r) partition.join(0, r);
  const auto parcels = partition.parcels();
  ASSERT_EQ(parcels.size(), 2U);
  EXPECT_EQ(parcels[0].shape.holes.size(), 1U);
  EXPECT_EQ(parcels[0].shape.outer.size(), 4U) << "straight vertices of vanished cuts are gone";
  EXPECT_EQ(parcels[1].shape.outer.size(), 4U);
  expect_coverage(block, partition);
}

TEST(BlockPartition, StraightVertexIsDroppedOnBothSides) {
  const blocks::Block block = rectangle_block(20, 20);
  // The cut at y = 10 ends on the wall x = 10 from the right; joining its two sides frees that
  // vertex.
  BlockPartition partition = partition_of(block, {{{10, 0}, {10, 20}}, {{10, 10}, {20, 10}}});
  ASSERT_EQ(partition.cell_count(), 3U);
  const auto before = partition.parcels();
  EXPECT_EQ(before[0].shape.outer.size(), 5U) << "three boundaries meet: kept on the far side, too";
  const auto joined = partition.longest_neighbour(0).value();
  const std::uint32_t other = joined == 1 ? 2 : 1;
  partition.join(joined, other);
  for (const Parcel& parcel : partition.parcels()) EXPECT_EQ(parcel.shape.outer.size(), 4U);
  expect_coverage(block, partition);
}

TEST(BlockPartition, SliversJoinTheirLongestNeighbourSmallestFirst) {
  const blocks::Block block = rectangle_block(40, 10);
  BlockPartition partition =
      partition_of(block, {{{20, 0}, {20, 10}}, {{20.03125, 0}, {20.03125, 10}}});
  ASSERT_EQ(partition.cell_count(), 3U);
  partition.join_slivers(0.5);
  EXPECT_EQ(partition.regions().size(), 2U);
  EXPECT_EQ(partition.area_m2(partition.regions().front()), 200.3125);
  expect_coverage(block, partition);
}

TEST(BlockPartition, JoinWhileGoesOnUntilNoRegionIsNamed) {
  const blocks::Block block = rectangle_block(100, 10);
  const Segment cuts[] = {{{10, 0}, {10, 10}}, {{30, 0}, {30, 10}}, {{60, 0}, {60, 10}}};
  BlockPartition partition = BlockPartition::cut(block, cuts).value();
  partition.join_while([&](std::uint32_t region) { return partition.area_m2(region) < 350.0; });
  // 100 joins 200, the sum joins 300; 400 is not named.
  std::vector<double> areas;
  for (const std::uint32_t region : partition.regions()) areas.push_back(partition.area_m2(region));
  std::sort(areas.begin(), areas.end());
  EXPECT_EQ(areas, (std::vector{400.0, 600.0}));
}

TEST(BlockPartition, JoinWhileLeavesTheLastRegion) {
  const blocks::Block block = rectangle_block(100, 10);
  const Segment cuts[] = {{{10, 0}, {10, 10}}, {{30, 0}, {30, 10}}};
  BlockPartition partition = BlockPartition::cut(block, cuts).value();
  partition.join_while([](std::uint32_t) { return true; });
  EXPECT_EQ(partition.regions().size(), 1U);
}

TEST(BlockPartition, CourtyardIsNobodys) {
  blocks::Block block = blocks::block_from_contour(
      BlockId{},
      {{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{{10, 10}, {10, 20}, {20, 20}, {20, 10}}}});
  const BlockPartition partition = partition_of(block, {{{-5, 15}, {35, 15}}});
  ASSERT_EQ(partition.cell_count(), 2U);
  EXPECT_EQ(partition.area_m2(0) + partition.area_m2(1), 800.0);
  expect_coverage(block, partition);
}

TEST(BlockPartition, CutThatWouldCloseASpikeIsLeftOut) {
  // A spike one grid step wide at its tip: a cut's end inside it would round onto both sides.
  const double h = kGridStep_m;
  const blocks::Block block = blocks::block_from_contour(
      BlockId{}, {{{0, 0}, {50, 5}, {100, 5 + h}, {50, 5 + 2 * h}, {0, 20}}, {}});
  const auto partition = BlockPartition::cut(block, std::vector<Segment>{{{90, 0}, {90, 20}}});
  ASSERT_TRUE(partition) << partition.error().message;
  expect_coverage(block, *partition);
}

TEST(BlockPartition, RandomCutsOfRandomBlocksAreACoverageBeforeAndAfterJoining) {
  Rng rng = testing::property_rng("BlockPartition.Random");
  int cells = 0;
  int joins = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(150))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const Box box = box_of(block.contour).expanded(5.0);
    std::vector<Segment> cuts;
    const auto anywhere = [&] {
      return Point{rng.uniform(box.min.x, box.max.x), rng.uniform(box.min.y, box.max.y)};
    };
    for (int i = 0; i < 12; ++i) {
      const Point a = anywhere();
      cuts.push_back({a, anywhere()});
    }
    BlockPartition partition = partition_of(block, cuts);
    expect_coverage(block, partition);
    cells += static_cast<int>(partition.cell_count());
    for (std::size_t wanted = (partition.cell_count() + 1) / 2;
         partition.regions().size() > wanted;) {
      const auto regions = partition.regions();
      const std::uint32_t region = regions[rng.index(regions.size())];
      const auto neighbour = partition.longest_neighbour(region);
      ASSERT_TRUE(neighbour);
      partition.join(*neighbour, region);
      ++joins;
    }
    expect_coverage(block, partition);
    double sum = 0.0;
    for (const std::uint32_t r : partition.regions()) sum += area_m2(partition.polygon(r));
    ASSERT_NEAR(sum, area_m2(block.contour), kContourTolerance_m * perimeter_m(block.contour));
  }
  EXPECT_GT(cells, testing::iterations(150) * 8);
  EXPECT_GT(joins, testing::iterations(150) * 4);
}

}  // namespace
}  // namespace plat::parcels
