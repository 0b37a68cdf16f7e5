#pragma once

#include <cstdint>

#include "core/parallel.h"
#include "statistics/distances.h"
#include "statistics/grouped_sample.h"

namespace plat::statistics {

/// What a distance of "no difference" looks like on this place: the distances between two random
/// halves of the observed blocks.
///
/// Mind the sizes. All three distances shrink with the square root of the number of blocks, and a
/// half has half of them: two independent full samples would lie closer by kHalvesToFull, and a
/// strategy that is fitted to the very same blocks may lie closer still. The numbers are not
/// scaled: a strategy below the floor is closer to the place than one half of the place to the
/// other, and that is all it says.
struct NoiseFloor {
  Distances mean;
  Distances low;   ///< 2.5th percentile
  Distances high;  ///< 97.5th percentile
};
inline constexpr double kHalvesToFull = 0.70710678118654752;  ///< sqrt(1/2)

/// Pre: at least two groups, none empty. Streams come from (seed, repetition).
/// Complexity: O(n log n + repetitions n).
NoiseFloor noise_floor(const GroupedSample& observed, const Bins& bins, int repetitions,
                       std::uint64_t seed, Jobs jobs = {});

}  // namespace plat::statistics
