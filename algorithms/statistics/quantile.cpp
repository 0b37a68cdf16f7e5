#include "statistics/quantile.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/failure.h"

namespace plat::statistics {

double sorted_quantile(std::span<const double> sorted, double fraction_01) {
  expects(!sorted.empty(), "a quantile needs a value");
  expects(fraction_01 >= 0.0 && fraction_01 <= 1.0, "a quantile's fraction lies in 0..1");
  const double position = fraction_01 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(position));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double t = position - static_cast<double>(below);
  return sorted[below] + t * (sorted[above] - sorted[below]);
}

Interval percentile_interval(std::span<const double> replicates, double level_01) {
  std::vector<double> sorted(replicates.begin(), replicates.end());
  std::sort(sorted.begin(), sorted.end());
  const double tail = 0.5 * (1.0 - level_01);
  return {sorted_quantile(sorted, tail), sorted_quantile(sorted, 1.0 - tail)};
}

}  // namespace plat::statistics
