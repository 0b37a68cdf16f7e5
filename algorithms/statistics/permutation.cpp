#include "statistics/permutation.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/failure.h"
#include "core/rng.h"
#include "statistics/pooled_sample.h"

namespace plat::statistics {
namespace {

/// Differences that are equal but for rounding count as ties, in favour of the null hypothesis.
constexpr double kTieTolerance = 1e-12;

/// Lanes 2k and 2k + 1 of a pass hold A and B against observed, after the labels were swapped.
constexpr std::size_t kPerPass = PooledSample::kLanes / 2;

void set_labels(const PooledSample& pool, std::vector<PooledSample::CellWeight>& weights,
                std::size_t group, std::size_t slot, bool is_swapped) {
  const std::int32_t kept = is_swapped ? 0 : 1;
  const std::size_t lane_a = 2 * slot;
  const std::size_t lane_b = lane_a + 1;
  weights[pool.cell(0, group)].x[lane_a] = 1;
  weights[pool.cell(0, group)].x[lane_b] = 1;
  weights[pool.cell(1, group)].y[lane_a] = kept;
  weights[pool.cell(1, group)].y[lane_b] = 1 - kept;
  weights[pool.cell(2, group)].y[lane_a] = 1 - kept;
  weights[pool.cell(2, group)].y[lane_b] = kept;
}

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
  const std::array<const GroupedSample*, 3> samples{&observed, &a, &b};
  const PooledSample pool(samples, bins);

  // Slot 0 of the first pass is the identity: what was observed goes through the same arithmetic.
  const auto slots = static_cast<std::size_t>(permutations) + 1;
  const std::size_t passes = (slots + kPerPass - 1) / kPerPass;
  std::vector<Distances> differences(passes * kPerPass);
  parallel_for(passes, jobs, [&](std::size_t pass) {
    std::vector<PooledSample::CellWeight> weights = pool.no_weights();
    for (std::size_t k = 0; k < kPerPass; ++k) {
      const std::size_t slot = pass * kPerPass + k;
      Rng rng(derive_seed(seed, {slot}));
      for (std::size_t g = 0; g < pool.groups(); ++g)
        set_labels(pool, weights, g, k, slot > 0 && (rng() >> 63) != 0);
    }
    const auto lanes = pool.distances(weights);
    for (std::size_t k = 0; k < kPerPass; ++k) {
      for (const DistanceKind kind : kDistanceKinds)
        differences[pass * kPerPass + k][kind] = lanes[2 * k][kind] - lanes[2 * k + 1][kind];
    }
  });

  PairedTest test;
  test.difference = differences.front();
  for (const DistanceKind kind : kDistanceKinds) {
    const double extreme = std::abs(differences.front()[kind]) * (1.0 - kTieTolerance);
    std::size_t count = 0;
    for (std::size_t slot = 1; slot < slots; ++slot) {
      if (std::abs(differences[slot][kind]) >= extreme) ++count;
    }
    test.p_value[kind] = static_cast<double>(count + 1) / static_cast<double>(slots);
  }
  test.effect_size = dominance(observed, a, b, bins);
  return test;
}

}  // namespace plat::statistics
