#include "statistics/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/quantile.h"

namespace plat::statistics {
namespace {

constexpr double kFewestBins = 8.0;
constexpr double kMostBins = 80.0;
/// Closed bins reach no further from the quartiles than this many interquartile ranges.
constexpr double kFence = 5.0;

/// The smallest of 1, 2, 5 times a power of ten that is not below `width`.
double round_up_width(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    // A width that is such a number already must not move up by rounding.
    if (factor * power >= width * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

double round_down_width(double width) {
  const double up = round_up_width(width);
  if (up <= width * (1.0 + 1e-9)) return up;
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= width) return factor * power;
  }
  return power;
}

Bins regular_bins(double first_index, double last_index, double width, double shift) {
  Bins bins;
  // Edges from whole multiples, so that they do not carry a growing rounding error.
  for (double i = first_index; i <= last_index; i += 1.0) bins.edges.push_back(i * width + shift);
  return bins;
}

}  // namespace

std::size_t Bins::index(double value) const {
  return static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), value) -
                                  edges.begin());
}

double Bins::low(std::size_t bin) const {
  return bin == 0 ? -std::numeric_limits<double>::infinity() : edges[bin - 1];
}

double Bins::high(std::size_t bin) const {
  return bin == edges.size() ? std::numeric_limits<double>::infinity() : edges[bin];
}

Bins shared_bins(std::span<const double> observed, ValueKind kind) {
  std::vector<double> sorted(observed.begin(), observed.end());
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty()) return {{0.0, 1.0}};
  double low = sorted_quantile(sorted, 0.01);
  double high = sorted_quantile(sorted, 0.99);
  const double iqr = sorted_quantile(sorted, 0.75) - sorted_quantile(sorted, 0.25);
  if (iqr > 0.0) {
    low = std::max(low, sorted_quantile(sorted, 0.25) - kFence * iqr);
    high = std::min(high, sorted_quantile(sorted, 0.75) + kFence * iqr);
  }
  if (!(high > low)) {
    low = sorted.front();
    high = sorted.back();
  }
  const double shift = kind == ValueKind::kInteger ? -0.5 : 0.0;
  if (!(high > low)) return {{std::floor(low) + shift, std::floor(low) + 1.0 + shift}};

  const double range = high - low;
  double width = 2.0 * iqr / std::cbrt(static_cast<double>(sorted.size()));
  if (!(width > 0.0)) width = range / kFewestBins;
  width = std::clamp(width, range / kMostBins, range / kFewestBins);
  // Rounding must not leave the allowed numbers of bins: up, unless that makes too few.
  width = round_up_width(width) <= range / kFewestBins ? round_up_width(width)
                                                       : round_down_width(width);
  if (kind == ValueKind::kInteger) width = std::max(1.0, std::round(width));
  const double first = std::floor((low - shift) / width);
  const double last = std::floor((high - shift) / width) + 1.0;
  return regular_bins(first, last, width, shift);
}

std::vector<std::uint64_t> count_values(std::span<const double> values, const Bins& bins) {
  std::vector<std::uint64_t> counts(bins.count(), 0);
  for (const double value : values) ++counts[bins.index(value)];
  return counts;
}

}  // namespace plat::statistics
