#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blocks/contour_offset_internal.h"
#include "core/validity.h"
#include "support/property.h"

namespace plat::blocks::detail {
namespace {

std::vector<StreetSide> sides_of(const Ring& ring, double half_width_m) {
  std::vector<StreetSide> out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    out.push_back({{ring[i], ring[(i + 1) % ring.size()]}, half_width_m, 0});
  }
  return out;
}

TEST(InsetRing, OfARectangleIsTheSmallerRectangle) {
  const Ring inset = inset_ring(sides_of({{0, 0}, {100, 0}, {100, 60}, {0, 60}}, 6.0));
  ASSERT_EQ(inset.size(), 4U);
  EXPECT_NEAR(signed_area_m2(inset), 88.0 * 48.0, 1e-9);
}

TEST(InsetRing, AChamferThatVanishesLeavesItsNeighboursToMeet) {
  const Ring inset = inset_ring(sides_of({{0, 0}, {99, 0}, {100, 1}, {100, 60}, {0, 60}}, 6.0));
  ASSERT_EQ(inset.size(), 4U);
  EXPECT_NEAR(signed_area_m2(inset), 88.0 * 48.0, 1e-9);
}

TEST(InsetRing, ACornerInShortPiecesVanishesPieceByPiece) {
  Ring ring{{0, 0}};
  for (int i = 0; i <= 6; ++i) {  // a corner of 3 m radius under a street of 8 m half width
    const double angle = -0.5 * std::numbers::pi + i * std::numbers::pi / 12.0;
    ring.push_back({97.0 + 3.0 * std::cos(angle), 3.0 + 3.0 * std::sin(angle)});
  }
  ring.insert(ring.end(), {{100, 60}, {0, 60}});
  const Ring inset = inset_ring(sides_of(ring, 8.0));
  ASSERT_EQ(inset.size(), 4U);
  EXPECT_NEAR(signed_area_m2(inset), 84.0 * 44.0, 1e-6);
}

TEST(InsetRing, IsEmptyWhereNothingIsLeft) {
  EXPECT_TRUE(inset_ring(sides_of({{0, 0}, {30, 0}, {30, 10}, {0, 10}}, 6.0)).empty());
}

TEST(InsetRing, KeepsItsDistanceFromEverySide) {
  Rng rng = testing::property_rng("InsetRing.Distance");
  int with_vanished = 0;
  for (int i = 0; i < testing::iterations(500); ++i) {
    Ring ring;
    const int n = 12 + static_cast<int>(rng.index(40));
    std::vector<double> angles;
    for (int k = 0; k < n; ++k) angles.push_back(rng.uniform(0.0, 2.0 * std::numbers::pi));
    std::sort(angles.begin(), angles.end());
    const double radius_m = 50.0 + (rng.index(2) == 0 ? 0.0 : 2.0);  // every other ring has dents
    for (const double angle : angles) {
      const double r = rng.index(4) == 0 ? radius_m : 50.0;
      ring.push_back(r * Point{1.6 * std::cos(angle), std::sin(angle)});
    }
    const double half_width_m = rng.uniform(2.0, 9.0);
    const auto sides = sides_of(ring, half_width_m);
    const Ring inset = inset_ring(sides);
    if (!admit_polygon({inset, {}}, 1000)) continue;  // such a ring is cut instead
    with_vanished += inset.size() < ring.size() ? 1 : 0;
    for (const StreetSide& side : sides) {
      for (const Point p : inset) ASSERT_GE(distance(side.segment, p), half_width_m - 0.003);
    }
  }
  EXPECT_GT(with_vanished, testing::iterations(500) / 20);
}

}  // namespace
}  // namespace plat::blocks::detail
