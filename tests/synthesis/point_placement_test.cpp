#include "synthesis/point_placement.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/working_grid.h"

namespace plat::synthesis {
namespace {

streets::IntersectionPoint crossing_at(Point place) {
  streets::IntersectionPoint out;
  out.place = place;
  out.a = {.hierarchy = 0, .distance_mean_m = 80.0, .distance_variance_m2 = 9.0, .width_m = 12.0};
  out.b = streets::PassingStreet{.hierarchy = 1, .distance_mean_m = 60.0, .width_m = 8.0};
  out.parcel_area_m2 = 400.0;
  return out;
}

TEST(PointPlacement, RigidMotionKeepsAttributesAndDistances) {
  const PointSet points{crossing_at({0.0, 0.0}), crossing_at({100.0, 50.0})};
  const PointSet moved = place(points, {.rotation_rad = 0.3, .translation = {1000.0, -500.0}});
  ASSERT_EQ(moved.size(), 2u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(is_on_grid(moved[i].place));
    streets::IntersectionPoint same = moved[i];
    same.place = points[i].place;
    EXPECT_EQ(same, points[i]);
  }
  EXPECT_NEAR(distance(moved[0].place, moved[1].place), distance(points[0].place, points[1].place),
              2.0 * kGridStep_m);
}

TEST(PointPlacement, TurnsAboutThePivotCounterClockwise) {
  EXPECT_EQ(placed({20.0, 0.0}, {.pivot = {10.0, 0.0}, .rotation_rad = std::numbers::pi / 2}),
            (Point{10.0, 10.0}));
}

TEST(PointPlacement, MirrorsBeforeItTurns) {
  EXPECT_EQ(placed({5.0, 3.0}, {.mirroring = Mirroring::kAcrossEast}), (Point{5.0, -3.0}));
}

TEST(PointPlacement, ScalesDistancesAndParcelsButNotWidths) {
  const PointSet points{crossing_at({10.0, 0.0})};
  const PointSet scaled = place(points, {.scale = 2.0});
  EXPECT_EQ(scaled[0].place, (Point{20.0, 0.0}));
  EXPECT_DOUBLE_EQ(scaled[0].a.distance_mean_m, 160.0);
  EXPECT_DOUBLE_EQ(scaled[0].a.distance_variance_m2, 36.0);
  EXPECT_DOUBLE_EQ(scaled[0].b->distance_mean_m, 120.0);
  EXPECT_DOUBLE_EQ(*scaled[0].parcel_area_m2, 1600.0);
  EXPECT_DOUBLE_EQ(scaled[0].a.width_m, 12.0);
}

TEST(PointPlacement, PointsAtOnePlaceStayAtOnePlace) {
  const PointSet points{crossing_at({17.25, 3.5}), crossing_at({17.25, 3.5})};
  const PointSet moved = place(points, {.rotation_rad = 1.1, .translation = {0.123, 7.7}});
  EXPECT_EQ(moved[0].place, moved[1].place);
}

TEST(PointPlacement, NothingPlacedIsNothing) { EXPECT_TRUE(place(PointSet{}, {}).empty()); }

}  // namespace
}  // namespace plat::synthesis
