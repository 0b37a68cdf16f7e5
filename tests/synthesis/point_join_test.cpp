#include "synthesis/point_join.h"

#include <gtest/gtest.h>

#include "support/property.h"
#include "synthesis/made_points.h"

namespace plat::synthesis {
namespace {

using testing::grid_points;
using testing::made_point;
using testing::scattered_points;

TEST(Join, PutsSetsSideBySideUnchanged) {
  const std::vector<PointSet> sets{grid_points(3, 3, 100.0), grid_points(2, 2, 80.0, {1000, 0})};
  const PointSet joined = join(sets);
  PointSet expected = sets[0];
  expected.insert(expected.end(), sets[1].begin(), sets[1].end());
  EXPECT_EQ(joined, expected);
}

TEST(Join, KeepsTheEarlierOfTwoThatAreTooNear) {
  const std::vector<PointSet> sets{{made_point({0, 0})},
                                   {made_point({34, 0}), made_point({36, 0})}};
  const PointSet joined = join(sets, {.share_01 = 0.35, .min_m = 5.0});
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_EQ(joined[0], sets[0][0]);
  EXPECT_EQ(joined[1], sets[1][1]);
}

TEST(Join, SpacingFollowsTheSmallerMeanDistance) {
  const std::vector<PointSet> sets{{made_point({0, 0}, {.distance_m = 40.0})},
                                   {made_point({16, 0}, {.distance_m = 400.0})}};
  EXPECT_EQ(join(sets, {.share_01 = 0.35, .min_m = 5.0}).size(), 2u);
  EXPECT_EQ(join(sets, {.share_01 = 0.35, .min_m = 17.0}).size(), 1u);
}

TEST(Join, LeavesPointsOfOneSetAlone) {
  const std::vector<PointSet> sets{{made_point({0, 0}), made_point({0, 0}), made_point({1, 0})}};
  EXPECT_EQ(join(sets).size(), 3u);
}

TEST(Join, OfASetWithItselfIsTheSet) {
  const PointSet points = grid_points(5, 4, 70.0);
  EXPECT_EQ(join(std::vector<PointSet>{points, points, points}), points);
}

TEST(Join, OfNothingIsNothing) {
  EXPECT_TRUE(join(std::vector<PointSet>{}).empty());
  EXPECT_EQ(join(std::vector<PointSet>{{}, grid_points(2, 1, 50.0), {}}).size(), 2u);
}

TEST(Join, AgreesWithComparingAllPairs) {
  Rng rng = plat::testing::property_rng("Join.BruteForce");
  int dropped = 0;
  for (int trial = 0; trial < plat::testing::iterations(30); ++trial) {
    std::vector<PointSet> sets;
    for (int s = 0; s < 3; ++s) {
      sets.push_back(
          scattered_points(rng, 60, {0, 0}, {900, 900}, {.distance_m = rng.uniform(10.0, 300.0)}));
    }
    const Spacing spacing{.share_01 = 0.5, .min_m = 12.0};
    PointSet expected;
    for (const PointSet& set : sets) {
      const std::size_t earlier = expected.size();
      for (const streets::IntersectionPoint& point : set) {
        bool is_free = true;
        for (std::size_t i = 0; i < earlier; ++i) {
          const double needed_m =
              spacing.between_m(mean_distance_m(point), mean_distance_m(expected[i]));
          is_free = is_free && distance(point.place, expected[i].place) >= needed_m;
        }
        if (is_free) expected.push_back(point);
        dropped += is_free ? 0 : 1;
      }
    }
    ASSERT_EQ(join(sets, spacing), expected);
  }
  EXPECT_GT(dropped, 100);
}

}  // namespace
}  // namespace plat::synthesis
