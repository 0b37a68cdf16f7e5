#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace plat::statistics {

/// Values of one measure, grouped by block: parcels of one block are not independent, so whatever
/// resamples or swaps does so by whole groups. Two samples that are compared have the same groups
/// in the same order; a group may be empty.
struct GroupedSample {
  std::vector<double> values;           ///< group after group, finite
  std::vector<std::size_t> offsets{0};  ///< n + 1 offsets into `values` for n groups

  [[nodiscard]] std::size_t groups() const { return offsets.size() - 1; }
  [[nodiscard]] std::span<const double> group(std::size_t i) const {
    return std::span<const double>(values).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
  void add_group(std::span<const double> group_values) {
    values.insert(values.end(), group_values.begin(), group_values.end());
    offsets.push_back(values.size());
  }
};

/// Only the groups listed, in that order.
inline GroupedSample select_groups(const GroupedSample& sample,
                                   std::span<const std::size_t> groups) {
  GroupedSample out;
  for (const std::size_t g : groups) out.add_group(sample.group(g));
  return out;
}

}  // namespace plat::statistics
