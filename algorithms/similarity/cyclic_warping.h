#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plat::similarity {

/// Which of n things around a ring matches which of n around another.
struct CyclicWarping {
  double cost = 0.0;  ///< of all matches
  /// In order around both rings, each once at least; begins with a match of the first ring's 0.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> matches;
};

/// The cheapest warping of a ring onto another: from a match, one goes on to the next thing of the
/// first ring, of the second, or of both, until one is back, once around both. No begin is given:
/// all are tried, by divide and conquer, for paths that are the cheapest from their begins need not
/// cross.
///
/// Guarantees: 1. no warping is cheaper, up to rounding: one that begins anywhere, in any number of
/// steps;  2. the cost is the same for both rings exchanged or begun elsewhere, up to rounding.
/// @param size   n, at least 1
/// @param costs  n rows of n: of a thing of the first ring and one of the second; not negative
/// Complexity:   O(n^2 log n)
/// Paper:        dynamic time warping [SC78] as in [Har, Sec. 4.1.3]; all begins [Mae90]
CyclicWarping cheapest_cyclic_warping(std::size_t size, std::span<const float> costs);

}  // namespace plat::similarity
