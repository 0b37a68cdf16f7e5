#pragma once

#include <span>

namespace plat::statistics {

/// The quantile at `fraction_01` of values sorted in ascending order, interpolated between order
/// statistics (type 7 of Hyndman and Fan 1996, NumPy's default). Pre: not empty.
double sorted_quantile(std::span<const double> sorted, double fraction_01);

/// An interval on a statistic, in the unit of that statistic.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// The central interval that holds `level_01` of the replicates: the percentile interval of Efron
/// and Tibshirani (1993, ch. 13). Pre: not empty.
Interval percentile_interval(std::span<const double> replicates, double level_01);

}  // namespace plat::statistics
