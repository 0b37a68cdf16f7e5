#include "harness/power_law.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <vector>

#include "core/failure.h"

namespace plat::harness {

std::optional<PowerLaw> fit_power_law(std::span<const GrowthPoint> points) {
  const auto n = static_cast<double>(points.size());
  std::vector<GrowthPoint> logs;
  GrowthPoint mean;
  for (const GrowthPoint& point : points) {
    expects(point.x > 0.0 && point.y > 0.0, "a power law has positive values");
    logs.push_back({std::log(point.x), std::log(point.y)});
    mean.x += logs.back().x / n;
    mean.y += logs.back().y / n;
  }
  double sxx = 0.0;
  double sxy = 0.0;
  for (const GrowthPoint& log : logs) {
    sxx += (log.x - mean.x) * (log.x - mean.x);
    sxy += (log.x - mean.x) * (log.y - mean.y);
  }
  const auto [low, high] = std::ranges::minmax_element(points, {}, &GrowthPoint::x);
  if (points.empty() || low->x == high->x) return std::nullopt;
  PowerLaw law;
  law.exponent = sxy / sxx;
  law.factor = std::exp(mean.y - law.exponent * mean.x);
  if (points.size() < 3) return law;
  double residual = 0.0;
  for (const GrowthPoint& log : logs) {
    const double off = log.y - mean.y - law.exponent * (log.x - mean.x);
    residual += off * off;
  }
  constexpr double kUpperTail_01 = 0.975;
  const boost::math::students_t distribution(n - 2.0);
  const double half =
      boost::math::quantile(distribution, kUpperTail_01) * std::sqrt(residual / (n - 2.0) / sxx);
  law.interval = statistics::Interval{law.exponent - half, law.exponent + half};
  return law;
}

}  // namespace plat::harness
