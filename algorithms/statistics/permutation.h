#pragma once

#include <cstdint>

#include "core/parallel.h"
#include "statistics/distances.h"
#include "statistics/grouped_sample.h"

namespace plat::statistics {

/// Whether strategy A comes closer to the observed sample than strategy B on the same blocks.
struct PairedTest {
  Distances difference;  ///< D(A, observed) - D(B, observed): negative where A is closer
  Distances p_value;     ///< two-sided, 1 / (permutations + 1) .. 1
  /// Paired Cliff's delta over blocks (Cliff 1993; "within-subjects dominance"), -1..1: the share
  /// of blocks in which A's own distance is the larger one, minus the share in which B's is.
  /// Negative where A is closer; 0.15 / 0.33 / 0.47 are commonly read as small / medium / large.
  Distances effect_size;
};

/// A paired permutation test: under the hypothesis that A and B are exchangeable in every block,
/// swapping their labels block by block at random gives the distribution of the difference.
/// p = (1 + number at least as extreme) / (1 + permutations) (Phipson and Smyth 2010).
///
/// Pre: the three samples have the same groups and none is empty (select_groups). Streams come from
/// (seed, permutation): independent of the number of threads. Complexity: O(n log n + permutations
/// n).
PairedTest paired_permutation_test(const GroupedSample& observed, const GroupedSample& a,
                                   const GroupedSample& b, const Bins& bins, int permutations,
                                   std::uint64_t seed, Jobs jobs = {});

}  // namespace plat::statistics
