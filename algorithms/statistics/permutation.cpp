#include "statistics/permutation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/failure.h"
#include "core/rng.h"
#include "statistics/swap_pool_internal.h"

namespace plat::statistics {
namespace {

using detail::SwapPool;

/// Differences that are equal but for rounding count as ties, in favour of the null hypothesis.
constexpr double kTieTolerance = 1e-9;

Distances dominance(const GroupedSample& observed, const GroupedSample& a, const GroupedSample& b,
                    const Bins& bins) {
  Distances sum;
  for (std::size_t g = 0; g < observed.groups(); ++g) {
    const Distances to_a = distances(observed.group(g), a.group(g), bins);
    const Distances to_b = distances(observed.group(g), b.group(g), bins);
    for (const DistanceKind kind : kDistanceKinds) {
      const double d = to_a[kind] - to_b[kind];
      const double scale = std::max(to_a[kind], to_b[kind]);
      if (std::abs(d) > kTieTolerance * scale) sum[kind] += d > 0.0 ? 1.0 : -1.0;
    }
  }
  for (const DistanceKind kind : kDistanceKinds)
    sum[kind] /= static_cast<double>(observed.groups());
  return sum;
}

}  // namespace

PairedTest paired_permutation_test(const GroupedSample& observed, const GroupedSample& a,
                                   const GroupedSample& b, const Bins& bins, int permutations,
                                   std::uint64_t seed, Jobs jobs) {
  expects(permutations > 0, "at least one permutation");
  const SwapPool pool(observed, a, b, bins);

  // Slot 0 swaps nothing: what was observed goes through the same arithmetic.
  const auto slots = static_cast<std::size_t>(permutations) + 1;
  constexpr std::size_t kLanes = SwapPool::kLanes;
  const std::size_t passes = (slots + kLanes - 1) / kLanes;
  std::vector<Distances> drawn(passes * kLanes);
  parallel_for(passes, jobs, [&](std::size_t pass) {
    SwapPool::Swaps swaps(pool.groups());
    for (std::size_t l = 0; l < kLanes; ++l) {
      const std::size_t slot = pass * kLanes + l;
      Rng rng(derive_seed(seed, {slot}));
      for (auto& group : swaps) group[l] = slot > 0 && (rng() >> 63) != 0 ? 1 : 0;
    }
    const auto lanes = pool.differences(swaps);
    std::copy(lanes.begin(), lanes.end(),
              drawn.begin() + static_cast<std::ptrdiff_t>(pass * kLanes));
  });

  PairedTest test;
  const Distances to_a = distances(observed.values, a.values, bins);
  const Distances to_b = distances(observed.values, b.values, bins);
  for (const DistanceKind kind : kDistanceKinds) {
    test.difference[kind] = to_a[kind] - to_b[kind];
    const double extreme = std::abs(drawn.front()[kind]) * (1.0 - kTieTolerance);
    std::size_t count = 0;
    for (std::size_t slot = 1; slot < slots; ++slot) {
      if (std::abs(drawn[slot][kind]) >= extreme) ++count;
    }
    test.p_value[kind] = static_cast<double>(count + 1) / static_cast<double>(slots);
  }
  test.effect_size = dominance(observed, a, b, bins);
  return test;
}

}  // namespace plat::statistics
