#pragma once

#include <optional>
#include <span>

#include "statistics/quantile.h"

namespace plat::harness {

/// y = factor * x^exponent.
struct PowerLaw {
  double factor = 1.0;
  double exponent = 0.0;
  /// 95 % of Student's t for the slope; none for fewer than three points.
  std::optional<statistics::Interval> interval;
};

struct GrowthPoint {
  double x = 0.0;
  double y = 0.0;
};

/// Fits a straight line to the logarithms by least squares; nothing for fewer than two different x.
/// The interval says how far the points stray from a power law, not how well each was measured.
///
/// Guarantees: 1. points on a power law give its exponent;  2. neither unit changes the exponent.
/// Pre: all x and y above 0.
std::optional<PowerLaw> fit_power_law(std::span<const GrowthPoint> points);

}  // namespace plat::harness
