#include "statistics/noise_floor.h"

#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "core/failure.h"
#include "core/rng.h"
#include "statistics/bootstrap.h"
#include "statistics/pooled_sample.h"

namespace plat::statistics {

NoiseFloor noise_floor(const GroupedSample& observed, const Bins& bins, int repetitions,
                       std::uint64_t seed, Jobs jobs) {
  expects(repetitions > 0, "at least one repetition");
  expects(observed.groups() >= 2, "halves need two groups");
  const std::array<const GroupedSample*, 1> samples{&observed};
  const PooledSample pool(samples, bins);
  constexpr std::size_t kLanes = PooledSample::kLanes;
  const auto wanted = static_cast<std::size_t>(repetitions);
  std::vector<Distances> drawn((wanted + kLanes - 1) / kLanes * kLanes);
  parallel_for(drawn.size() / kLanes, jobs, [&](std::size_t batch) {
    std::vector<PooledSample::CellWeight> weights = pool.no_weights();
    std::vector<std::size_t> order(pool.groups());
    for (std::size_t l = 0; l < kLanes; ++l) {
      Rng rng(derive_seed(seed, {batch * kLanes + l}));
      std::iota(order.begin(), order.end(), std::size_t{0});
      for (std::size_t i = 0; i < order.size(); ++i) {
        if (i < order.size() / 2) {
          std::swap(order[i], order[i + static_cast<std::size_t>(rng.index(order.size() - i))]);
          weights[order[i]].x[l] = 1;
        } else {
          weights[order[i]].y[l] = 1;
        }
      }
    }
    const auto lanes = pool.distances(weights);
    for (std::size_t l = 0; l < kLanes; ++l) drawn[batch * kLanes + l] = lanes[l];
  });
  drawn.resize(wanted);

  NoiseFloor floor;
  for (const DistanceKind kind : kDistanceKinds) {
    const std::vector<double> values = pick(drawn, kind);
    floor.mean[kind] =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    const Interval interval = percentile_interval(values, 0.95);
    floor.low[kind] = interval.low;
    floor.high[kind] = interval.high;
  }
  return floor;
}

}  // namespace plat::statistics
