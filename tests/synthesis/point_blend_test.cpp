#include "synthesis/point_blend.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "support/property.h"
#include "synthesis/made_points.h"
#include "synthesis/point_placement.h"

namespace plat::synthesis {
namespace {

using testing::grid_points;
using testing::made_point;
using testing::MadeStyle;
using testing::scattered_points;

constexpr MadeStyle kGridStyle{.distance_m = 100.0, .width_m = 16.0, .parcel_area_m2 = 800.0};
constexpr MadeStyle kWildStyle{.distance_m = 60.0,
                               .tortuosity = 1.2,
                               .angle_rad = 0.5,
                               .width_m = 8.0,
                               .parcel_area_m2 = 200.0};

/// A grid and as wild a set as there is, over the same square.
struct Examples {
  PointSet grid = grid_points(13, 13, 100.0, {}, kGridStyle);
  PointSet wild;

  explicit Examples(Rng& rng, int count = 300) {
    wild = scattered_points(rng, count - 4, {0, 0}, {1200, 1200}, kWildStyle);
    for (const Point corner : {Point{0, 0}, Point{1200, 0}, Point{0, 1200}, Point{1200, 1200}}) {
      wild.push_back(made_point(corner, kWildStyle));
    }
  }
};

PointSet blend_at(const Examples& examples, double weight_01, std::uint64_t seed,
                  BlendPositions positions = BlendPositions::kThinned) {
  Rng rng(seed);
  return blend(examples.grid, examples.wild, ConstantWeight{weight_01}, {.positions = positions},
               rng);
}

double mean_of(const PointSet& points, double (*value)(const streets::IntersectionPoint&)) {
  double sum = 0.0;
  for (const streets::IntersectionPoint& point : points) sum += value(point);
  return sum / static_cast<double>(points.size());
}

constexpr std::array kAttributes{
    +[](const streets::IntersectionPoint& p) { return p.a.distance_mean_m; },
    +[](const streets::IntersectionPoint& p) { return p.a.distance_variance_m2; },
    +[](const streets::IntersectionPoint& p) { return p.b->tortuosity; },
    +[](const streets::IntersectionPoint& p) { return p.a.angle_mean_rad; },
    +[](const streets::IntersectionPoint& p) { return p.b->angle_variance_rad2; },
    +[](const streets::IntersectionPoint& p) { return p.a.width_m; },
    +[](const streets::IntersectionPoint& p) { return *p.parcel_area_m2; }};

class BlendAt : public ::testing::TestWithParam<BlendPositions> {};

TEST_P(BlendAt, WeightZeroIsTheFirstSetAndOneTheSecond) {
  Rng rng = plat::testing::property_rng("Blend.Ends");
  const Examples examples(rng);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    EXPECT_EQ(blend_at(examples, 0.0, seed, GetParam()), examples.grid);
    EXPECT_EQ(blend_at(examples, 1.0, seed, GetParam()), examples.wild);
  }
}

TEST_P(BlendAt, AttributesLieBetweenAndMoveWithTheWeight) {
  Rng rng = plat::testing::property_rng("Blend.Attributes");
  const Examples examples(rng);
  for (const auto value : kAttributes) {
    const double grid = mean_of(examples.grid, value);
    const double wild = mean_of(examples.wild, value);
    for (int tenth = 0; tenth <= 10; ++tenth) {
      const double w = 0.1 * tenth;
      // Both sets have one style each, so every blended point has the same.
      EXPECT_NEAR(mean_of(blend_at(examples, w, 3, GetParam()), value), std::lerp(grid, wild, w),
                  1e-9 * (grid + wild));
    }
  }
}

TEST_P(BlendAt, CountLiesBetweenAndMovesWithTheWeight) {
  Rng rng = plat::testing::property_rng("Blend.Count");
  const Examples examples(rng, 200);
  std::size_t last = examples.grid.size();
  for (int tenth = 1; tenth <= 10; ++tenth) {
    const std::size_t count = blend_at(examples, 0.1 * tenth, 1, GetParam()).size();
    EXPECT_GE(count, last);
    EXPECT_NEAR(static_cast<double>(count), 169.0 + 0.1 * tenth * (200.0 - 169.0), 0.51);
    last = count;
  }
}

TEST_P(BlendAt, PointsOfTheTwoSetsKeepTheSpacing) {
  Rng rng = plat::testing::property_rng("Blend.Spacing");
  const Examples examples(rng);
  const Spacing spacing;
  int compared = 0;
  for (const double w : {0.2, 0.5, 0.8}) {
    const PointSet points = blend_at(examples, w, 9, GetParam());
    // A point's own width is 16 m in the grid, 8 m elsewhere: levels tell the sets apart.
    std::vector<std::uint32_t> of_grid;
    if (GetParam() == BlendPositions::kMorphed) continue;
    for (const streets::IntersectionPoint& p : points) {
      for (const streets::IntersectionPoint& q : points) {
        const bool p_is_grid = std::fmod(p.place.x, 100.0) == 0.0;
        const bool q_is_grid = std::fmod(q.place.x, 100.0) == 0.0;
        if (p_is_grid == q_is_grid) continue;
        ++compared;
        ASSERT_GE(distance(p.place, q.place), spacing.between_m(100.0, 60.0));
      }
    }
  }
  EXPECT_TRUE(compared > 1000 || GetParam() == BlendPositions::kMorphed);
}

TEST_P(BlendAt, LeavesNoHoleInTheRegion) {
  Rng rng = plat::testing::property_rng("Blend.Coverage");
  const Examples examples(rng);
  for (const double w : {0.25, 0.5, 0.75}) {
    const PointSet points = blend_at(examples, w, 4, GetParam());
    double farthest_m = 0.0;
    for (double x = 100; x <= 1100; x += 20) {
      for (double y = 100; y <= 1100; y += 20) {
        double nearest_m = 1e9;
        for (const auto& p : points) nearest_m = std::min(nearest_m, distance(p.place, {x, y}));
        farthest_m = std::max(farthest_m, nearest_m);
      }
    }
    // Random places alone leave 180 m here.
    EXPECT_LT(farthest_m, 200.0) << "at weight " << w;
  }
}

TEST_P(BlendAt, SameStreamSamePoints) {
  Rng rng = plat::testing::property_rng("Blend.Same");
  const Examples examples(rng);
  EXPECT_EQ(blend_at(examples, 0.4, 7, GetParam()), blend_at(examples, 0.4, 7, GetParam()));
  EXPECT_NE(blend_at(examples, 0.4, 7, GetParam()), blend_at(examples, 0.4, 8, GetParam()));
}

TEST_P(BlendAt, RigidMotionOfBothMovesTheBlendAlong) {
  Rng rng = plat::testing::property_rng("Blend.Motion");
  Examples examples(rng);
  // Nothing exactly in the middle: a place on the line between two leaves may fall to either.
  examples.grid = grid_points(13, 13, 100.0, {0.3, 0.7}, kGridStyle);
  const Placement motion{.rotation_rad = 0.7, .translation = {3000, -100}};
  const RampWeight ramp{{100, 100}, {900, 1100}};
  const RampWeight moved_ramp{placed(ramp.from, motion), placed(ramp.to, motion)};
  // A crossing of the grid may be as far from two seeds of patches: each place by itself.
  const BlendOptions options{.positions = GetParam(), .patch_places = 1};
  Rng first(5);
  Rng second(5);
  const PointSet moved = place(blend(examples.grid, examples.wild, ramp, options, first), motion);
  const PointSet of_moved = blend(place(examples.grid, motion), place(examples.wild, motion),
                                  moved_ramp, options, second);
  ASSERT_EQ(moved.size(), of_moved.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_LT(distance(moved[i].place, of_moved[i].place), 3.0 * kGridStep_m);
    EXPECT_NEAR(moved[i].a.distance_mean_m, of_moved[i].a.distance_mean_m, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Positions, BlendAt,
                         ::testing::Values(BlendPositions::kThinned, BlendPositions::kMorphed),
                         [](const auto& test) {
                           return test.param == BlendPositions::kThinned ? "thinned" : "morphed";
                         });

TEST(Blend, LevelsCorrespondByRankSoThatMeansAreLinear) {
  // Half of the grid's streets are main ones, a twentieth of the others', and widths follow levels.
  PointSet first = grid_points(20, 20, 50.0, {}, {.width_m = 20.0});
  for (streets::IntersectionPoint& point : first) point.b->width_m = 10.0;
  PointSet second = grid_points(20, 20, 50.0, {}, {.width_m = 30.0});
  for (std::size_t i = 0; i < second.size(); ++i) {
    second[i].b->width_m = 6.0;
    if (i % 10 == 0) continue;
    second[i].a.hierarchy = 1;
    second[i].a.width_m = 6.0;
  }
  const auto width = [](const streets::IntersectionPoint& p) {
    return 0.5 * (p.a.width_m + p.b->width_m);
  };
  EXPECT_NEAR(mean_of(first, width), 15.0, 1e-9);
  EXPECT_NEAR(mean_of(second, width), 7.2, 1e-9);
  for (const double w : {0.25, 0.5, 0.75}) {
    double mean = 0.0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      Rng rng(seed);
      mean += mean_of(blend(first, second, ConstantWeight{w}, {}, rng), width) / 50.0;
    }
    EXPECT_NEAR(mean, std::lerp(15.0, 7.2, w), 0.05);
  }
}

TEST(Blend, OutsideTheOverlapBothStayAsTheyAre) {
  const PointSet west = grid_points(8, 6, 100.0, {0, 0}, kGridStyle);
  const PointSet east = grid_points(10, 9, 60.0, {450, 10}, kWildStyle);
  Rng rng(2);
  const PointSet points = blend(west, east, ConstantWeight{0.5}, {}, rng);
  std::size_t unchanged = 0;
  for (const streets::IntersectionPoint& point : west) {
    if (point.place.x < 450) unchanged += std::ranges::count(points, point) == 1 ? 1U : 0U;
  }
  EXPECT_EQ(unchanged, 30u);
  for (const streets::IntersectionPoint& point : east) {
    if (point.place.x > 760) {
      EXPECT_EQ(std::ranges::count(points, point), 1);
    }
  }
}

TEST(Blend, WithoutOverlapIsAJoin) {
  const PointSet west = grid_points(4, 4, 100.0);
  const PointSet east = grid_points(4, 4, 100.0, {1000, 0});
  Rng rng(2);
  const PointSet points = blend(west, east, ConstantWeight{0.5}, {}, rng);
  PointSet both = west;
  both.insert(both.end(), east.begin(), east.end());
  EXPECT_EQ(points, both);
}

TEST(Blend, RampChangesTheStyleAlongItsAxisOnly) {
  const PointSet grid = grid_points(13, 13, 100.0, {}, kGridStyle);
  PointSet wild = grid_points(13, 13, 100.0, {}, kWildStyle);
  Rng rng(1);
  const PointSet points = blend(grid, wild, RampWeight{{0, 1000}, {0, 200}}, {}, rng);
  EXPECT_EQ(points.size(), 169u);
  for (const streets::IntersectionPoint& point : points) {
    const double w = std::clamp((1000.0 - point.place.y) / 800.0, 0.0, 1.0);
    EXPECT_NEAR(point.a.tortuosity, 1.0 + 0.2 * w, 1e-12);
    EXPECT_NEAR(point.a.width_m, 16.0 - 8.0 * w, 1e-12);
  }
}

TEST(Blend, OfCongruentSetsTakesOneOfEachPairOfPoints) {
  const PointSet grid = grid_points(13, 13, 100.0, {}, kGridStyle);
  PointSet shifted = grid_points(13, 13, 100.0, {}, kWildStyle);
  for (streets::IntersectionPoint& point : shifted) {
    if (point.place.x > 0 && point.place.x < 1200 && point.place.y > 0 && point.place.y < 1200) {
      point.place = point.place + Point{20, 10};
    }
  }
  Rng rng(1);
  EXPECT_EQ(blend(grid, shifted, ConstantWeight{0.5}, {}, rng).size(), 169u);
}

TEST(Blend, TakesOneOfEachPairThoughBothHadRoom) {
  const PointSet grid = grid_points(13, 13, 100.0, {}, kGridStyle);
  PointSet shifted = grid;
  for (streets::IntersectionPoint& point : shifted) {
    if (point.place.x > 0 && point.place.x < 1200 && point.place.y > 0 && point.place.y < 1200) {
      point.place = point.place + Point{40, 20};
    }
  }
  Rng rng(1);
  std::set<std::pair<double, double>> blocks;
  for (const auto& point : blend(grid, shifted, ConstantWeight{0.5}, {}, rng)) {
    blocks.emplace(std::floor(point.place.x / 100.0), std::floor(point.place.y / 100.0));
  }
  EXPECT_EQ(blocks.size(), 169u);
}

TEST(Blend, SharesOfTheSetsFollowTheWeight) {
  Rng rng = plat::testing::property_rng("Blend.Shares");
  PointSet first = scattered_points(rng, 1500, {0, 0}, {1000, 1000}, kGridStyle);
  PointSet second = scattered_points(rng, 1500, {0, 0}, {1000, 1000}, kWildStyle);
  for (streets::IntersectionPoint& point : first) point.a.connections = 1;
  const BlendOptions options{.spacing = {.share_01 = 0.0, .min_m = 0.0}, .patch_places = 1};
  const PointSet points = blend(first, second, RampWeight{{0, 0}, {1000, 0}}, options, rng);
  for (int strip = 0; strip < 5; ++strip) {
    double of_first = 0.0;
    double all = 0.0;
    for (const streets::IntersectionPoint& point : points) {
      if (std::floor(point.place.x / 200.0) != strip) continue;
      all += 1.0;
      of_first += point.a.connections == 1 ? 1.0 : 0.0;
    }
    EXPECT_NEAR(of_first / all, 0.9 - 0.2 * strip, 0.1) << "strip " << strip;
  }
}

TEST(Blend, FullWeightGoesBeforePointsOutsideTheOverlap) {
  const PointSet west = grid_points(9, 9, 100.0, {0, 0}, kGridStyle);
  // Its first column outside the overlap lies 10 m behind the last column of the other.
  const PointSet east = grid_points(9, 9, 90.0, {450, 0}, kGridStyle);
  Rng rng(2);
  const PointSet points = blend(west, east, ConstantWeight{0.0}, {}, rng);
  for (const streets::IntersectionPoint& point : west) {
    EXPECT_EQ(std::ranges::count(points, point), 1);
  }
}

TEST(Blend, PatchesAreTakenFromOneSetTogether) {
  const PointSet grid = grid_points(40, 40, 100.0, {}, kGridStyle);
  PointSet shifted = grid;
  for (streets::IntersectionPoint& point : shifted) {
    point.a.connections = 1;
    const bool is_inner =
        point.place.x > 0 && point.place.x < 3900 && point.place.y > 0 && point.place.y < 3900;
    if (is_inner) point.place = point.place + Point{10, 5};
  }
  // How often neighbours in a row are of one set.
  const auto agreement = [&](std::int64_t patch_places) {
    Rng rng(3);
    const PointSet points =
        blend(grid, shifted, ConstantWeight{0.5}, {.patch_places = patch_places}, rng);
    EXPECT_EQ(points.size(), 1600u);
    std::map<std::pair<double, double>, bool> is_first;
    for (const auto& p : points) {
      is_first[{std::floor(p.place.x / 100.0), std::floor(p.place.y / 100.0)}] =
          p.a.connections == 2;
    }
    double same = 0.0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 39; ++x) {
        same += is_first.at({1.0 * x, 1.0 * y}) == is_first.at({x + 1.0, 1.0 * y}) ? 1.0 : 0.0;
      }
    }
    return same / (39.0 * 40.0);
  };
  EXPECT_NEAR(agreement(1), 0.5, 0.06);
  EXPECT_GT(agreement(50), 0.8);
  EXPECT_GT(agreement(50), agreement(10));
}

