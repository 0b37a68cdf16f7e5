#include "synthesis/point_quadtree.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <numeric>
#include <set>

#include "core/failure.h"
#include "support/property.h"
#include "synthesis/made_points.h"
#include "synthesis/point_placement.h"

namespace plat::synthesis {
namespace {

using testing::grid_points;
using testing::made_point;
using testing::MadeStyle;
using testing::scattered_points;

/// Points of which half lie in one corner: a set that has to be divided.
PointSet clustered_points(Rng& rng, int count) {
  PointSet out = scattered_points(rng, count / 2, {0, 0}, {2000, 1600});
  const PointSet dense = scattered_points(rng, count - count / 2, {1400, 1000}, {1900, 1500});
  out.insert(out.end(), dense.begin(), dense.end());
  return out;
}

/// Numbers for rapidcheck: a count and a seed, from which points are drawn.
PointSet any_points(int count, std::uint32_t seed) {
  Rng rng(seed);
  const bool is_clustered = rng.index(2) == 0;
  return is_clustered ? clustered_points(rng, count)
                      : scattered_points(rng, count, {-500, -500}, {900, 300});
}

RC_GTEST_PROP(PointQuadtree, LeavesDivideTheBox, (std::uint32_t seed)) {
  const PointSet points = any_points(*rc::gen::inRange(3, 400), seed);
  const PointQuadtree tree(points);
  double area = 0.0;
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    if (tree.nodes()[i].is_leaf()) area += area_m2(Polygon{tree.corners(i), {}});
  }
  RC_ASSERT(std::abs(area - tree.box().area_m2()) <= 1e-9 * tree.box().area_m2());
  // No overlap: a place lies inside one leaf only.
  Rng rng(seed);
  for (int k = 0; k < 20; ++k) {
    const Point half{0.5 * tree.box().length_m, 0.5 * tree.box().width_m};
    const Point p = tree.box().center + rng.uniform(-half.x, half.x) * tree.box().axis +
                    rng.uniform(-half.y, half.y) * perpendicular(tree.box().axis);
    int holders = 0;
    for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
      if (tree.nodes()[i].is_leaf() && locate(tree.corners(i), p) == Side::kInside) ++holders;
    }
    RC_ASSERT(holders == 1);
  }
}

RC_GTEST_PROP(PointQuadtree, EachPointIsInOneLeafThatHoldsIt, (std::uint32_t seed)) {
  const PointSet points = any_points(*rc::gen::inRange(1, 400), seed);
  const PointQuadtree tree(points);
  std::vector<int> holders(points.size(), 0);
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    if (!tree.nodes()[i].is_leaf()) continue;
    for (const std::uint32_t point : tree.nodes()[i].points) {
      ++holders[point];
      RC_ASSERT(tree.contains(points[point].place));
      RC_ASSERT(tree.path_to(points[point].place).back() == i);
      const Polygon rectangle{tree.corners(i), {}};
      RC_ASSERT(tree.nodes()[i].area_m2() == 0.0 ||
                locate(rectangle, points[point].place) == Side::kInside ||
                boundary_distance_m(rectangle, points[point].place) < 1e-6);
    }
  }
  RC_ASSERT(std::ranges::all_of(holders, [](int n) { return n == 1; }));
}

RC_GTEST_PROP(PointQuadtree, NodesKeepLeastAreaAndCount, (std::uint32_t seed)) {
  const QuadtreeOptions options{.min_area_m2 = *rc::gen::inRange(500, 100000) * 1.0,
                                .min_points = *rc::gen::inRange(1, 60)};
  const PointSet points = any_points(*rc::gen::inRange(1, 600), seed);
  const PointQuadtree tree(points, options);
  for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
    const QuadtreeNode& node = tree.nodes()[i];
    RC_ASSERT(i == 0 || node.area_m2() >= options.min_area_m2 * (1.0 - 1e-9));
    if (!node.is_leaf()) {
      RC_ASSERT(static_cast<std::int64_t>(node.points.size()) >= options.min_points);
    }
  }
}

RC_GTEST_PROP(PointQuadtree, LevelProbabilitiesSumToOne, (std::uint32_t seed)) {
  PointSet points = any_points(*rc::gen::inRange(1, 300), seed);
  Rng rng(seed);
  for (streets::IntersectionPoint& point : points) {
    point.a.hierarchy = static_cast<int>(rng.index(4));
    if (rng.index(3) == 0) point.b.reset();
  }
  const PointQuadtree tree(points);
  for (const QuadtreeNode& node : tree.nodes()) {
    double sum = 0.0;
    for (const LevelStyle& level : node.levels) sum += level.probability_01;
    const bool is_right = node.points.empty() ? node.levels.empty() : std::abs(sum - 1.0) < 1e-12;
    RC_ASSERT(is_right);
  }
}

