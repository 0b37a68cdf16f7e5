#include "streets/transition.h"

#include <algorithm>
#include <cmath>

namespace plat::streets {
namespace {

double deviation(double variance, double least) { return std::max(std::sqrt(variance), least); }

/// Squared distance from the mean in deviations. Where the deviation is 0, only the mean itself is
/// possible.
double squared_score(double value, double mean, double deviation) {
  if (value == mean) return 0.0;
  const double score = (value - mean) / deviation;
  return score * score;
}

}  // namespace

double transition_probability(const PassingStreet& base, const TransitionStep& step,
                              const TransitionModel& model) {
  double sum = 0.0;
  if (model.distance == AxisUse::kGaussian) {
    sum += squared_score(step.distance_m, base.distance_mean_m,
                         deviation(base.distance_variance_m2, model.min_distance_deviation_m));
  }
  if (model.angle == AxisUse::kGaussian && step.turn_rad) {
    sum += squared_score(*step.turn_rad, base.angle_mean_rad,
                         deviation(base.angle_variance_rad2, model.min_angle_deviation_rad));
  }
  return std::exp(-0.5 * sum);
}

DistanceRange likely_distances(const PassingStreet& base, double threshold,
                               const TransitionModel& model) {
  const double reach = std::sqrt(-2.0 * std::log(threshold)) *
                       deviation(base.distance_variance_m2, model.min_distance_deviation_m);
  return {std::max(base.distance_mean_m - reach, 0.0), base.distance_mean_m + reach};
}

double turn_between(Point direction, Point next) {
  return std::atan2(std::abs(cross(direction, next)), dot(direction, next));
}

}  // namespace plat::streets