TEST(Blend, MorphedPairsLieOnTheWay) {
  const PointSet grid = grid_points(13, 13, 100.0, {}, kGridStyle);
  PointSet shifted = grid;
  for (std::size_t i = 14; i < 25; ++i) shifted[i].place = shifted[i].place + Point{20, 12};
  Rng rng(1);
  const PointSet points =
      blend(grid, shifted, ConstantWeight{0.25}, {.positions = BlendPositions::kMorphed}, rng);
  ASSERT_EQ(points.size(), 169u);
  int on_the_way = 0;
  for (const streets::IntersectionPoint& point : points) {
    const Point offset{std::fmod(point.place.x, 100.0), std::fmod(point.place.y, 100.0)};
    on_the_way += offset == Point{5, 3} ? 1 : 0;
  }
  EXPECT_EQ(on_the_way, 11);
}

TEST(Blend, PointsAtOnePlaceComeAndGoTogether) {
  PointSet grid = grid_points(13, 13, 100.0, {}, kGridStyle);
  const std::size_t count = grid.size();
  for (std::size_t i = 0; i < count; ++i) grid.push_back(grid[i]);
  Rng rng(3);
  Rng wild(4);
  const Examples examples(wild);
  const PointSet points = blend(grid, examples.wild, ConstantWeight{0.5}, {}, rng);
  for (const streets::IntersectionPoint& point : points) {
    if (std::fmod(point.place.x, 100.0) != 0.0 || point.place.x == 0 || point.place.x == 1200)
      continue;
    EXPECT_EQ(std::ranges::count(points, point.place, &streets::IntersectionPoint::place), 2);
  }
}

