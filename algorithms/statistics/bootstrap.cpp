#include "statistics/bootstrap.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/failure.h"
#include "core/rng.h"
#include "statistics/pooled_sample.h"

namespace plat::statistics {

std::vector<Distances> bootstrap_distances(const GroupedSample& a, const GroupedSample& b,
                                           const Bins& bins, int resamples, std::uint64_t seed,
                                           Jobs jobs) {
  expects(resamples > 0, "at least one resample");
  const std::array<const GroupedSample*, 2> samples{&a, &b};
  const PooledSample pool(samples, bins);
  constexpr std::size_t kLanes = PooledSample::kLanes;
  const auto wanted = static_cast<std::size_t>(resamples);
  std::vector<Distances> out((wanted + kLanes - 1) / kLanes * kLanes);
  parallel_for(out.size() / kLanes, jobs, [&](std::size_t batch) {
    std::vector<PooledSample::CellWeight> weights = pool.no_weights();
    for (std::size_t l = 0; l < kLanes; ++l) {
      Rng rng(derive_seed(seed, {batch * kLanes + l}));
      for (std::size_t k = 0; k < pool.groups(); ++k) {
        const auto group = static_cast<std::size_t>(rng.index(pool.groups()));
        ++weights[pool.cell(0, group)].x[l];
        ++weights[pool.cell(1, group)].y[l];
      }
    }
    const auto lanes = pool.distances(weights);
    std::copy(lanes.begin(), lanes.end(),
              out.begin() + static_cast<std::ptrdiff_t>(batch * kLanes));
  });
  out.resize(wanted);
  return out;
}

namespace {

Interval moved_interval(double estimate, std::span<const double> replicates, double level_01,
                        double bias) {
  const Interval raw = percentile_interval(replicates, level_01);
  // Once for the replicates' bias about the estimate, once for the estimate's about the truth.
  return {std::min(estimate, raw.low - 2.0 * bias), std::max(estimate, raw.high - 2.0 * bias)};
}

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Interval distance_interval(double estimate, std::span<const double> replicates, double level_01) {
  const double excess = std::max(0.0, mean_of(replicates) - estimate);
  const Interval moved = moved_interval(estimate, replicates, level_01, excess);
  return {std::max(0.0, moved.low), moved.high};
}

Interval difference_interval(double estimate, std::span<const double> replicates, double level_01) {
  return moved_interval(estimate, replicates, level_01, mean_of(replicates) - estimate);
}

std::vector<double> pick(std::span<const Distances> replicates, DistanceKind kind) {
  std::vector<double> out;
  out.reserve(replicates.size());
  for (const Distances& d : replicates) out.push_back(d[kind]);
  return out;
}

}  // namespace plat::statistics
