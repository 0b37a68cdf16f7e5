#include "core/oriented_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat {
namespace {

double area_at(std::span<const Point> points, double angle) {
  const Point u{std::cos(angle), std::sin(angle)};
  Box box;
  for (const Point p : points) box.add(Point{dot(p, u), cross(u, p)});
  return box.width() * box.height();
}

TEST(MinimumAreaBox, NoDirectionGivesASmallerOne) {
  Rng rng = testing::property_rng("MinimumAreaBox.Angles");
  constexpr int kAngles = 900;
  double best_ratio = 2.0;
  for (int i = 0; i < testing::iterations(100); ++i) {
    const Ring ring = testing::star_ring(rng, 4 + static_cast<int>(rng.index(12)), 5, 30, {50, 9});
    const OrientedBox box = minimum_area_box(std::span<const Point>(ring));
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kAngles; ++k)
      least = std::min(least, area_at(ring, 0.5 * std::numbers::pi * k / kAngles));
    ASSERT_LE(box.area_m2(), least * (1.0 + 1e-12));
    best_ratio = std::min(best_ratio, least / box.area_m2());
  }
  EXPECT_LT(best_ratio, 1.01) << "the scan must come near the optimum, or it tests nothing";
}

TEST(MinimumAreaBox, HoldsEveryPoint) {
  Rng rng = testing::property_rng("MinimumAreaBox.Holds");
  for (int i = 0; i < testing::iterations(100); ++i) {
    const Ring ring = testing::star_ring(rng, 12, 5, 30, {50, 9});
    const OrientedBox box = minimum_area_box(std::span<const Point>(ring));
    EXPECT_GE(box.length_m, box.width_m);
    EXPECT_NEAR(length(box.axis), 1.0, 1e-12);
    for (const Point p : ring) {
      ASSERT_LE(std::abs(dot(p - box.center, box.axis)), 0.5 * box.length_m + 1e-9);
      ASSERT_LE(std::abs(cross(p - box.center, box.axis)), 0.5 * box.width_m + 1e-9);
    }
  }
}

TEST(MinimumAreaBox, OfATurnedRectangleIsTheRectangle) {
  const Point u = normalized(Point{4, 3});
  const Point c{100, -20};
  const Ring ring{c, c + 30.0 * u, c + 30.0 * u + 10.0 * perpendicular(u),
                  c + 10.0 * perpendicular(u)};
  const OrientedBox box = minimum_area_box(std::span<const Point>(ring));
  EXPECT_NEAR(box.length_m, 30.0, 1e-12);
  EXPECT_NEAR(box.width_m, 10.0, 1e-12);
  EXPECT_NEAR(std::abs(dot(box.axis, u)), 1.0, 1e-12);
  EXPECT_NEAR(box.aspect_ratio(), 3.0, 1e-12);
}

TEST(MinimumAreaBox, DegeneratePointsHaveNoWidth) {
  const OrientedBox line = minimum_area_box(std::vector<Point>{{0, 0}, {3, 4}, {1.5, 2}});
  EXPECT_DOUBLE_EQ(line.length_m, 5.0);
  EXPECT_EQ(line.width_m, 0.0);
  EXPECT_TRUE(std::isinf(line.aspect_ratio()));
  EXPECT_EQ(minimum_area_box(std::vector<Point>{{3, 4}}).length_m, 0.0);
  EXPECT_EQ(minimum_area_box(std::vector<Point>{}).length_m, 0.0);
}

}  // namespace
}  // namespace plat
