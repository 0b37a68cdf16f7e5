#include "statistics/comparison.h"

#include <initializer_list>

#include "core/failure.h"
#include "core/rng.h"
#include "statistics/bootstrap.h"
#include "statistics/holm.h"
#include "statistics/noise_floor.h"
#include "statistics/permutation.h"

namespace plat::statistics {
namespace {

constexpr std::size_t kKinds = kDistanceKinds.size();

/// Groups in which every one of the samples has a value.
std::vector<std::size_t> common_groups(std::initializer_list<const GroupedSample*> samples) {
  std::vector<std::size_t> out;
  for (std::size_t g = 0; g < (*samples.begin())->groups(); ++g) {
    bool has_all = true;
    for (const GroupedSample* sample : samples) has_all = has_all && !sample->group(g).empty();
    if (has_all) out.push_back(g);
  }
  return out;
}

struct Seeds {
  std::uint64_t bootstrap;
  std::uint64_t permutation;
  std::uint64_t halves;
};

std::vector<DistanceRow> compare_layer(const MeasureSamples& samples, std::size_t layer,
                                       const Bins& bins, const ComparisonOptions& options,
                                       const Seeds& seeds) {
  const std::vector<std::size_t> blocks =
      common_groups({&samples.observed, &samples.layers[layer]});
  const GroupedSample observed = select_groups(samples.observed, blocks);
  const GroupedSample generated = select_groups(samples.layers[layer], blocks);
  std::vector<DistanceRow> rows(kKinds);
  for (std::size_t k = 0; k < kKinds; ++k) {
    rows[k].measure = samples.measure;
    rows[k].layer = layer;
    rows[k].distance = kDistanceKinds[k];
    rows[k].n_observed = observed.values.size();
    rows[k].n_generated = generated.values.size();
    rows[k].n_blocks = blocks.size();
  }
  if (blocks.empty()) return rows;
  const Distances value = distances(observed.values, generated.values, bins);
  for (DistanceRow& row : rows) row.value = value[row.distance];
  if (blocks.size() < 2) return rows;
  const std::vector<Distances> replicates =
      bootstrap_distances(observed, generated, bins, options.resamples, seeds.bootstrap, Jobs{1});
  const NoiseFloor floor =
      noise_floor(observed, bins, options.noise_repetitions, seeds.halves, Jobs{1});
  for (DistanceRow& row : rows) {
    row.interval =
        distance_interval(value[row.distance], pick(replicates, row.distance), options.level_01);
    row.noise_mean = floor.mean[row.distance];
    row.noise = Interval{floor.low[row.distance], floor.high[row.distance]};
  }
  return rows;
}

std::vector<DifferenceRow> compare_pair(const MeasureSamples& samples, std::size_t a, std::size_t b,
                                        const Bins& bins, const ComparisonOptions& options,
                                        const Seeds& seeds) {
  const std::vector<std::size_t> blocks =
      common_groups({&samples.observed, &samples.layers[a], &samples.layers[b]});
  if (blocks.size() < 2) return {};
  const GroupedSample observed = select_groups(samples.observed, blocks);
  const GroupedSample of_a = select_groups(samples.layers[a], blocks);
  const GroupedSample of_b = select_groups(samples.layers[b], blocks);
  const PairedTest test = paired_permutation_test(observed, of_a, of_b, bins, options.permutations,
                                                  seeds.permutation, Jobs{1});
  // The same seed and the same blocks: replicate r resamples the same blocks for both.
  const auto to_a =
      bootstrap_distances(observed, of_a, bins, options.resamples, seeds.bootstrap, Jobs{1});
  const auto to_b =
      bootstrap_distances(observed, of_b, bins, options.resamples, seeds.bootstrap, Jobs{1});
  std::vector<DifferenceRow> rows;
  for (const DistanceKind kind : kDistanceKinds) {
    std::vector<double> replicates(to_a.size());
    for (std::size_t r = 0; r < to_a.size(); ++r) replicates[r] = to_a[r][kind] - to_b[r][kind];
    DifferenceRow row;
    row.measure = samples.measure;
    row.distance = kind;
    row.layer_a = a;
    row.layer_b = b;
    row.difference = test.difference[kind];
    row.interval = difference_interval(row.difference, replicates, options.level_01);
    row.p_value = test.p_value[kind];
    row.effect_size = test.effect_size[kind];
    row.n_blocks = blocks.size();
    rows.push_back(row);
  }
  return rows;
}

std::vector<HistogramRow> count_layers(const MeasureSamples& samples, const Bins& bins) {
  std::vector<HistogramRow> rows;
  const auto add = [&](std::optional<std::size_t> layer, const GroupedSample& sample) {
    const std::vector<std::uint64_t> counts = count_values(sample.values, bins);
    for (std::size_t i = 0; i < counts.size(); ++i)
      rows.push_back({samples.measure, layer, bins.low(i), bins.high(i), counts[i]});
  };
  add(std::nullopt, samples.observed);
  for (std::size_t l = 0; l < samples.layers.size(); ++l) add(l, samples.layers[l]);
  return rows;
}

void adjust_families(std::vector<DifferenceRow>& rows) {
  for (const DistanceKind kind : kDistanceKinds) {
    std::vector<double> p_values;
    for (const DifferenceRow& row : rows) {
      if (row.distance == kind) p_values.push_back(row.p_value);
    }
    const std::vector<double> adjusted = holm_adjusted(p_values);
    std::size_t next = 0;
    for (DifferenceRow& row : rows) {
      if (row.distance == kind) row.p_holm = adjusted[next++];
    }
  }
}

}  // namespace

Comparison compare(std::span<const MeasureSamples> measures, const ComparisonOptions& options,
                   std::uint64_t seed, Jobs jobs) {
  const Seeds seeds{derive_seed(seed, {seed_key("bootstrap")}),
                    derive_seed(seed, {seed_key("permutation")}),
                    derive_seed(seed, {seed_key("noise floor")})};
  // One task per (measure, layer) and per (measure, pair), each writing only its own slot: enough
  // tasks to fill the machine, and the order of rows is the order of slots.
  struct Task {
    std::size_t measure;
    std::size_t a;
    std::optional<std::size_t> b;
  };
  std::vector<Task> tasks;
  for (std::size_t m = 0; m < measures.size(); ++m) {
    const std::size_t layers = measures[m].layers.size();
    for (const GroupedSample& layer : measures[m].layers)
      expects(layer.groups() == measures[m].observed.groups(), "layers share the observed blocks");
    for (std::size_t a = 0; a < layers; ++a) tasks.push_back({m, a, std::nullopt});
    for (std::size_t a = 0; a < layers; ++a) {
      for (std::size_t b = a + 1; b < layers; ++b) tasks.push_back({m, a, b});
    }
  }
  const std::vector<Bins> bins = parallel_map<Bins>(measures.size(), jobs, [&](std::size_t m) {
    return shared_bins(measures[m].observed.values, measures[m].kind);
  });
  std::vector<std::vector<DistanceRow>> distance_rows(tasks.size());
  std::vector<std::vector<DifferenceRow>> difference_rows(tasks.size());
  parallel_for(tasks.size(), jobs, [&](std::size_t t) {
    const Task& task = tasks[t];
    const MeasureSamples& samples = measures[task.measure];
    if (task.b) {
      difference_rows[t] =
          compare_pair(samples, task.a, *task.b, bins[task.measure], options, seeds);
    } else {
      distance_rows[t] = compare_layer(samples, task.a, bins[task.measure], options, seeds);
    }
  });

  Comparison out;
  for (const auto& rows : distance_rows)
    out.distances.insert(out.distances.end(), rows.begin(), rows.end());
  for (const auto& rows : difference_rows)
    out.differences.insert(out.differences.end(), rows.begin(), rows.end());
  adjust_families(out.differences);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    const std::vector<HistogramRow> rows = count_layers(measures[m], bins[m]);
    out.histograms.insert(out.histograms.end(), rows.begin(), rows.end());
  }
  return out;
}

}  // namespace plat::statistics
