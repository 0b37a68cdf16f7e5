#pragma once

#include <span>
#include <vector>

namespace plat::statistics {

/// p values adjusted for a family of tests by Holm's step-down procedure (Holm 1979): rejecting
/// those at most alpha keeps the chance of any false rejection below alpha, whatever the dependence
/// between the tests. Same order as given. Never below the given p, never above 1.
std::vector<double> holm_adjusted(std::span<const double> p_values);

}  // namespace plat::statistics
