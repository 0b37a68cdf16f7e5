#include "similarity/shape_clusters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "made_measures.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using testing::random_rectangles;
using testing::rectangle;

LabelledShape triangle(double side, std::string zone = "") {
  return {{{{0, 0}, {side, 0}, {0, side}}, {}}, {}, std::move(zone)};
}

TEST(ShapeClusters, ByAreaOrByShapeAsTheWeightsSay) {
  const std::vector<LabelledShape> shapes{rectangle(10, 10), triangle(14), rectangle(100, 100),
                                          triangle(141)};
  ClusterOptions options{.percent = 50.0};
  options.area_weight = 1.0;
  options.corner_count_weight = options.mean_angle_weight = options.angle_deviation_weight = 0.0;
  const Clusters by_area = cluster_shapes(shapes, options, 1);
  EXPECT_EQ(by_area.cluster_of[0], by_area.cluster_of[1]);
  EXPECT_EQ(by_area.cluster_of[2], by_area.cluster_of[3]);
  EXPECT_NE(by_area.cluster_of[0], by_area.cluster_of[2]);
  options.area_weight = 0.0;
  options.corner_count_weight = options.angle_deviation_weight = 1.0;
  const Clusters by_shape = cluster_shapes(shapes, options, 1);
  EXPECT_EQ(by_shape.cluster_of[0], by_shape.cluster_of[2]);
  EXPECT_EQ(by_shape.cluster_of[1], by_shape.cluster_of[3]);
  EXPECT_NE(by_shape.cluster_of[0], by_shape.cluster_of[1]);
}

TEST(ShapeClusters, AZoneAndALogAreaWeighWhatTheirWeightsSay) {
  // A shape with the area of one group and the zone of another goes where the descriptor's distance
  // is less: to the zone at 0.8 of the zone's weight, to the area at 1.5 of it.
  for (const double difference : {1.6, 3.0}) {
    std::vector<LabelledShape> shapes{rectangle(10, 10, "a")};
    for (int i = 0; i < 10; ++i) {
      shapes.push_back(rectangle(10, 10, "b"));
      shapes.push_back(rectangle(10 * std::exp(difference), 10, "a"));
    }
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Clusters clusters =
          cluster_shapes(shapes, {.percent = 10.0, .zone_weight = 2.0, .area_weight = 1.0}, seed);
      ASSERT_EQ(clusters.members.size(), 2U);
      EXPECT_EQ(clusters.cluster_of[0], clusters.cluster_of[difference < 2.0 ? 2 : 1]);
    }
  }
}

TEST(ShapeClusters, KeepZonesApartWhereTheyWeighMuch) {
  Rng rng = ::plat::testing::property_rng("ShapeClustersZones");
  const auto shapes = random_rectangles(200, rng);
  const Clusters clusters = cluster_shapes(shapes, {.percent = 5.0, .zone_weight = 50.0}, 3);
  EXPECT_EQ(clusters.members.size(), 10U);
  for (const auto& members : clusters.members) {
    std::set<std::string> zones;
    for (const std::uint32_t i : members) zones.insert(shapes[i].zone);
    EXPECT_EQ(zones.size(), 1U);
  }
}

TEST(ShapeClusters, AnUnknownZoneIsBetweenAllZones) {
  // One shape in three zones and none: the unknown one is nearer to each than they are to another.
  const std::vector<LabelledShape> shapes{rectangle(9, 9, "a"), rectangle(9, 9, "b"),
                                          rectangle(9, 9, "c"), rectangle(9, 9)};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Clusters clusters = cluster_shapes(shapes, {.percent = 75.0}, seed);
    ASSERT_EQ(clusters.members.size(), 3U);
    EXPECT_EQ(clusters.members[clusters.cluster_of[3]].size(), 2U) << seed;
  }
}

TEST(ShapeClusters, AreTheSameForOneSeedAndAnyNumberOfThreads) {
  Rng rng = ::plat::testing::property_rng("ShapeClustersThreads");
  const auto shapes = random_rectangles(600, rng);
  const Clusters one = cluster_shapes(shapes, {.percent = 5.0}, 3, Jobs{1});
  EXPECT_EQ(one, cluster_shapes(shapes, {.percent = 5.0}, 3, Jobs{2}));
  EXPECT_NE(one, cluster_shapes(shapes, {.percent = 5.0}, 4));
}

}  // namespace
}  // namespace plat::similarity
