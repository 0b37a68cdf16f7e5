#include "similarity/merged_similarity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "similarity/made_tiles.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using testing::cell;
using testing::iterations;
using testing::made_tiles;
using testing::property_rng;
using Indices = std::vector<std::uint32_t>;

/// Half the usual bound on removals: a U of five cells would be a block of six else.
AnyShapeSimilarity measure() {
  return shape_similarities().make("affine_vertex", {{"area_loss_01", 0.05}});
}

ShapeNeighbourhood alone(double x, double y, double length, double width) {
  return ShapeNeighbourhood(
      {{{{{x, y}, {x + length, y}, {x + length, y + width}, {x, y + width}}, {}}, {}, ""}});
}

/// A row of cells.
ShapeNeighbourhood row(int count) {
  std::vector<LabelledShape> cells;
  for (int i = 0; i < count; ++i) cells.push_back(cell(i, 0));
  return ShapeNeighbourhood(std::move(cells));
}

TEST(MergedSimilarity, FindsTheManyThatAreLikeOne) {
  const ShapeNeighbourhood cells = row(6);
  const ShapeNeighbourhood place = alone(100, 50, 30, 10);
  const auto many = compare_merged(measure(), cells, 0, place, 0, {});
  ASSERT_TRUE(many);
  EXPECT_NEAR(many->comparison.distance, 0.0, 1e-12);
  EXPECT_EQ(many->a.shapes, (Indices{0, 1, 2}));
  EXPECT_EQ(many->b.shapes, (Indices{0}));
  EXPECT_DOUBLE_EQ(area_m2(many->a.shape.polygon), 300.0);
  // And the one for many.
  const auto one = compare_merged(measure(), place, 0, cells, 0, {});
  ASSERT_TRUE(one);
  EXPECT_NEAR(one->comparison.distance, 0.0, 1e-12);
  EXPECT_EQ(one->a.shapes, (Indices{0}));
  EXPECT_EQ(one->b.shapes, (Indices{0, 1, 2}));
  ASSERT_TRUE(one->comparison.transformation);
  const Point image = (*one->comparison.transformation)({115, 55});
  EXPECT_NEAR(distance(image, {15, 5}), 0.0, 1e-9);
}

TEST(MergedSimilarity, AFittingPairIsNotMerged) {
  const auto pair = compare_merged(measure(), row(3), 1, alone(0, 0, 10, 10), 0, {});
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->a.shapes, (Indices{1}));
  EXPECT_EQ(pair->a.shape.polygon, cell(1, 0).polygon);
}

TEST(MergedSimilarity, StopsWhereTheUnionIsSufficientlyLarger) {
  const ShapeNeighbourhood cells = row(6);
  const ShapeNeighbourhood place = alone(0, 0, 20, 10);
  const auto unions = [&](double stop_area_ratio) {
    return compare_merged(measure(), cells, 0, place, 0,
                          {.stop_area_ratio = stop_area_ratio, .max_shapes = 6})
        ->unions_compared;
  };
  EXPECT_EQ(unions(1.0), 1U);   // 0 1
  EXPECT_EQ(unions(1.01), 2U);  // and 0 1 2
  EXPECT_EQ(unions(2.5), 4U);   // up to 0 1 2 3 4
  EXPECT_EQ(compare_merged(measure(), cells, 0, place, 0, {.stop_area_ratio = 9, .max_shapes = 3})
                ->unions_compared,
            2U);
}

TEST(MergedSimilarity, DoesNotMergeWhereAreasDifferTooMuch) {
  const ShapeNeighbourhood cells = row(6);
  const ShapeNeighbourhood large = alone(0, 0, 30, 10);
  const auto unions = [&](double max_area_ratio) {
    const auto found = compare_merged(measure(), cells, 0, large, 0,
                                      {.max_area_ratio = max_area_ratio, .stop_area_ratio = 10});
    return found->unions_compared + found->unions_refused;
  };
  EXPECT_EQ(unions(2.9), 0U);
  EXPECT_EQ(unions(3.1), 5U);
  // A neighbour that is too large is not taken.
  const ShapeNeighbourhood uneven(
      {cell(0, 0), {{{{10, 0}, {500, 0}, {500, 10}, {10, 10}}, {}}, {}, ""}});
  EXPECT_EQ(compare_merged(measure(), uneven, 0, alone(0, 0, 20, 10), 0, {})->unions_compared, 0U);
}

