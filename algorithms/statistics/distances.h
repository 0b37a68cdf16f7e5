#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "statistics/histogram.h"

namespace plat::statistics {

/// The three distances between two distributions that every comparison reports.
enum class DistanceKind : std::uint8_t {
  /// Largest difference between the two distribution functions; no unit, 0..1.
  kKolmogorovSmirnov,
  /// Area between the two distribution functions = mean distance that values must be moved; in the
  /// unit of the measure. One far outlier moves it: read it beside the other two.
  kWasserstein,
  /// Square root of the Jensen-Shannon divergence in base 2 of the two histograms (Lin 1991; Endres
  /// and Schindelin 2003); no unit, 0..1. Depends on the bins.
  kJensenShannon,
};
inline constexpr std::array kDistanceKinds{
    DistanceKind::kKolmogorovSmirnov, DistanceKind::kWasserstein, DistanceKind::kJensenShannon};
/// "ks", "wasserstein", "jensen_shannon".
std::string_view distance_name(DistanceKind kind);

/// One value per kind.
struct Distances {
  std::array<double, kDistanceKinds.size()> values{};

  double& operator[](DistanceKind kind) { return values[static_cast<std::size_t>(kind)]; }
  double operator[](DistanceKind kind) const { return values[static_cast<std::size_t>(kind)]; }
};

/// sup |F_a - F_b|, evaluated after all copies of a tied value. Pre: neither sample is empty.
/// Complexity: O(n log n), as all below.
double ks_statistic(std::span<const double> a, std::span<const double> b);

/// Integral of |F_a - F_b|: exact, no binning. Pre: neither sample is empty.
double wasserstein_1(std::span<const double> a, std::span<const double> b);

/// Jensen-Shannon distance in base 2 of two histograms over the same bins. Pre: neither is all
/// zero.
double jensen_shannon(std::span<const double> a_counts, std::span<const double> b_counts);

/// All three. Pre: neither sample is empty.
Distances distances(std::span<const double> a, std::span<const double> b, const Bins& bins);

}  // namespace plat::statistics