TEST(PointQuadtree, TakesAGridAsUniformThoughItIsMoreEvenThanChance) {
  const PointQuadtree tree(grid_points(20, 20, 80.0));
  ASSERT_EQ(tree.leaf_count(), 1u);
  EXPECT_EQ(tree.nodes()[0].reason, LeafReason::kUniform);
}

TEST(PointQuadtree, DividesUniformPointsAsRarelyAsTheSignificanceSays) {
  Rng rng = plat::testing::property_rng("PointQuadtree.Significance");
  const int trials = plat::testing::iterations(600);
  int divided = 0;
  for (int i = 0; i < trials; ++i) {
    const PointQuadtree tree(scattered_points(rng, 200, {0, 0}, {1000, 1000}),
                             {.significance_01 = 0.05});
    divided += tree.leaf_count() > 1 ? 1 : 0;
  }
  // 5 per cent, give or take four standard errors and what the box of the sample itself adds.
  EXPECT_GT(divided, trials / 100);
  EXPECT_LT(divided, trials / 10);
}

TEST(PointQuadtree, DividesWhereDensityChanges) {
  PointSet points = grid_points(10, 20, 100.0);
  const PointSet dense = grid_points(40, 79, 25.0, {1000, 0});
  points.insert(points.end(), dense.begin(), dense.end());
  const PointQuadtree tree(points);
  ASSERT_GT(tree.leaf_count(), 1u);
  const double sparse = *tree.density_per_m2(tree.path_to({250, 450}).back());
  const double busy = *tree.density_per_m2(tree.path_to({1500, 450}).back());
  EXPECT_NEAR(sparse * 100.0 * 100.0, 1.0, 0.3);
  EXPECT_NEAR(busy * 25.0 * 25.0, 1.0, 0.1);
}

TEST(PointQuadtree, CountsPointsAtOnePlaceOnce) {
  PointSet points = grid_points(20, 20, 80.0);
  for (int i = 0; i < 300; ++i) points.push_back(points[17]);
  const PointQuadtree tree(points);
  EXPECT_EQ(tree.leaf_count(), 1u);
  EXPECT_NEAR(*tree.density_per_m2(0), 400.0 / (1520.0 * 1520.0), 1e-9);
}

TEST(PointQuadtree, StyleIsTheMeanInTheLeaf) {
  PointSet points = grid_points(20, 20, 50.0, {}, {.distance_m = 50.0, .parcel_area_m2 = 300.0});
  const PointSet others =
      grid_points(5, 5, 200.0, {1200, 0}, {.distance_m = 200.0, .parcel_area_m2 = 900.0});
  points.insert(points.end(), others.begin(), others.end());
  const PointQuadtree tree(points);
  ASSERT_GT(tree.leaf_count(), 1u);
  EXPECT_DOUBLE_EQ(tree.style_at({100, 100}, {})->distance_mean_m, 50.0);
  EXPECT_DOUBLE_EQ(tree.style_at({1900, 100}, {})->distance_mean_m, 200.0);
  EXPECT_DOUBLE_EQ(*tree.parcel_area_at_m2({100, 100}), 300.0);
  EXPECT_DOUBLE_EQ(*tree.parcel_area_at_m2({1900, 100}), 900.0);
  EXPECT_FALSE(tree.style_at({-5000, 0}, {}).has_value());
  EXPECT_FALSE(tree.ranks_at({-5000, 0}, 0).has_value());
}

TEST(PointQuadtree, RanksAreSharesInTheOrderOfLevels) {
  // Of eight streets one is of level 0, five of level 2, two of level 5.
  PointSet points = grid_points(4, 1, 50.0);
  const std::array<std::pair<int, int>, 4> levels{{{0, 2}, {2, 2}, {2, 5}, {2, 5}}};
  for (std::size_t i = 0; i < 4; ++i) {
    points[i].a.hierarchy = levels[i].first;
    points[i].b->hierarchy = levels[i].second;
    points[i].a.width_m = 10.0 * levels[i].first;
    points[i].b->width_m = 10.0 * levels[i].second;
  }
  const PointQuadtree tree(points);
  EXPECT_DOUBLE_EQ(tree.ranks_at({50, 0}, 0)->high_01, 0.125);
  EXPECT_DOUBLE_EQ(tree.ranks_at({50, 0}, 2)->low_01, 0.125);
  EXPECT_DOUBLE_EQ(tree.ranks_at({50, 0}, 2)->high_01, 0.75);
  EXPECT_DOUBLE_EQ(tree.ranks_at({50, 0}, 5)->high_01, 1.0);
  EXPECT_THROW(static_cast<void>(tree.ranks_at({50, 0}, 3)), LogicError);
  EXPECT_DOUBLE_EQ(tree.style_at({50, 0}, {0.0, 0.125})->width_m, 0.0);
  EXPECT_DOUBLE_EQ(tree.style_at({50, 0}, {0.25, 0.5})->width_m, 20.0);
  EXPECT_DOUBLE_EQ(tree.style_at({50, 0}, {0.5, 1.0})->width_m, 35.0);
  EXPECT_EQ(tree.style_at({50, 0}, {0.5, 1.0})->hierarchy, 2);
}

