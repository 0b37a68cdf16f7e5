#include "statistics/comparison.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>

#include "support/property.h"

namespace plat::statistics {
namespace {

MeasureSamples make_measure(Rng& rng, std::string name, std::size_t blocks, std::size_t parcels,
                            std::size_t layers) {
  MeasureSamples m;
  m.measure = std::move(name);
  const auto fill = [&](GroupedSample& sample, double shift) {
    for (std::size_t b = 0; b < blocks; ++b) {
      const double centre = 5.0 + 0.3 * std::sin(static_cast<double>(b)) + shift;
      std::vector<double> values(1 + rng.index(2 * parcels));
      for (double& v : values) v = std::exp(rng.normal(centre, 0.5));
      sample.add_group(values);
    }
  };
  fill(m.observed, 0.0);
  m.layers.resize(layers);
  for (std::size_t l = 0; l < layers; ++l) fill(m.layers[l], 0.1 * static_cast<double>(l));
  return m;
}

ComparisonOptions quick() {
  ComparisonOptions options;
  options.resamples = 60;
  options.permutations = 60;
  options.noise_repetitions = 60;
  return options;
}

TEST(Compare, GivesOneRowPerMeasureLayerPairAndDistance) {
  Rng rng = testing::property_rng("Compare.GivesOneRow");
  std::vector<MeasureSamples> measures;
  measures.push_back(make_measure(rng, "area", 20, 5, 3));
  measures.push_back(make_measure(rng, "width", 20, 5, 3));
  const Comparison out = compare(measures, quick(), 1);
  EXPECT_EQ(out.distances.size(), 2U * 3U * 3U);
  EXPECT_EQ(out.differences.size(), 2U * 3U * 3U);
  std::uint64_t counted = 0;
  for (const HistogramRow& row : out.histograms) counted += row.count;
  std::size_t values = 0;
  for (const MeasureSamples& m : measures) {
    values += m.observed.values.size();
    for (const GroupedSample& layer : m.layers) values += layer.values.size();
  }
  EXPECT_EQ(counted, values);
  for (const DistanceRow& row : out.distances) {
    ASSERT_TRUE(row.value && row.interval && row.noise_mean && row.noise);
    EXPECT_LE(row.interval->low, row.interval->high);
    EXPECT_EQ(row.n_blocks, 20U);
  }
  for (const DifferenceRow& row : out.differences) EXPECT_GE(row.p_holm, row.p_value);
}

TEST(Compare, DoesNotDependOnTheNumberOfThreads) {
  Rng rng = testing::property_rng("Compare.DoesNotDependOnTheNumberOfThreads");
  const std::vector<MeasureSamples> measures{make_measure(rng, "area", 30, 6, 2)};
  const Comparison one = compare(measures, quick(), 9, Jobs{1});
  const Comparison four = compare(measures, quick(), 9, Jobs{4});
  ASSERT_EQ(one.distances.size(), four.distances.size());
  for (std::size_t i = 0; i < one.distances.size(); ++i) {
    EXPECT_EQ(one.distances[i].value, four.distances[i].value);
    EXPECT_EQ(one.distances[i].interval->low, four.distances[i].interval->low);
    EXPECT_EQ(one.distances[i].noise_mean, four.distances[i].noise_mean);
  }
  for (std::size_t i = 0; i < one.differences.size(); ++i) {
    EXPECT_EQ(one.differences[i].p_holm, four.differences[i].p_holm);
    EXPECT_EQ(one.differences[i].interval.high, four.differences[i].interval.high);
  }
}

TEST(Compare, LeavesOutBlocksThatAStrategyDidNotDivide) {
  Rng rng = testing::property_rng("Compare.LeavesOutBlocks");
  MeasureSamples m = make_measure(rng, "area", 10, 5, 1);
  GroupedSample failing;
  for (std::size_t g = 0; g < 10; ++g)
    failing.add_group(g < 4 ? m.layers[0].group(g) : std::span<const double>{});
  m.layers = {failing, GroupedSample{{}, std::vector<std::size_t>(11, 0)}};
  const Comparison out = compare(std::span(&m, 1), quick(), 3);
  EXPECT_EQ(out.distances[0].n_blocks, 4U);
  EXPECT_EQ(out.distances[0].n_observed, m.observed.offsets[4]);
  const DistanceRow& of_nothing = out.distances[3];
  EXPECT_EQ(of_nothing.layer, 1U);
  EXPECT_FALSE(of_nothing.value || of_nothing.interval || of_nothing.noise_mean);
  EXPECT_TRUE(out.differences.empty());
}

TEST(Compare, OfACityTakesSeconds) {
  Rng rng = testing::property_rng("Compare.OfACityTakesSeconds");
  std::vector<MeasureSamples> measures;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h", "i"})
    measures.push_back(make_measure(rng, name, 732, 18, 3));
  const auto start = std::chrono::steady_clock::now();
  const Comparison out = compare(measures, {}, 1);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(spent.count()));
  EXPECT_EQ(out.distances.size(), 81U);
  // Four seconds on two cores when built with optimisation; the bound leaves room for sanitizers.
  EXPECT_LT(spent.count(), 120.0);
}

}  // namespace
}  // namespace plat::statistics
