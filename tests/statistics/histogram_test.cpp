#include "statistics/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/property.h"

namespace plat::statistics {
namespace {

TEST(SharedBins, LeaveNoValueOut) {
  Rng rng = testing::property_rng("SharedBins.LeaveNoValueOut");
  for (int i = 0; i < testing::iterations(200); ++i) {
    std::vector<double> observed(1 + rng.index(500));
    const double scale = std::pow(10.0, rng.uniform(-3.0, 5.0));
    for (double& v : observed) v = scale * std::exp(rng.normal(0.0, 1.0));
    const Bins bins = shared_bins(observed, ValueKind::kContinuous);
    const auto counts = count_values(observed, bins);
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}), observed.size());
    EXPECT_TRUE(std::is_sorted(bins.edges.begin(), bins.edges.end()));
    EXPECT_LE(bins.count(), 84U);
    EXPECT_GE(bins.edges.size(), 2U);
    for (const double v : observed) {
      const std::size_t bin = bins.index(v);
      EXPECT_LE(bins.low(bin), v);
      EXPECT_LT(v, bins.high(bin));
    }
  }
}

TEST(SharedBins, IgnoreTheOrderOfValues) {
  Rng rng = testing::property_rng("SharedBins.IgnoreTheOrderOfValues");
  std::vector<double> values(300);
  for (double& v : values) v = rng.normal(0.0, 1.0);
  std::vector<double> reversed(values.rbegin(), values.rend());
  EXPECT_EQ(shared_bins(values, ValueKind::kContinuous).edges,
            shared_bins(reversed, ValueKind::kContinuous).edges);
}

TEST(SharedBins, CentreOnWholeNumbersForCounts) {
  const std::vector<double> neighbours{1, 2, 2, 3, 3, 3, 4, 4, 5, 9};
  const Bins bins = shared_bins(neighbours, ValueKind::kInteger);
  for (std::size_t i = 0; i + 1 < bins.edges.size(); ++i) {
    EXPECT_DOUBLE_EQ(bins.edges[i + 1] - bins.edges[i], 1.0);
    EXPECT_DOUBLE_EQ(bins.edges[i] - std::floor(bins.edges[i]), 0.5);
  }
}

TEST(SharedBins, AreNotSetByOneOutlier) {
  std::vector<double> areas;
  for (int i = 0; i < 1000; ++i) areas.push_back(300.0 + i % 200);
  areas.push_back(100000.0);
  const Bins bins = shared_bins(areas, ValueKind::kContinuous);
  EXPECT_LT(bins.edges.back(), 600.0);
  EXPECT_EQ(count_values(areas, bins).back(), 1U);
}

TEST(SharedBins, ServeConstantAndEmptySamples) {
  const std::vector<double> constant(20, 7.0);
  const Bins bins = shared_bins(constant, ValueKind::kContinuous);
  EXPECT_EQ(count_values(constant, bins)[bins.index(7.0)], 20U);
  EXPECT_EQ(bins.index(7.0), 1U);
  EXPECT_GE(shared_bins({}, ValueKind::kInteger).edges.size(), 2U);
}

}  // namespace
}  // namespace plat::statistics