TEST(Blend, KeepsWhatTheOtherSetDoesNotKnow) {
  PointSet grid = grid_points(5, 5, 100.0, {}, kGridStyle);
  PointSet other = grid_points(5, 5, 100.0, {}, kWildStyle);
  for (streets::IntersectionPoint& point : other) point.parcel_area_m2.reset();
  Rng rng(1);
  int of_grid = 0;
  for (const auto& point : blend(grid, other, ConstantWeight{0.5}, {.patch_places = 1}, rng)) {
    of_grid += point.parcel_area_m2 == 800.0 ? 1 : 0;
    EXPECT_TRUE(point.parcel_area_m2 == 800.0 || !point.parcel_area_m2);
  }
  EXPECT_GT(of_grid, 5);
}

TEST(Blend, EmptyAndSingleSets) {
  Rng rng(1);
  const PointSet grid = grid_points(5, 5, 100.0);
  EXPECT_TRUE(blend(PointSet{}, PointSet{}, ConstantWeight{}, {}, rng).empty());
  EXPECT_EQ(blend(grid, PointSet{}, ConstantWeight{}, {}, rng), grid);
  EXPECT_EQ(blend(PointSet{}, grid, ConstantWeight{}, {}, rng), grid);
  const PointSet one{made_point({200, 200})};
  EXPECT_EQ(blend(grid, one, ConstantWeight{0.0}, {}, rng), grid);
}

