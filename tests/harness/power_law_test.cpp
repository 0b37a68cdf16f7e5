#include "harness/power_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plat::harness {
namespace {

TEST(PowerLaw, RecoversAKnownExponent) {
  std::vector<GrowthPoint> points;
  for (const double x : {50.0, 100.0, 500.0, 2000.0})
    points.push_back({x, 0.003 * std::pow(x, 1.29)});
  const auto law = fit_power_law(points);
  ASSERT_TRUE(law && law->interval);
  EXPECT_NEAR(law->exponent, 1.29, 1e-12);
  EXPECT_NEAR(law->factor, 0.003, 1e-12);
  EXPECT_NEAR(law->interval->high - law->interval->low, 0.0, 1e-6);
}

TEST(PowerLaw, HasAnIntervalThatGrowsWithTheScatter) {
  const std::vector<GrowthPoint> points{{1.0, 1.1}, {2.0, 1.8}, {4.0, 4.4}, {8.0, 7.2}};
  const auto law = fit_power_law(points);
  ASSERT_TRUE(law && law->interval);
  // Reckoned apart from this code: Student's t with 2 degrees of freedom, 4.3027 standard errors of
  // the slope.
  EXPECT_NEAR(law->exponent, 0.942099, 1e-6);
  EXPECT_NEAR(law->interval->high - law->exponent, 0.352322, 1e-6);
}

TEST(PowerLaw, DoesNotChangeItsExponentWithTheUnits) {
  const std::vector<GrowthPoint> points{{1.0, 1.1}, {2.0, 1.8}, {4.0, 4.4}};
  std::vector<GrowthPoint> other = points;
  for (GrowthPoint& point : other) point = {5.0 * point.x, 1000.0 * point.y};
  EXPECT_NEAR(fit_power_law(points)->exponent, fit_power_law(other)->exponent, 1e-12);
}

TEST(PowerLaw, NeedsTwoDifferentValues) {
  EXPECT_FALSE(fit_power_law({}));
  EXPECT_FALSE(fit_power_law(std::vector<GrowthPoint>{{2.0, 1.0}, {2.0, 3.0}}));
  EXPECT_FALSE(fit_power_law(std::vector<GrowthPoint>{{1.0, 1.0}, {2.0, 3.0}})->interval);
}

}  // namespace
}  // namespace plat::harness
