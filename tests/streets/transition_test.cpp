#include "streets/transition.h"

#include <cmath>
#include <numbers>

#include "support/property.h"

namespace plat::streets {
namespace {

PassingStreet style(double distance_m, double deviation_m, double angle, double angle_deviation) {
  PassingStreet street;
  street.distance_mean_m = distance_m;
  street.distance_variance_m2 = deviation_m * deviation_m;
  street.angle_mean_rad = angle;
  street.angle_variance_rad2 = angle_deviation * angle_deviation;
  return street;
}

TEST(Transition, IsOneAtTheMeans) {
  EXPECT_DOUBLE_EQ(transition_probability(style(80, 20, 0.2, 0.1), {80.0, 0.2}), 1.0);
}

TEST(Transition, FallsAsAGaussianOfEachAxisAlikeOnBothSides) {
  const PassingStreet street = style(80, 20, 0.5, 0.2);
  EXPECT_NEAR(transition_probability(street, {100.0, 0.5}), std::exp(-0.5), 1e-12);
  EXPECT_NEAR(transition_probability(street, {60.0, 0.5}), std::exp(-0.5), 1e-12);
  EXPECT_NEAR(transition_probability(street, {80.0, 0.9}), std::exp(-2.0), 1e-12);
  EXPECT_NEAR(transition_probability(street, {80.0, 0.1}), std::exp(-2.0), 1e-12);
  EXPECT_NEAR(transition_probability(street, {100.0, 0.9}), std::exp(-2.5), 1e-12);
}

TEST(Transition, CountsOnlyTheDistanceOfAFirstStep) {
  EXPECT_NEAR(transition_probability(style(80, 20, 0.5, 0.2), {100.0, std::nullopt}),
              std::exp(-0.5), 1e-12);
}

TEST(Transition, BoundsTheDeviationsOfStreetsThatHaveNone) {
  const PassingStreet street = style(80, 0, 0, 0);
  const TransitionModel model{.min_distance_deviation_m = 10.0, .min_angle_deviation_rad = 0.1};
  EXPECT_NEAR(transition_probability(street, {90.0, 0.1}, model), std::exp(-1.0), 1e-12);
  const TransitionModel exact{.min_distance_deviation_m = 0.0, .min_angle_deviation_rad = 0.0};
  EXPECT_EQ(transition_probability(street, {80.0, 0.0}, exact), 1.0);
  EXPECT_EQ(transition_probability(street, {80.5, 0.0}, exact), 0.0);
  EXPECT_EQ(transition_probability(street, {80.0, 0.01}, exact), 0.0);
}

TEST(Transition, AnAxisCanBeIgnored) {
  const PassingStreet street = style(80, 20, 0.5, 0.2);
  EXPECT_NEAR(transition_probability(street, {100.0, 3.0}, {.angle = AxisUse::kIgnored}),
              std::exp(-0.5), 1e-12);
  EXPECT_NEAR(transition_probability(street, {1000.0, 0.7}, {.distance = AxisUse::kIgnored}),
              std::exp(-0.5), 1e-12);
}

TEST(Transition, IsAProbabilityWhateverTheStyle) {
  Rng rng = testing::property_rng("Transition.IsAProbability");
  int likely = 0;
  for (int i = 0; i < testing::iterations(2000); ++i) {
    const double zero_or = rng.uniform_01() < 0.3 ? 0.0 : 1.0;
    const PassingStreet street = style(rng.uniform(0, 300), zero_or * rng.uniform(0, 100),
                                       rng.uniform(0, 3.1), zero_or * rng.uniform(0, 1));
    const double p = transition_probability(street, {rng.uniform(0, 300), rng.uniform(0, 3.1)});
    ASSERT_GE(p, 0.0);
    ASSERT_LE(p, 1.0);
    if (p > 0.01) ++likely;
  }
  EXPECT_GT(likely, 100);
}

TEST(Transition, LikelyDistancesAreThoseNotBelowTheThreshold) {
  const PassingStreet street = style(80, 20, 0.5, 0.2);
  const DistanceRange range = likely_distances(street, 0.1);
  EXPECT_NEAR(transition_probability(street, {range.min_m, std::nullopt}), 0.1, 1e-9);
  EXPECT_NEAR(transition_probability(street, {range.max_m, std::nullopt}), 0.1, 1e-9);
  EXPECT_EQ(likely_distances(style(10, 20, 0, 0), 0.1).min_m, 0.0);
}

TEST(Transition, TurnsAreUnsigned) {
  EXPECT_NEAR(turn_between({1, 0}, {0, 2}), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(turn_between({1, 0}, {0, -2}), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(turn_between({1, 0}, {-3, 0}), std::numbers::pi, 1e-12);
  EXPECT_EQ(turn_between({0, 0}, {1, 0}), 0.0);
}

}  // namespace
}  // namespace plat::streets