TEST(RampWeight, RunsFromZeroToOneAndNotFurther) {
  const RampWeight ramp{{0, 0}, {100, 0}};
  EXPECT_EQ(ramp({-50, 30}), 0.0);
  EXPECT_DOUBLE_EQ(ramp({25, -7}), 0.25);
  EXPECT_EQ(ramp({180, 0}), 1.0);
}

TEST(RampAcross, RunsOverTheOverlapFromTheFirstToTheSecond) {
  const PointQuadtree west(grid_points(9, 5, 100.0));
  const PointQuadtree east(grid_points(9, 5, 100.0, {600, 0}));
  const auto ramp = ramp_across(west, east);
  ASSERT_TRUE(ramp.has_value());
  EXPECT_NEAR((*ramp)({600, 100}), 0.0, 1e-9);
  EXPECT_NEAR((*ramp)({700, 333}), 0.5, 1e-9);
  EXPECT_NEAR((*ramp)({800, 0}), 1.0, 1e-9);
  const auto back = ramp_across(east, west);
  EXPECT_NEAR((*back)({650, 100}), 0.75, 1e-9);
}

TEST(RampAcross, NeedsAnOverlapAndADirection) {
  const PointQuadtree west(grid_points(9, 5, 100.0));
  EXPECT_FALSE(ramp_across(west, PointQuadtree(grid_points(9, 5, 100.0, {5000, 0}))).has_value());
  EXPECT_FALSE(ramp_across(west, west).has_value());
  EXPECT_FALSE(ramp_across(west, PointQuadtree(PointSet{})).has_value());
}

}  // namespace
}  // namespace plat::synthesis