TEST(PointQuadtree, AnEmptyLeafHasTheStyleOfTheNodeAroundIt) {
  Rng rng = plat::testing::property_rng("PointQuadtree.Empty");
  PointSet points = scattered_points(rng, 200, {0, 0}, {400, 400}, {.width_m = 7.0});
  for (const Point corner : {Point{1600, 0}, Point{0, 1600}, Point{1600, 1600}}) {
    points.push_back(made_point(corner, {.width_m = 7.0}));
  }
  const PointQuadtree tree(points, {.min_points = 3});
  const std::vector<std::uint32_t> path = tree.path_to({700, 700});
  ASSERT_FALSE(path.empty());
  ASSERT_TRUE(tree.nodes()[path.back()].points.empty());
  EXPECT_DOUBLE_EQ(tree.style_at({700, 700}, {})->width_m, 7.0);
  EXPECT_DOUBLE_EQ(*tree.parcel_area_at_m2({700, 700}), 400.0);
}

TEST(PointQuadtree, ParcelAreaIsTheMeanOfThosePointsThatKnowOne) {
  PointSet points = grid_points(2, 2, 50.0);
  points[0].parcel_area_m2 = 1000.0;
  points[1].parcel_area_m2.reset();
  const PointQuadtree tree(points);
  EXPECT_DOUBLE_EQ(*tree.parcel_area_at_m2({10, 10}), 600.0);
  for (streets::IntersectionPoint& point : points) point.parcel_area_m2.reset();
  EXPECT_FALSE(PointQuadtree(points).parcel_area_at_m2({10, 10}).has_value());
}

TEST(PointQuadtree, DegenerateSetsAreOneLeaf) {
  EXPECT_TRUE(PointQuadtree(PointSet{}).nodes().empty());
  EXPECT_FALSE(PointQuadtree(PointSet{}).contains({0, 0}));
  EXPECT_TRUE(PointQuadtree(PointSet{}).path_to({0, 0}).empty());

  const PointQuadtree one(PointSet{made_point({5, 6})});
  EXPECT_EQ(one.leaf_count(), 1u);
  EXPECT_TRUE(one.contains({5, 6}));
  EXPECT_FALSE(one.density_per_m2(0).has_value());

  const PointQuadtree line(grid_points(100, 1, 30.0));
  EXPECT_EQ(line.leaf_count(), 1u);
  EXPECT_EQ(line.nodes()[0].reason, LeafReason::kMinArea);
  EXPECT_TRUE(line.contains({60, 0}));

  const PointSet coincident(50, made_point({5, 6}));
  const PointQuadtree heap(coincident, {.min_points = 1});
  EXPECT_EQ(heap.leaf_count(), 1u);
  EXPECT_EQ(heap.nodes()[0].points.size(), 50u);
}

TEST(PointQuadtree, RigidMotionMovesTheLeavesAlong) {
  Rng rng = plat::testing::property_rng("PointQuadtree.Motion");
  int divided = 0;
  for (int trial = 0; trial < plat::testing::iterations(20); ++trial) {
    const PointSet points = clustered_points(rng, 300);
    const Placement motion{.rotation_rad = rng.uniform(0, 6), .translation = {700, -90}};
    const PointQuadtree tree(points);
    const PointQuadtree moved(place(points, motion));
    ASSERT_EQ(tree.leaf_count(), moved.leaf_count());
    divided += tree.leaf_count() > 1 ? 1 : 0;
    std::multiset<std::vector<std::uint32_t>> leaves;
    std::multiset<std::vector<std::uint32_t>> moved_leaves;
    for (const QuadtreeNode& n : tree.nodes()) leaves.insert(n.points);
    for (const QuadtreeNode& n : moved.nodes()) moved_leaves.insert(n.points);
    EXPECT_EQ(leaves, moved_leaves);
  }
  EXPECT_GT(divided, 10);
}

}  // namespace
}  // namespace plat::synthesis
