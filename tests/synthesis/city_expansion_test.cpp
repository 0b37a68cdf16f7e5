#include "synthesis/city_expansion.h"

#include <gtest/gtest.h>

#include "streets/growth_plane.h"
#include "streets/network_cleaning.h"
#include "synthesis/made_points.h"

namespace plat::synthesis {
namespace {

using testing::grid_points;
using testing::made_point;

/// Streets of a grid of blocks of 100 m, `size` by `size`, with a park of 4 by 4 blocks in it.
streets::StreetNetwork city_with_park(int size, int park_from, int park_to) {
  std::vector<streets::RawStreet> raw;
  const auto is_in_park = [&](double at) { return at > park_from && at < park_to; };
  const auto add = [&](Point a, Point b) {
    const Point middle = midpoint(a, b);
    if (is_in_park(middle.x) && is_in_park(middle.y)) return;
    streets::RawStreet street;
    street.line = {100.0 * a, 100.0 * b};
    street.attributes.street_class = "residential";
    street.source_id = std::to_string(raw.size());
    raw.push_back(street);
  };
  for (int i = 0; i <= size; ++i) {
    for (int k = 0; k < size; ++k) {
      add({1.0 * i, 1.0 * k}, {1.0 * i, k + 1.0});
      add({1.0 * k, 1.0 * i}, {k + 1.0, 1.0 * i});
    }
  }
  streets::CleanNetwork cleaned = streets::build_network(raw);
  for (streets::Street& street : cleaned.network.streets) street.width_m = 12.0;
  return cleaned.network;
}

const Polygon kPark{{{300, 300}, {700, 300}, {700, 700}, {300, 700}}, {}};

bool is_open(const Expansion& expansion, Point place) {
  return std::ranges::any_of(expansion.site.open_ends, [&](const streets::OpenEnd& end) {
    return expansion.site.existing.nodes[end.node] == place;
  });
}

TEST(Expand, FillsAParkAndOffersTheStreetsThatEndAtIt) {
  const streets::StreetNetwork city = city_with_park(10, 3, 7);
  const auto expansion = expand(city, {}, kPark, grid_points(5, 5, 100.0));
  ASSERT_TRUE(expansion.has_value());
  EXPECT_EQ(expansion->cut_streets, 0u);
  EXPECT_EQ(expansion->site.existing.streets.size(), city.streets.size());
  EXPECT_EQ(expansion->site.points.size(), 9u) << "the border row is too near to the streets";
  EXPECT_EQ(expansion->copies, 1u);
  for (const double at : {400.0, 500.0, 600.0}) {
    EXPECT_TRUE(is_open(*expansion, {300, at}));
    EXPECT_TRUE(is_open(*expansion, {at, 700}));
  }
  EXPECT_FALSE(is_open(*expansion, {1000, 500})) << "out of reach";
  EXPECT_EQ(*expansion->site.boundary, kPark);
  EXPECT_TRUE(streets::GrowthPlane::over(expansion->site).has_value());
}

TEST(Expand, CutsStreetsOfTheRegionAndLeavesTheirEndsOpen) {
  const streets::StreetNetwork city = city_with_park(10, 0, 0);
  const Polygon region{{{350, 350}, {650, 350}, {650, 650}, {350, 650}}, {}};
  const auto expansion = expand(city, {}, region, grid_points(5, 5, 50.0));
  ASSERT_TRUE(expansion.has_value());
  EXPECT_EQ(expansion->cut_streets, 24u);
  for (const double at : {400.0, 500.0, 600.0}) {
    for (const Point end : {Point{350, at}, Point{650, at}, Point{at, 350}, Point{at, 650}}) {
      EXPECT_TRUE(is_open(*expansion, end)) << end.x << " " << end.y;
    }
  }
  for (const streets::Street& street : expansion->site.existing.streets) {
    for (std::size_t i = 0; i + 1 < street.line.size(); ++i) {
      EXPECT_NE(locate(region, midpoint(street.line[i], street.line[i + 1])), Side::kInside);
    }
  }
  EXPECT_TRUE(streets::GrowthPlane::over(expansion->site).has_value());
}

TEST(Expand, RepeatsASmallExampleUntilTheRegionIsCovered) {
  const Polygon wide{{{0, 0}, {2000, 0}, {2000, 900}, {0, 900}}, {}};
  const auto expansion = expand({}, {}, wide, grid_points(4, 3, 50.0));
  ASSERT_TRUE(expansion.has_value());
  EXPECT_GT(expansion->copies, 100u);
  double farthest_m = 0.0;
  for (double x = 5; x < 2000; x += 10) {
    for (double y = 5; y < 900; y += 10) {
      double nearest_m = 1e9;
      for (const auto& p : expansion->site.points)
        nearest_m = std::min(nearest_m, distance(p.place, {x, y}));
      farthest_m = std::max(farthest_m, nearest_m);
    }
  }
  EXPECT_LT(farthest_m, 75.0);
  // Seams are no denser than the rest.
  EXPECT_NEAR(static_cast<double>(expansion->site.points.size()), 2000.0 * 900.0 / 2500.0, 60.0);
}

TEST(Expand, PointsKeepTheirClearanceAndStayInside) {
  const streets::StreetNetwork city = city_with_park(10, 3, 7);
  Rng rng(4);
  const PointSet example =
      testing::scattered_points(rng, 300, {0, 0}, {500, 500}, {.distance_m = 40.0});
  const auto expansion = expand(city, {}, kPark, example, {.clearance_share_01 = 0.75});
  ASSERT_TRUE(expansion.has_value());
  EXPECT_GT(expansion->site.points.size(), 100u);
  for (const streets::IntersectionPoint& point : expansion->site.points) {
    EXPECT_EQ(locate(kPark, point.place), Side::kInside);
    EXPECT_GE(boundary_distance_m(kPark, point.place), 30.0);
  }
}

TEST(Expand, ReachWidensTheBoundaryToStreetsAroundALooseRegion) {
  const streets::StreetNetwork city = city_with_park(10, 3, 7);
  const Polygon loose{{{320, 320}, {680, 320}, {680, 680}, {320, 680}}, {}};
  const auto without = expand(city, {}, loose, grid_points(3, 3, 100.0));
  EXPECT_TRUE(without->site.open_ends.empty());
  const auto with = expand(city, {}, loose, grid_points(3, 3, 100.0), {.reach_m = 25.0});
  EXPECT_TRUE(is_open(*with, {300, 500}));
  EXPECT_EQ(locate(*with->site.boundary, {300, 500}), Side::kInside);
  EXPECT_EQ(with->site.points, without->site.points);
}

TEST(Expand, AsPlacedLeavesTheExampleWhereItLies) {
  const PointSet example = grid_points(9, 9, 50.0, {310, 330});
  const auto expansion = expand({}, {}, kPark, example, {.copy_place = CopyPlace::kAsPlaced});
  std::size_t kept = 0;
  for (const auto& point : expansion->site.points) {
    kept += std::ranges::count(example, point.place, &streets::IntersectionPoint::place);
  }
  EXPECT_EQ(kept, 64u);
}

TEST(Expand, LoosensTheSeamAndOnlyTheSeam) {
  const streets::StreetNetwork city = city_with_park(10, 3, 7);
  const testing::MadeStyle style{.distance_m = 40.0, .hierarchy = 3};
  const auto expansion = expand(city, {}, kPark, grid_points(9, 9, 40.0, {}, style));
  ASSERT_TRUE(expansion.has_value());
  int loose = 0;
  int tight = 0;
  for (const streets::IntersectionPoint& point : expansion->site.points) {
    const bool is_seam = boundary_distance_m(kPark, point.place) < 1.5 * 40.0;
    EXPECT_DOUBLE_EQ(point.a.distance_variance_m2, is_seam ? 40.0 * 40.0 / 12.0 : 0.4);
    EXPECT_DOUBLE_EQ(point.b->angle_variance_rad2, is_seam ? 1.0 / 12.0 : 0.0);
    (is_seam ? loose : tight) += 1;
  }
  EXPECT_GT(loose, 10);
  EXPECT_GT(tight, 10);
  for (const streets::OpenEnd& end : expansion->site.open_ends) {
    EXPECT_EQ(end.street.hierarchy, 3) << "of 3 and 4, the nearest to the city's 0 to 2";
    EXPECT_DOUBLE_EQ(end.street.distance_mean_m, 40.0);
  }
}

TEST(Expand, RefusesARegionThatIsNoPolygon) {
  const Polygon bow_tie{{{0, 0}, {100, 100}, {100, 0}, {0, 100}}, {}};
  EXPECT_EQ(expand({}, {}, bow_tie, grid_points(3, 3, 50.0)).error().code, FailureCode::kNotSimple);
  EXPECT_FALSE(expand({}, {}, {}, grid_points(3, 3, 50.0)).has_value());
}

TEST(Expand, OnePointAndNoneAndARow) {
  EXPECT_TRUE(expand({}, {}, kPark, PointSet{})->site.points.empty());
  const auto one = expand({}, {}, kPark, PointSet{made_point({5, 5})});
  EXPECT_NEAR(static_cast<double>(one->site.points.size()), 16.0, 10.0) << "one per 100 m";
  const auto row = expand({}, {}, kPark, grid_points(3, 1, 100.0));
  EXPECT_NEAR(static_cast<double>(row->site.points.size()), 16.0, 10.0);
  const PointSet heap(7, made_point({5, 5}, {.distance_m = 0.0}));
  EXPECT_EQ(expand({}, {}, kPark, heap)->site.points.size(), 7u) << "no distance: one copy";
}

}  // namespace
}  // namespace plat::synthesis
