#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "statistics/bootstrap.h"
#include "statistics/holm.h"
#include "statistics/noise_floor.h"
#include "statistics/permutation.h"
#include "statistics/pooled_sample.h"
#include "statistics/swap_pool_internal.h"
#include "support/property.h"

namespace plat::statistics {
namespace {

constexpr DistanceKind kKs = DistanceKind::kKolmogorovSmirnov;

/// Blocks with an own mean, so that values of a block resemble each other.
GroupedSample clustered(Rng& rng, std::size_t blocks, double mean, double between, double within) {
  GroupedSample out;
  for (std::size_t b = 0; b < blocks; ++b) {
    const double centre = rng.normal(mean, between);
    std::vector<double> values(2 + rng.index(8));
    for (double& v : values) v = rng.normal(centre, within);
    out.add_group(values);
  }
  return out;
}

TEST(PooledSample, AgreesWithThePlainDistancesOnRepeatedGroups) {
  Rng rng = testing::property_rng("PooledSample.AgreesWithThePlainDistances");
  for (int i = 0; i < testing::iterations(60); ++i) {
    const std::size_t blocks = 2 + rng.index(12);
    GroupedSample a = clustered(rng, blocks, 5.0, 2.0, 1.0);
    GroupedSample b = clustered(rng, blocks, 5.5, 2.0, 1.5);
    if (i % 2 == 0) {
      for (double& v : a.values) v = std::round(v);
      for (double& v : b.values) v = std::round(v);
    }
    const Bins bins = shared_bins(a.values, ValueKind::kContinuous);
    const std::array<const GroupedSample*, 2> samples{&a, &b};
    const PooledSample pool(samples, bins);
    auto weights = pool.no_weights();
    std::array<std::vector<double>, PooledSample::kLanes> x;
    std::array<std::vector<double>, PooledSample::kLanes> y;
    for (std::size_t l = 0; l < PooledSample::kLanes; ++l) {
      for (std::size_t k = 0; k < blocks; ++k) {
        const std::size_t g = rng.index(blocks);
        ++weights[pool.cell(0, g)].x[l];
        ++weights[pool.cell(1, g)].y[l];
        x[l].insert(x[l].end(), a.group(g).begin(), a.group(g).end());
        y[l].insert(y[l].end(), b.group(g).begin(), b.group(g).end());
      }
    }
    const auto fast = pool.distances(weights);
    for (std::size_t l = 0; l < PooledSample::kLanes; ++l) {
      const Distances plain = distances(x[l], y[l], bins);
      for (const DistanceKind kind : kDistanceKinds)
        EXPECT_NEAR(fast[l][kind], plain[kind], 1e-12) << distance_name(kind);
    }
  }
}

TEST(Bootstrap, IsTheSameForAnyNumberOfThreads) {
  Rng rng = testing::property_rng("Bootstrap.IsTheSameForAnyNumberOfThreads");
  const GroupedSample a = clustered(rng, 40, 5.0, 2.0, 1.0);
  const GroupedSample b = clustered(rng, 40, 6.0, 2.0, 1.0);
  const Bins bins = shared_bins(a.values, ValueKind::kContinuous);
  const auto one = bootstrap_distances(a, b, bins, 101, 7, Jobs{1});
  const auto four = bootstrap_distances(a, b, bins, 101, 7, Jobs{4});
  ASSERT_EQ(one.size(), 101U);
  for (std::size_t r = 0; r < one.size(); ++r) EXPECT_EQ(one[r].values, four[r].values);
}

TEST(Bootstrap, IsWiderForClusteredValuesThanForIndependentOnes) {
  Rng rng = testing::property_rng("Bootstrap.IsWiderForClusteredValues");
  const GroupedSample a = clustered(rng, 60, 5.0, 3.0, 0.3);
  const GroupedSample b = clustered(rng, 60, 8.0, 3.0, 0.3);
  GroupedSample a_single;
  GroupedSample b_single;
  const std::size_t n = std::min(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < n; ++i) {
    a_single.add_group(std::span(a.values).subspan(i, 1));
    b_single.add_group(std::span(b.values).subspan(i, 1));
  }
  const Bins bins = shared_bins(a.values, ValueKind::kContinuous);
  const auto width = [&](const GroupedSample& x, const GroupedSample& y) {
    const auto interval =
        percentile_interval(pick(bootstrap_distances(x, y, bins, 400, 1), kKs), 0.95);
    return interval.high - interval.low;
  };
  EXPECT_GT(width(a, b), 1.3 * width(a_single, b_single));
}

/// The share of 95 % intervals that hold the true distance.
std::array<double, 3> coverage(double shift, int trials, Rng& rng) {
  const double spread = std::hypot(1.0, 1.0);
  std::array<double, 3> covered{};
  Bins bins;
  for (double e = -4.0; e <= 8.0; e += 0.5) bins.edges.push_back(e);
  const auto cdf = [&](double v, double mean) {
    return 0.5 * std::erfc(-(v - mean) / (spread * std::sqrt(2.0)));
  };
  std::vector<double> p;
  std::vector<double> q;
  for (std::size_t i = 0; i < bins.count(); ++i) {
    p.push_back(cdf(bins.high(i), 0.0) - cdf(bins.low(i), 0.0));
    q.push_back(cdf(bins.high(i), shift) - cdf(bins.low(i), shift));
  }
  Distances truth;
  truth[kKs] = std::erf(shift / (2.0 * spread * std::sqrt(2.0)));
  truth[DistanceKind::kWasserstein] = shift;
  truth[DistanceKind::kJensenShannon] = jensen_shannon(p, q);
  for (int t = 0; t < trials; ++t) {
    const GroupedSample a = clustered(rng, 150, 0.0, 1.0, 1.0);
    const GroupedSample b = clustered(rng, 150, shift, 1.0, 1.0);
    const Distances estimate = distances(a.values, b.values, bins);
    const auto replicates = bootstrap_distances(a, b, bins, 300, rng());
    for (const DistanceKind kind : kDistanceKinds) {
      const auto interval = distance_interval(estimate[kind], pick(replicates, kind), 0.95);
      const bool is_in = interval.low <= truth[kind] && truth[kind] <= interval.high;
      covered[static_cast<std::size_t>(kind)] += is_in ? 1.0 / trials : 0.0;
    }
  }
  return covered;
}

TEST(Bootstrap, CoversTheTrueDistance) {
  Rng rng = testing::property_rng("Bootstrap.CoversTheTrueDistance");
  const auto covered = coverage(1.0, testing::iterations(200), rng);
  for (const DistanceKind kind : kDistanceKinds) {
    const double share = covered[static_cast<std::size_t>(kind)];
    RecordProperty(std::string(distance_name(kind)), std::to_string(share));
    EXPECT_GT(share, 0.82) << distance_name(kind);
  }
}

TEST(SwapPool, AgreesWithThePlainDistancesAfterSwaps) {
  Rng rng = testing::property_rng("SwapPool.AgreesWithThePlainDistances");
  for (int i = 0; i < testing::iterations(60); ++i) {
    // Fewer values than steps: read off at every distinct value.
    const std::size_t blocks = 1 + rng.index(30);
    const GroupedSample observed = clustered(rng, blocks, 5.0, 2.0, 1.0);
    GroupedSample a = clustered(rng, blocks, 5.5, 2.0, 1.5);
    const GroupedSample b = clustered(rng, blocks, 4.5, 2.0, 1.5);
    if (i % 2 == 0) {
      for (double& v : a.values) v = std::round(v);
    }
    const Bins bins = shared_bins(observed.values, ValueKind::kContinuous);
    const detail::SwapPool pool(observed, a, b, bins);
    detail::SwapPool::Swaps swaps(blocks);
    for (auto& group : swaps) {
      for (auto& lane : group) lane = static_cast<std::int32_t>(rng.index(2));
    }
    const auto fast = pool.differences(swaps);
    for (std::size_t l = 0; l < fast.size(); ++l) {
      GroupedSample of_a;
      GroupedSample of_b;
      for (std::size_t g = 0; g < blocks; ++g) {
        of_a.add_group(swaps[g][l] != 0 ? b.group(g) : a.group(g));
        of_b.add_group(swaps[g][l] != 0 ? a.group(g) : b.group(g));
      }
      const Distances to_a = distances(observed.values, of_a.values, bins);
      const Distances to_b = distances(observed.values, of_b.values, bins);
      for (const DistanceKind kind : kDistanceKinds)
        EXPECT_NEAR(fast[l][kind], to_a[kind] - to_b[kind], 1e-12) << distance_name(kind);
    }
  }
}

TEST(SwapPool, IsCloseToThePlainDistancesOnLargeSamples) {
  Rng rng = testing::property_rng("SwapPool.IsCloseOnLargeSamples");
  const GroupedSample observed = clustered(rng, 2000, 5.0, 2.0, 1.0);
  const GroupedSample a = clustered(rng, 2000, 5.5, 2.0, 1.5);
  const GroupedSample b = clustered(rng, 2000, 4.8, 2.0, 1.5);
  const Bins bins = shared_bins(observed.values, ValueKind::kContinuous);
  const auto fast = detail::SwapPool(observed, a, b, bins)
                        .differences(detail::SwapPool::Swaps(observed.groups()))[0];
  const Distances to_a = distances(observed.values, a.values, bins);
  const Distances to_b = distances(observed.values, b.values, bins);
  for (const DistanceKind kind : kDistanceKinds)
    EXPECT_NEAR(fast[kind], to_a[kind] - to_b[kind], 0.005) << distance_name(kind);
}

TEST(PermutationTest, FindsThatTheNearerStrategyIsNearer) {
  Rng rng = testing::property_rng("PermutationTest.FindsTheNearer");
  const GroupedSample observed = clustered(rng, 80, 0.0, 1.0, 1.0);
  const GroupedSample near = clustered(rng, 80, 0.1, 1.0, 1.0);
  const GroupedSample far = clustered(rng, 80, 3.0, 1.0, 1.0);
  const Bins bins = shared_bins(observed.values, ValueKind::kContinuous);
  const PairedTest test = paired_permutation_test(observed, near, far, bins, 199, 5);
  const PairedTest swapped = paired_permutation_test(observed, far, near, bins, 199, 5);
  for (const DistanceKind kind : kDistanceKinds) {
    EXPECT_LT(test.difference[kind], 0.0);
    EXPECT_DOUBLE_EQ(test.p_value[kind], 1.0 / 200.0);
    EXPECT_LT(test.effect_size[kind], -0.25);
    EXPECT_DOUBLE_EQ(swapped.difference[kind], -test.difference[kind]);
    EXPECT_DOUBLE_EQ(swapped.p_value[kind], test.p_value[kind]);
    EXPECT_DOUBLE_EQ(swapped.effect_size[kind], -test.effect_size[kind]);
  }
}

TEST(PermutationTest, OfEqualStrategiesSaysNothing) {
  Rng rng = testing::property_rng("PermutationTest.OfEqualStrategies");
  const GroupedSample observed = clustered(rng, 30, 0.0, 1.0, 1.0);
  const GroupedSample a = clustered(rng, 30, 0.5, 1.0, 1.0);
  const Bins bins = shared_bins(observed.values, ValueKind::kContinuous);
  const PairedTest test = paired_permutation_test(observed, a, a, bins, 99, 5);
  for (const DistanceKind kind : kDistanceKinds) {
    EXPECT_EQ(test.difference[kind], 0.0);
    EXPECT_EQ(test.p_value[kind], 1.0);
    EXPECT_EQ(test.effect_size[kind], 0.0);
  }
}

TEST(PermutationTest, HasUniformPValuesUnderTheNullHypothesis) {
  Rng rng = testing::property_rng("PermutationTest.HasUniformPValues");
  const int trials = testing::iterations(300);
  std::array<int, 3> below_10{};
  std::array<int, 3> below_50{};
  for (int t = 0; t < trials; ++t) {
    const GroupedSample observed = clustered(rng, 25, 0.0, 1.0, 1.0);
    const GroupedSample a = clustered(rng, 25, 0.7, 1.0, 1.0);
    const GroupedSample b = clustered(rng, 25, 0.7, 1.0, 1.0);
    const Bins bins = shared_bins(observed.values, ValueKind::kContinuous);
    const PairedTest test = paired_permutation_test(observed, a, b, bins, 99, rng());
    for (const DistanceKind kind : kDistanceKinds) {
      if (test.p_value[kind] <= 0.1) ++below_10[static_cast<std::size_t>(kind)];
      if (test.p_value[kind] <= 0.5) ++below_50[static_cast<std::size_t>(kind)];
    }
  }
  // Four standard errors of a binomial share around 0.1 and 0.5.
  const double four_errors_10 = 4.0 * std::sqrt(0.1 * 0.9 / trials);
  const double four_errors_50 = 4.0 * std::sqrt(0.25 / trials);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(static_cast<double>(below_10[k]) / trials, 0.1, four_errors_10);
    EXPECT_NEAR(static_cast<double>(below_50[k]) / trials, 0.5, four_errors_50);
  }
}

TEST(NoiseFloor, ShrinksWithTheSquareRootOfTheNumberOfBlocks) {
  Rng rng = testing::property_rng("NoiseFloor.Shrinks");
  const GroupedSample small = clustered(rng, 100, 0.0, 1.0, 1.0);
  const GroupedSample large = clustered(rng, 1600, 0.0, 1.0, 1.0);
  const Bins bins = shared_bins(large.values, ValueKind::kContinuous);
  const NoiseFloor of_small = noise_floor(small, bins, 200, 1);
  const NoiseFloor of_large = noise_floor(large, bins, 200, 1);
  for (const DistanceKind kind : kDistanceKinds) {
    EXPECT_NEAR(of_small.mean[kind] / of_large.mean[kind], 4.0, 1.2) << distance_name(kind);
    EXPECT_LT(of_small.low[kind], of_small.mean[kind]);
    EXPECT_GT(of_small.high[kind], of_small.mean[kind]);
  }
}

TEST(NoiseFloor, OfHalvesIsTheFullSizeFloorOverHalvesToFull) {
  // Two independent samples of n blocks, many times, against halves of one sample of n.
  Rng rng = testing::property_rng("NoiseFloor.OfHalves");
  Bins bins;
  for (double e = -4.0; e <= 4.0; e += 0.5) bins.edges.push_back(e);
  double full = 0.0;
  double halves = 0.0;
  for (int i = 0; i < 60; ++i) {
    const GroupedSample a = clustered(rng, 100, 0.0, 1.0, 1.0);
    const GroupedSample b = clustered(rng, 100, 0.0, 1.0, 1.0);
    full += distances(a.values, b.values, bins)[kKs];
    halves += noise_floor(a, bins, 20, rng()).mean[kKs];
  }
  EXPECT_NEAR(full / halves, kHalvesToFull, 0.12);
}

TEST(Holm, AdjustsATextbookFamily) {
  // 0.005 x 4, 0.01 x 3, 0.03 x 2, 0.04 x 1 raised to 0.06.
  const std::vector<double> p{0.01, 0.04, 0.03, 0.005};
  const std::vector<double> adjusted = holm_adjusted(p);
  const std::vector<double> wanted{0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_DOUBLE_EQ(adjusted[i], wanted[i]);
}

TEST(Holm, NeverExceedsOneAndServesAnEmptyFamily) {
  EXPECT_EQ(holm_adjusted(std::vector<double>{0.9, 0.8}), (std::vector<double>{1.0, 1.0}));
  EXPECT_TRUE(holm_adjusted({}).empty());
}

}  // namespace
}  // namespace plat::statistics
