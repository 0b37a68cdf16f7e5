#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "statistics/distances.h"
#include "statistics/grouped_sample.h"

namespace plat::statistics {

/// The values of several grouped samples, sorted once, from which the distances of any two
/// reweighted samples follow in one linear pass: what bootstrap, permutations and random halves
/// have in common.
///
/// A cell is one group of one sample, number sample * groups() + group. A weighting says how often
/// each cell's values count in sample x and in sample y; kLanes weightings share a pass.
///
/// Guarantee: with weights 0 and 1, distances() equals the plain functions of distances.h up to
/// rounding in the last digits; two equal samples are at distance exactly 0.
class PooledSample {
 public:
  static constexpr std::size_t kLanes = 4;
  struct CellWeight {
    std::array<std::int32_t, kLanes> x{};
    std::array<std::int32_t, kLanes> y{};
  };

  /// Pre: all samples have the same number of groups; no more than 2^31 - 1 values.
  PooledSample(std::span<const GroupedSample* const> samples, const Bins& bins);

  [[nodiscard]] std::size_t groups() const { return groups_; }
  [[nodiscard]] std::size_t cell(std::size_t sample, std::size_t group) const {
    return sample * groups_ + group;
  }
  /// One all-zero weight per cell.
  [[nodiscard]] std::vector<CellWeight> no_weights() const {
    return std::vector<CellWeight>(cell_sizes_.size());
  }

  /// Pre: per lane, x and y each count at least one value and fewer than 2^31. Complexity: O(n).
  [[nodiscard]] std::array<Distances, kLanes> distances(std::span<const CellWeight> weights) const;

 private:
  struct Run {          // all copies of one value
    std::uint32_t end;  // in cells_
    double gap;         // to the next value, 0 for the last
  };

  std::size_t groups_ = 0;
  std::vector<std::uint32_t> cell_sizes_;  // values per cell
  std::vector<std::uint32_t> cells_;       // the cell of each value, in order of values
  std::vector<Run> runs_;
  std::vector<std::uint32_t> bin_ends_;  // in runs_, per bin
};

}  // namespace plat::statistics
