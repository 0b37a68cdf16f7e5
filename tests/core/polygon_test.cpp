#include "core/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/validity.h"
#include "core/working_grid.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat {
namespace {

const Polygon kFrame{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 2}, {2, 6}, {8, 6}, {8, 2}}}};

TEST(Polygon, AreaAndPerimeterTakeHolesIntoAccount) {
  EXPECT_DOUBLE_EQ(area_m2(kFrame), 100.0 - 24.0);
  EXPECT_DOUBLE_EQ(perimeter_m(kFrame), 40.0 + 20.0);
}

TEST(Polygon, AreaKeepsItsDigitsFarFromTheOrigin) {
  const Point far{1048576.0, -1048576.0};
  EXPECT_EQ(signed_area_m2(Ring{far, far + Point{0.5, 0}, far + Point{0.5, 0.25}}), 0.0625);
}

TEST(Polygon, TurnIsPositiveToTheLeft) {
  EXPECT_DOUBLE_EQ(turn_rad(kFrame.outer, 0), 0.5 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(turn_rad(kFrame.holes[0], 3), -0.5 * std::numbers::pi);
  EXPECT_EQ(turn_rad(Ring{{0, 0}, {1, 0}, {2, 0}, {1, 1}}, 1), 0.0);
}

TEST(Polygon, CentroidTakesHolesIntoAccount) {
  const Point c = centroid(kFrame);
  EXPECT_DOUBLE_EQ(c.x, 5.0);
  EXPECT_DOUBLE_EQ(c.y, (100.0 * 5.0 - 24.0 * 4.0) / 76.0);
}

TEST(Polygon, CentroidWithoutAreaIsTheMeanOfTheVertices) {
  EXPECT_EQ(centroid({{{0, 0}, {4, 0}, {2, 0}}, {}}), (Point{2, 0}));
}

TEST(Locate, TellsInsideBoundaryAndOutside) {
  EXPECT_EQ(locate(kFrame, {1, 1}), Side::kInside);
  EXPECT_EQ(locate(kFrame, {5, 4}), Side::kOutside) << "in the hole";
  EXPECT_EQ(locate(kFrame, {5, 6}), Side::kBoundary) << "on the hole's edge";
  EXPECT_EQ(locate(kFrame, {10, 10}), Side::kBoundary) << "on a vertex";
  EXPECT_EQ(locate(kFrame, {10, 3}), Side::kBoundary);
  EXPECT_EQ(locate(kFrame, {11, 10}), Side::kOutside) << "level with an edge";
}

/// Every point of a small lattice against all triangles of the fan, counted by winding.
TEST(Locate, AgreesWithTheWindingNumberOnALattice) {
  Rng rng = testing::property_rng("Locate.Winding");
  int inside = 0;
  int boundary = 0;
  for (int i = 0; i < testing::iterations(200); ++i) {
    const Ring ring = snap_ring(testing::star_ring(rng, 7, 2.0, 6.0, {0, 0}));
    Ring rounded;
    for (const Point p : ring) rounded.push_back({std::round(p.x), std::round(p.y)});
    if (find_defect({rounded, {}})) continue;
    for (double x = -7; x <= 7; ++x) {
      for (double y = -7; y <= 7; ++y) {
        const Point p{x, y};
        double angle = 0.0;
        bool on = false;
        for (std::size_t k = 0; k < rounded.size(); ++k) {
          const Point a = rounded[k] - p;
          const Point b = rounded[(k + 1) % rounded.size()] - p;
          on = on || (cross(a, b) == 0.0 && dot(a, b) <= 0.0);
          angle += std::atan2(cross(a, b), dot(a, b));
        }
        const Side expected = on ? Side::kBoundary : (angle > 3.0 ? Side::kInside : Side::kOutside);
        ASSERT_EQ(locate(std::span<const Point>(rounded), p), expected);
        inside += expected == Side::kInside ? 1 : 0;
        boundary += on ? 1 : 0;
      }
    }
  }
  EXPECT_GT(inside, testing::iterations(200) * 10);
  EXPECT_GT(boundary, testing::iterations(200) * 4);
}

TEST(InteriorPoint, IsStrictlyInsideOfEveryBlock) {
  Rng rng = testing::property_rng("InteriorPoint.Blocks");
  for (const Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(500))) {
    const Point p = interior_point(polygon);
    ASSERT_EQ(locate(polygon, p), Side::kInside);
    ASSERT_GT(boundary_distance_m(polygon, p), 0.1);
  }
}

TEST(InteriorPoint, IsStrictlyInsideOfThinAndTinyPolygons) {
  const double h = kGridStep_m;
  for (const Polygon& p :
       {Polygon{{{0, 0}, {h, 0}, {0, h}}, {}}, Polygon{{{0, 0}, {1000, h}, {1000, 2 * h}}, {}},
        Polygon{{{0, 0}, {10, 0}, {10, 10}, {9, h}, {1, h}, {0, 10}}, {}}}) {
    EXPECT_EQ(locate(p, interior_point(p)), Side::kInside);
  }
}

TEST(ConvexHull, HoldsEveryPointAndNoCollinearOnes) {
  Rng rng = testing::property_rng("ConvexHull");
  for (int i = 0; i < testing::iterations(200); ++i) {
    std::vector<Point> points;
    for (int k = 0; k < 40; ++k)
      points.push_back({static_cast<double>(rng.index(8)), static_cast<double>(rng.index(8))});
    const Ring hull = convex_hull(points);
    ASSERT_GE(hull.size(), 3U);
    EXPECT_EQ(drop_collinear(hull), hull);
    for (const Point p : points) ASSERT_NE(locate(std::span<const Point>(hull), p), Side::kOutside);
  }
}

TEST(ConvexHull, DegenerateInputHasFewerThanThreePoints) {
  EXPECT_EQ(convex_hull(std::vector<Point>{{0, 0}, {1, 1}, {2, 2}}).size(), 2U);
  EXPECT_EQ(convex_hull(std::vector<Point>{{1, 1}, {1, 1}}).size(), 1U);
  EXPECT_TRUE(convex_hull(std::vector<Point>{}).empty());
}

}  // namespace
}  // namespace plat
