#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/parallel.h"
#include "statistics/distances.h"
#include "statistics/grouped_sample.h"
#include "statistics/quantile.h"

namespace plat::statistics {

/// One measure of the parcels of one data set: the observed ones and those of each strategy, over
/// the same blocks in the same order. A block that a strategy could not divide is an empty group.
struct MeasureSamples {
  std::string measure;
  ValueKind kind = ValueKind::kContinuous;
  GroupedSample observed;
  std::vector<GroupedSample> layers;
};

struct ComparisonOptions {
  int resamples = 1000;
  int permutations = 1000;
  int noise_repetitions = 500;
  double level_01 = 0.95;

  static constexpr auto fields() {
    return std::tuple{
        Field{"resamples", &ComparisonOptions::resamples, 20, 1000000,
              "bootstrap resamples of blocks"},
        Field{"permutations", &ComparisonOptions::permutations, 20, 1000000,
              "permutations of the paired test; with m tests in a family, Holm's adjustment cannot "
              "fall below m / (permutations + 1)"},
        Field{"noise_repetitions", &ComparisonOptions::noise_repetitions, 20, 1000000,
              "random halves of the observed blocks"},
        Field{"level_01", &ComparisonOptions::level_01, 0.5, 0.999,
              "share of the bootstrap distribution inside an interval"}};
  }
};

/// One line of distances.csv. What cannot be computed is absent, never a special number: no value
/// where the layer has no parcels, no interval and no floor where fewer than two blocks have.
struct DistanceRow {
  std::string measure;
  std::size_t layer = 0;  ///< index into MeasureSamples::layers
  DistanceKind distance{};
  std::optional<double> value;
  std::optional<Interval> interval;
  std::optional<double> noise_mean;
  std::optional<Interval> noise;  ///< 2.5th and 97.5th percentile
  std::size_t n_observed = 0;     ///< values in the blocks compared
  std::size_t n_generated = 0;
  std::size_t n_blocks = 0;  ///< blocks with values on both sides
};

/// One line of differences.csv: D(layer_a, observed) - D(layer_b, observed), negative where
/// layer_a is closer.
struct DifferenceRow {
  std::string measure;
  DistanceKind distance{};
  std::size_t layer_a = 0;
  std::size_t layer_b = 0;
  double difference = 0.0;
  Interval interval;     ///< bootstrap over blocks
  double p_value = 1.0;  ///< paired permutation test
  double p_holm = 1.0;   ///< adjusted within the family of all measures and pairs of one distance
  double effect_size = 0.0;  ///< paired Cliff's delta over blocks
  std::size_t n_blocks = 0;  ///< blocks with values in all three samples, at least two
};

/// One line of histograms.csv.
struct HistogramRow {
  std::string measure;
  std::optional<std::size_t> layer;  ///< absent: observed
  double bin_low = 0.0;              ///< -infinity in the open bin below
  double bin_high = 0.0;             ///< infinity in the open bin above
  std::uint64_t count = 0;           ///< not normalised; all blocks, all repetitions
};

struct Comparison {
  std::vector<DistanceRow> distances;      ///< by measure, layer, distance
  std::vector<DifferenceRow> differences;  ///< by measure, pair, distance
  std::vector<HistogramRow> histograms;    ///< by measure, observed first, then layers, then bin
};

/// Everything that a report says about one data set. Each distance is taken over the blocks that
/// have values on both sides, so that a strategy is neither punished nor rewarded for blocks it
/// left undivided: those are counted where failures are. Pairs where fewer than two blocks have all
/// three samples have no row. Streams depend on (seed, replicate) only, so all measures and layers
/// meet the same resampled blocks. Same result for any number of threads.
/// Complexity: O(measures layers^2 (resamples + permutations) n).
Comparison compare(std::span<const MeasureSamples> measures, const ComparisonOptions& options,
                   std::uint64_t seed, Jobs jobs = {});

}  // namespace plat::statistics
