#include "similarity/affine_distortion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/failure.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

const double kRoot2 = std::numbers::sqrt2;

void expect_terms(const Affine& map, double scale, double aspect, double shear) {
  const AffineDistortion d = affine_distortion(map);
  EXPECT_NEAR(d.scale, scale, 1e-12);
  EXPECT_NEAR(d.aspect, aspect, 1e-12);
  EXPECT_NEAR(d.shear, shear, 1e-12);
}

TEST(AffineDistortion, RigidMapsHaveNone) {
  const AffineDistortion d = affine_distortion(Affine::translation({100, -3}));
  EXPECT_EQ(d.scale, 0.0);
  EXPECT_EQ(d.aspect, 0.0);
  EXPECT_EQ(d.shear, 0.0);
  for (const double angle : {0.3, 1.57, 3.0, -2.0}) expect_terms(Affine::rotation(angle), 0, 0, 0);
}

TEST(AffineDistortion, ScaleByTwoAndByHalfIsOne) {
  expect_terms({2, 0, 0, 2, {}}, 1, 0, 0);
  expect_terms({0.5, 0, 0, 0.5, {}}, 1, 0, 0);
}

TEST(AffineDistortion, AStretchChangesAspectAndTheSumOfTheVectors) {
  // |a + b| = |(2, 1)| = sqrt 5.
  expect_terms({2, 0, 0, 1, {}}, std::sqrt(5.0) / kRoot2 - 1.0, 1, 0);
}

TEST(AffineDistortion, AShearHalvesTheAngle) {
  // b = (1, 1): 45 degrees to a, sqrt 2 long; |a + b| = |(2, 1)|.
  expect_terms({1, 1, 0, 1, {}}, std::sqrt(5.0) / kRoot2 - 1.0, kRoot2 - 1.0, 1);
  // b = (-1, 1): 135 degrees; |a + b| = |(0, 1)|.
  expect_terms({1, -1, 0, 1, {}}, kRoot2 - 1.0, kRoot2 - 1.0, 0.5);
}

TEST(AffineDistortion, ARotationBehindTheMapChangesNothing) {
  Rng rng = testing::property_rng("affine_distortion_rotation");
  int turned = 0;
  for (int i = 0; i < testing::iterations(200); ++i) {
    const Affine map{
        rng.uniform(0.2, 2), rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0.2, 2), {}};
    if (map.determinant() < 0.05) continue;
    ++turned;
    const AffineDistortion d = affine_distortion(map);
    expect_terms(Affine::rotation(rng.uniform(-3, 3)) * map, d.scale, d.aspect, d.shear);
  }
  EXPECT_GT(turned, 100);
}

TEST(AffineDistortion, OfAMirrorIsNotAsked) {
  EXPECT_THROW((void)affine_distortion({-1, 0, 0, 1, {}}), LogicError);
}

}  // namespace
}  // namespace plat::similarity
