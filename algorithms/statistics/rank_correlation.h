#pragma once

#include <optional>
#include <span>
#include <vector>

namespace plat::statistics {

/// Ranks from 1; tied values share the mean of their ranks.
std::vector<double> midranks(std::span<const double> values);

/// Spearman's rank correlation: Pearson's of the midranks, in [-1, 1]; none where a sample has one
/// value only. Pre: equally many values. Complexity: O(n log n).
std::optional<double> spearman(std::span<const double> x, std::span<const double> y);

}  // namespace plat::statistics