TEST(MergedSimilarity, AUnionDoesNotHoldTheOtherShape) {
  // A cell, the lot of three cells beside it, and nothing else to grow into.
  const ShapeNeighbourhood two(
      {cell(0, 0), {{{{10, 0}, {40, 0}, {40, 10}, {10, 10}}, {}}, {}, ""}});
  const MergeOptions options{.stop_area_ratio = 10};
  EXPECT_EQ(compare_merged(measure(), two, 0, two, 1, options)->unions_compared, 0U);
  EXPECT_EQ(compare_merged(measure(), two, 1, two, 0, options)->unions_compared, 0U);
  // Another object is another place.
  const ShapeNeighbourhood copy = two;
  EXPECT_EQ(compare_merged(measure(), two, 0, copy, 1, options)->unions_compared, 1U);
}

TEST(MergedSimilarity, SaysWhenNotAllUnionsWereLookedAt) {
  std::vector<LabelledShape> cells;
  for (int i = 0; i < 25; ++i) cells.push_back(cell(i % 5, i / 5));
  const ShapeNeighbourhood block(std::move(cells));
  const ShapeNeighbourhood place = alone(0, 0, 30, 20);
  const auto some = compare_merged(measure(), block, 12, place, 0, {.max_unions = 10});
  EXPECT_FALSE(some->is_complete);
  EXPECT_EQ(some->unions_compared + some->unions_refused, 10U);
  const auto all = compare_merged(measure(), block, 12, place, 0, {.max_unions = 100000});
  EXPECT_TRUE(all->is_complete);
  EXPECT_NEAR(all->comparison.distance, 0.0, 1e-12);
  EXPECT_EQ(all->a.shapes.size(), 6U);
}

/// Every connected set of at most `max_size` shapes with `seed`, without `excluded`.
std::set<Indices> connected_sets(const ShapeNeighbourhood& tiles, std::uint32_t seed,
                                 std::uint32_t excluded, std::size_t max_size) {
  std::set<Indices> out{{seed}};
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (const Indices& set : std::set<Indices>(out)) {
      if (set.size() == max_size) continue;
      for (const std::uint32_t member : set) {
        for (const std::uint32_t other : tiles.neighbours(member)) {
          if (other == excluded || std::ranges::find(set, other) != set.end()) continue;
          Indices larger = set;
          larger.push_back(other);
          std::ranges::sort(larger);
          is_new = out.insert(larger).second || is_new;
        }
      }
    }
  }
  return out;
}

TEST(MergedSimilarity, IsTheBestOfAllUnions) {
  Rng rng = property_rng("merged_similarity_oracle");
  int merged = 0;
  for (int i = 0; i < iterations(15); ++i) {
    const ShapeNeighbourhood tiles(made_tiles(rng, 4, 3));
    const auto a = static_cast<std::uint32_t>(rng.index(12));
    const auto b = static_cast<std::uint32_t>(rng.index(12));
    if (a == b) continue;
    // No stop rules but the number of shapes.
    const MergeOptions options{
        .max_area_ratio = 1e6, .stop_area_ratio = 1e3, .max_shapes = 3, .max_unions = 10000};
    const auto found = compare_merged(measure(), tiles, a, tiles, b, options);
    ASSERT_TRUE(found);
    const bool is_a_smaller = area_m2(tiles.shape(a).polygon) <= area_m2(tiles.shape(b).polygon);
    double best = std::numeric_limits<double>::infinity();
    for (const Indices& set :
         connected_sets(tiles, is_a_smaller ? a : b, is_a_smaller ? b : a, 3)) {
      std::vector<const LabelledShape*> shapes;
      for (const std::uint32_t t : set) shapes.push_back(&tiles.shape(t));
      const auto shape = union_of(shapes);
      if (!shape) continue;
      const auto grown = measure().prepare(*shape);
      const auto other = measure().prepare(tiles.shape(is_a_smaller ? b : a));
      best = std::min(best, is_a_smaller ? measure().distance(*grown, *other)
                                         : measure().distance(*other, *grown));
    }
    EXPECT_EQ(found->comparison.distance, best);
    merged += found->a.shapes.size() + found->b.shapes.size() > 2 ? 1 : 0;
    const auto pair = measure().distance(measure().prepare(tiles.shape(a)).value(),
                                         measure().prepare(tiles.shape(b)).value());
    EXPECT_LE(found->comparison.distance, pair);
  }
  EXPECT_GE(merged, 1);
}

}  // namespace
}  // namespace plat::similarity
