#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace plat::statistics {

/// Bins that two samples share. Bin i holds edges[i-1] <= value < edges[i]; bin 0 is everything
/// below the first edge, the last bin everything from the last edge on: no value is ever left out.
struct Bins {
  std::vector<double> edges;  ///< ascending, finite, equally spaced, at least two

  [[nodiscard]] std::size_t count() const { return edges.size() + 1; }
  [[nodiscard]] std::size_t index(double value) const;
  [[nodiscard]] double low(std::size_t bin) const;   ///< -infinity for bin 0
  [[nodiscard]] double high(std::size_t bin) const;  ///< infinity for the last bin
};

enum class ValueKind {
  kContinuous,
  kInteger,  ///< counts: bins are centred on whole numbers
};

/// Bins chosen from the observed sample alone, so that every strategy is measured on the same ones.
///
/// Width: Freedman and Diaconis (1981), 2 IQR n^(-1/3), rounded to 1, 2 or 5 times a power of ten
/// (to a whole number for counts). Range: the 1st to the 99th percentile, no further than 5
/// IQR from the quartiles, widened to whole bins; what lies outside falls into the two open bins,
/// since one park of 10 ha must not set the scale of a histogram of lots. Between 8 and 80 closed
/// bins wherever the values differ; a sample of equal values, or none, gets one bin around it.
/// Deterministic; the order of values does not matter.
Bins shared_bins(std::span<const double> observed, ValueKind kind);

/// How many values fall into each bin: not normalised. Sum = values.size().
std::vector<std::uint64_t> count_values(std::span<const double> values, const Bins& bins);

}  // namespace plat::statistics
