#pragma once

#include <numbers>
#include <optional>

#include "streets/intersection_point.h"

namespace plat::streets {

/// Whether an axis of the Gaussian counts.
enum class AxisUse { kGaussian, kIgnored };

/// How a street's four numbers become a transition probability.
struct TransitionModel {
  AxisUse distance = AxisUse::kGaussian;
  AxisUse angle = AxisUse::kGaussian;
  /// Deviations below these are taken as these: a street of one segment, or of two equal ones,
  /// would else go on at no other length.
  double min_distance_deviation_m = 10.0;
  double min_angle_deviation_rad = 0.1;
};

/// A step of a walk, as seen from its base point.
struct TransitionStep {
  double distance_m = 0.0;
  /// Unsigned turn from the street's last segment into the step, [0, pi]; none for the first step
  /// of a street, which has no last segment: then only the distance counts.
  std::optional<double> turn_rad;
};

/// The probability of a step from a base point along a street of style `base`, relative to that of
/// the likeliest step: exp(-(((d - mu_d) / sigma_d)^2 + ((alpha - mu_alpha) / sigma_alpha)^2) / 2).
///
/// Guarantees: 1. in [0, 1], and 1 at the means;  2. falls with the distance of each axis from its
/// mean, alike on both sides;  3. finite and defined for variances of 0.
/// Paper: [AVB08, Sec. 3.1.1]: the bivariate Gaussian of (mu_d, mu_alpha), (sigma_d^2,
/// sigma_alpha^2) stored in the base point; Fig. 5a.
/// Deviation: the axes are independent, for no covariance is stored; the density's factor, which
/// has the unit 1 / (m rad), is left out, so that one threshold fits every street (ADR 0027).
double transition_probability(const PassingStreet& base, const TransitionStep& step,
                              const TransitionModel& model = {});

/// The distances at which a step is no less likely than `threshold`, whatever its turn.
/// Pre: 0 < threshold <= 1.
struct DistanceRange {
  double min_m = 0.0;
  double max_m = 0.0;
};
DistanceRange likely_distances(const PassingStreet& base, double threshold,
                               const TransitionModel& model = {});

/// Unsigned angle between two directions, [0, pi]; 0 where one is the zero vector.
double turn_between(Point direction, Point next);

}  // namespace plat::streets
