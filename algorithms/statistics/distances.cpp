#include "statistics/distances.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/failure.h"

namespace plat::statistics {
namespace {

std::vector<double> sorted_copy(std::span<const double> values) {
  std::vector<double> out(values.begin(), values.end());
  std::sort(out.begin(), out.end());
  return out;
}

/// Calls visit(difference of the distribution functions, length of the step on which it holds) for
/// every distinct value but the last.
template <class Visit>
void for_each_step(std::span<const double> a, std::span<const double> b, Visit visit) {
  expects(!a.empty() && !b.empty(), "a distance needs two samples");
  const std::vector<double> x = sorted_copy(a);
  const std::vector<double> y = sorted_copy(b);
  const double a_step = 1.0 / static_cast<double>(x.size());
  const double b_step = 1.0 / static_cast<double>(y.size());
  std::size_t i = 0;
  std::size_t j = 0;
  const auto next = [&] { return j == y.size() || (i < x.size() && x[i] < y[j]) ? x[i] : y[j]; };
  while (true) {
    const double value = next();
    while (i < x.size() && x[i] == value) ++i;
    while (j < y.size() && y[j] == value) ++j;
    if (i == x.size() && j == y.size()) return;
    visit(static_cast<double>(i) * a_step - static_cast<double>(j) * b_step, next() - value);
  }
}

}  // namespace

std::string_view distance_name(DistanceKind kind) {
  switch (kind) {
    case DistanceKind::kKolmogorovSmirnov:
      return "ks";
    case DistanceKind::kWasserstein:
      return "wasserstein";
    case DistanceKind::kJensenShannon:
      return "jensen_shannon";
  }
  return "ks";
}

double ks_statistic(std::span<const double> a, std::span<const double> b) {
  double largest = 0.0;
  for_each_step(a, b, [&](double d, double) { largest = std::max(largest, std::abs(d)); });
  return largest;
}

double wasserstein_1(std::span<const double> a, std::span<const double> b) {
  double area = 0.0;
  for_each_step(a, b, [&](double d, double length) { area += std::abs(d) * length; });
  return area;
}

double jensen_shannon(std::span<const double> a_counts, std::span<const double> b_counts) {
  expects(a_counts.size() == b_counts.size(), "two histograms over the same bins");
  double a_total = 0.0;
  double b_total = 0.0;
  for (const double c : a_counts) a_total += c;
  for (const double c : b_counts) b_total += c;
  expects(a_total > 0.0 && b_total > 0.0, "a distance needs two samples");
  double divergence = 0.0;
  for (std::size_t i = 0; i < a_counts.size(); ++i) {
    const double p = a_counts[i] / a_total;
    const double q = b_counts[i] / b_total;
    if (p == q) continue;
    const double m = 0.5 * (p + q);
    if (p > 0.0) divergence += 0.5 * p * std::log2(p / m);
    if (q > 0.0) divergence += 0.5 * q * std::log2(q / m);
  }
  return std::sqrt(std::clamp(divergence, 0.0, 1.0));
}

Distances distances(std::span<const double> a, std::span<const double> b, const Bins& bins) {
  Distances out;
  for_each_step(a, b, [&](double d, double length) {
    double& ks = out[DistanceKind::kKolmogorovSmirnov];
    ks = std::max(ks, std::abs(d));
    out[DistanceKind::kWasserstein] += std::abs(d) * length;
  });
  const auto counts = [&](std::span<const double> values) {
    const std::vector<std::uint64_t> whole = count_values(values, bins);
    std::vector<double> real(whole.size());
    std::transform(whole.begin(), whole.end(), real.begin(),
                   [](std::uint64_t c) { return static_cast<double>(c); });
    return real;
  };
  out[DistanceKind::kJensenShannon] = jensen_shannon(counts(a), counts(b));
  return out;
}

}  // namespace plat::statistics
