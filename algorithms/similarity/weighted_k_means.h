#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/rng.h"

namespace plat::similarity {

/// Rows of numbers, one row after the other.
struct NumberTable {
  std::size_t columns = 0;
  std::vector<double> values;  ///< rows x columns

  [[nodiscard]] std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  [[nodiscard]] std::span<const double> row(std::size_t i) const {
    return std::span(values).subspan(i * columns, columns);
  }
};

/// Things put into groups.
struct Clusters {
  std::vector<std::uint32_t> cluster_of;  ///< per thing
  /// Per cluster its members, none empty: the one nearest to the cluster's mean first (its
  /// representative), then the farther ones, among equals the lower index.
  std::vector<std::vector<std::uint32_t>> members;

  [[nodiscard]] std::uint32_t representative(std::size_t cluster) const {
    return members[cluster].front();
  }
  friend bool operator==(const Clusters&, const Clusters&) = default;
};

struct KMeansResult {
  Clusters clusters;
  NumberTable means;  ///< a row per cluster, in the units of the table
  /// After each step of assignment: sum over rows of the weighted squared distance to the mean.
  std::vector<double> sum_of_squares;
  bool is_settled = false;  ///< the last step changed nothing; else it was the last one allowed
};

/// How many clusters a percentage of the things is: rounded, at least 1.
std::size_t cluster_count(std::size_t things, double percent);

/// Groups rows by k-means (Lloyd 1982) under sum_c weights[c] (x_c - y_c)^2, from a k-means++
/// seeding (Arthur and Vassilvitskii 2007).
///
/// Guarantees: 1. no cluster is empty; there are `clusters` of them, or as many as there are
/// different rows where those are fewer;  2. the sum of squares never rises from step to step;
/// 3. settled: no row is nearer to another cluster's mean than to its own;  4. the same table,
/// weights and seed give the same clusters, whatever the number of threads;  5. a column of weight
/// 0 changes nothing.
/// A cluster that loses all its rows takes the row that is farthest from its own mean. Stops when
/// no row changes its cluster, or after `max_steps`.
/// @param table    finite numbers, at least one row
/// @param weights  one per column, finite, not negative
///
/// Complexity: O(steps rows clusters columns).
///
/// Paper:      [ABVA08, Sec. 5], which says "weighted k-means" and nothing of seeds, of empty
///             clusters, or of when to stop
KMeansResult weighted_k_means(const NumberTable& table, std::span<const double> weights,
                              std::size_t clusters, Rng& rng, int max_steps = 100, Jobs jobs = {});

}  // namespace plat::similarity
