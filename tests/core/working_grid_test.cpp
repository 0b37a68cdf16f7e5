#include "core/working_grid.h"

#include <gtest/gtest.h>

#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat {
namespace {

TEST(Snap, IsIdempotent) {
  Rng rng = testing::property_rng("Snap.Idempotent");
  for (int i = 0; i < testing::iterations(10'000); ++i) {
    const double x = snap(rng.uniform(-1e5, 1e5));
    ASSERT_EQ(snap(x), x);
    ASSERT_EQ(from_grid(to_grid(x)), x);
  }
}

TEST(Snap, MovesByHalfAStepAtMost) {
  Rng rng = testing::property_rng("Snap.Half");
  for (int i = 0; i < testing::iterations(10'000); ++i) {
    const double x = rng.uniform(-1e5, 1e5);
    ASSERT_LE(std::abs(snap(x) - x), 0.5 * kGridStep_m);
  }
}

TEST(Snap, HalfWayGoesUpForEitherSign) {
  EXPECT_EQ(snap(0.5 * kGridStep_m), kGridStep_m);
  EXPECT_EQ(snap(-0.5 * kGridStep_m), 0.0);
  EXPECT_EQ(snap(-1.5 * kGridStep_m), -kGridStep_m);
  EXPECT_EQ(snap(2.5 * kGridStep_m), 3.0 * kGridStep_m);
}

TEST(Snap, CommutesWithShiftsByWholeSteps) {
  Rng rng = testing::property_rng("Snap.Shift");
  for (int i = 0; i < testing::iterations(1000); ++i) {
    const double x = snap(rng.uniform(-100, 100)) + 0.25 * kGridStep_m;
    for (const double steps : {-4096.0, -1.0, 1.0, 100'000.0})
      ASSERT_EQ(snap(x + steps * kGridStep_m), snap(x) + steps * kGridStep_m);
  }
}

TEST(Snap, IntegersAndDoublesAgree) {
  Rng rng = testing::property_rng("Snap.Agree");
  for (int i = 0; i < testing::iterations(10'000); ++i) {
    const double x = rng.uniform(-kGridExtent_m, kGridExtent_m);
    ASSERT_EQ(from_grid(to_grid(x)), snap(x));
  }
}

TEST(SnapRing, RepeatedAndCollinearVerticesGo) {
  const Ring ring{{0, 0}, {5, 0}, {5, 0}, {10, 0}, {10, 10}, {10, 10.0001}, {0, 10}, {0, 5}};
  EXPECT_EQ(snap_ring(ring), (Ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
}

TEST(SnapRing, SpikesGo) {
  const Ring ring{{0, 0}, {10, 0}, {10, 5}, {20, 5}, {10, 5}, {10, 10}, {0, 10}};
  EXPECT_EQ(snap_ring(ring), (Ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
}

TEST(SnapRing, NothingIsLeftOfALineOrAPoint) {
  EXPECT_TRUE(snap_ring(Ring{{0, 0}, {10, 10}, {5, 5}}).empty());
  EXPECT_TRUE(snap_ring(Ring{{1, 1}, {1, 1.0001}, {1.0001, 1}}).empty());
  EXPECT_TRUE(snap_ring(Ring{}).empty());
}

TEST(SnapRing, IsIdempotentOnRandomRings) {
  Rng rng = testing::property_rng("SnapRing.Idempotent");
  int vertices = 0;
  for (int i = 0; i < testing::iterations(200); ++i) {
    const Ring ring = snap_ring(testing::star_ring(rng, 40, 0.002, 0.05, {3, 4}));
    ASSERT_EQ(snap_ring(ring), ring);
    vertices += static_cast<int>(ring.size());
  }
  EXPECT_GT(vertices, testing::iterations(200) * 10) << "something must be left to snap again";
}

TEST(SnapPolygon, OrientsRingsAndDropsVanishedHoles) {
  const Polygon raw{{{0, 0}, {0, 10}, {10, 10}, {10, 0}},
                    {{{2, 2}, {4, 2}, {4, 4}}, {{6, 6}, {6.0001, 6}, {6, 6.0001}}}};
  const Polygon polygon = snap_polygon(raw);
  EXPECT_GT(signed_area_m2(polygon.outer), 0.0);
  ASSERT_EQ(polygon.holes.size(), 1U);
  EXPECT_LT(signed_area_m2(polygon.holes.front()), 0.0);
}

}  // namespace
}  // namespace plat
