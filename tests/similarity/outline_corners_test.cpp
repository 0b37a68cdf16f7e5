#include "similarity/outline_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/polygon.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::similarity {
namespace {

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

Ring corners_of(const Ring& ring, std::size_t max_count = kAll) {
  Ring out;
  for (const std::size_t i : outline_corners(ring, max_count)) out.push_back(ring[i]);
  return out;
}

TEST(OutlineCorners, VerticesOnAnEdgeAreNone) {
  EXPECT_EQ(corners_of({{5, 0}, {10, 0}, {10, 6}, {10, 8}, {0, 8}, {0, 0.001}, {0, 0}}),
            (Ring{{0, 0}, {10, 0}, {10, 8}, {0, 8}}));
}

TEST(OutlineCorners, TheSmallestTrianglesGoFirst) {
  // Two corners of a square are cut off, by triangles of 2 and of 0.5 m2.
  const Ring ring{{0, 0}, {8, 0}, {10, 2}, {10, 9}, {9, 10}, {0, 10}};
  EXPECT_EQ(corners_of(ring, 6), ring);
  EXPECT_EQ(corners_of(ring, 5).size(), 5U);
  EXPECT_EQ(corners_of(ring, 3).size(), 3U);
  EXPECT_EQ(corners_of(ring, 1).size(), 3U);
  const Ring five = corners_of(ring, 5);
  EXPECT_TRUE(std::ranges::find(five, Point{8, 0}) != five.end());
}

TEST(OutlineCorners, DoNotDependOnWhereTheRingBegins) {
  Rng rng = testing::property_rng("outline_corners_start");
  int simplified = 0;
  for (const Polygon& block : testing::synthetic_blocks(rng, testing::iterations(60))) {
    Ring ring = block.outer;
    const Ring all = corners_of(ring);
    const Ring few = corners_of(ring, 8);
    simplified += few.size() < all.size() ? 1 : 0;
    std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(rng.index(ring.size())));
    EXPECT_EQ(corners_of(ring), all);
    EXPECT_EQ(corners_of(ring, 8), few);
  }
  EXPECT_GT(simplified, 10);
}

TEST(OutlineCorners, ASmoothOutlineKeepsItsShape) {
  Ring circle;
  for (int i = 0; i < 5000; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 5000;
    circle.push_back({100.0 * std::cos(angle), 100.0 * std::sin(angle)});
  }
  const Ring left = corners_of(circle);
  EXPECT_LT(left.size(), 200U);
  EXPECT_NEAR(signed_area_m2(left) / signed_area_m2(circle), 1.0, 0.005);
}

}  // namespace
}  // namespace plat::similarity
