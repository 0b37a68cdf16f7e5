#include "core/affine.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "support/property.h"

namespace plat {
namespace {

Affine any_affine(Rng& rng) {
  return {rng.uniform(-2, 2),
          rng.uniform(-2, 2),
          rng.uniform(-2, 2),
          rng.uniform(-2, 2),
          {rng.uniform(-500, 500), rng.uniform(-500, 500)}};
}

TEST(Affine, ProductIsOneAfterTheOther) {
  Rng rng = testing::property_rng("affine product");
  for (int i = 0; i < testing::iterations(200); ++i) {
    const Affine a = any_affine(rng);
    const Affine b = any_affine(rng);
    const Point p{rng.uniform(-100, 100), rng.uniform(-100, 100)};
    EXPECT_LT(distance((a * b)(p), a(b(p))), 1e-9);
  }
}

TEST(Affine, InverseUndoesTheMap) {
  Rng rng = testing::property_rng("affine inverse");
  for (int i = 0; i < testing::iterations(200); ++i) {
    const Affine a = any_affine(rng);
    if (std::abs(a.determinant()) < 1e-3) continue;
    const auto back = a.inverse();
    ASSERT_TRUE(back);
    const Point p{rng.uniform(-100, 100), rng.uniform(-100, 100)};
    EXPECT_LT(distance((*back)(a(p)), p), 1e-8);
  }
}

TEST(Affine, SingularAndNotFiniteMapsHaveNoInverse) {
  EXPECT_FALSE((Affine{1, 2, 2, 4, {}}.inverse()));
  EXPECT_FALSE((Affine{std::numeric_limits<double>::quiet_NaN(), 0, 0, 1, {}}.inverse()));
}

TEST(Affine, RotationKeepsItsCentreAndTurnsToTheLeft) {
  const Point centre{30, -7};
  const Affine turn = Affine::rotation(0.5 * std::numbers::pi, centre);
  EXPECT_LT(distance(turn(centre), centre), 1e-12);
  EXPECT_LT(distance(turn(centre + Point{1, 0}), centre + Point{0, 1}), 1e-12);
}

TEST(Affine, MirroredPolygonsKeepTheOrientationOfRings) {
  const Polygon square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}};
  const Polygon mirrored = transformed(Affine{-1, 0, 0, 1, {10, 0}}, square);
  EXPECT_DOUBLE_EQ(signed_area_m2(mirrored.outer), 16.0);
  EXPECT_DOUBLE_EQ(signed_area_m2(mirrored.holes.at(0)), -1.0);
}

}  // namespace
}  // namespace plat
