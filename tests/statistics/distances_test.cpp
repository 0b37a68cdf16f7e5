#include "statistics/distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/failure.h"
#include "support/property.h"

namespace plat::statistics {
namespace {

std::vector<double> random_values(Rng& rng, std::size_t n, bool with_ties) {
  std::vector<double> out(n);
  for (double& v : out) {
    v = rng.normal(10.0, 3.0);
    if (with_ties) v = std::floor(v);
  }
  return out;
}

double share_at_most(const std::vector<double>& values, double limit) {
  const auto count =
      std::count_if(values.begin(), values.end(), [&](double v) { return v <= limit; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

double brute_force_ks(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (const auto* sample : {&a, &b}) {
    for (const double v : *sample)
      largest = std::max(largest, std::abs(share_at_most(a, v) - share_at_most(b, v)));
  }
  return largest;
}

/// Repeats each value so that both samples have n m copies; then sorted values pair up.
double brute_force_wasserstein(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size() * b.size(); ++i)
    sum += std::abs(a[i / b.size()] - b[i / a.size()]);
  return sum / static_cast<double>(a.size() * b.size());
}

TEST(Distances, AgreeWithBruteForce) {
  Rng rng = testing::property_rng("Distances.AgreeWithBruteForce");
  int apart = 0;
  for (int i = 0; i < testing::iterations(200); ++i) {
    const bool with_ties = i % 2 == 0;
    const auto a = random_values(rng, 1 + rng.index(30), with_ties);
    const auto b = random_values(rng, 1 + rng.index(30), with_ties);
    EXPECT_NEAR(ks_statistic(a, b), brute_force_ks(a, b), 1e-12);
    EXPECT_NEAR(wasserstein_1(a, b), brute_force_wasserstein(a, b), 1e-9);
    const Distances all = distances(a, b, shared_bins(a, ValueKind::kContinuous));
    EXPECT_DOUBLE_EQ(all[DistanceKind::kKolmogorovSmirnov], ks_statistic(a, b));
    EXPECT_DOUBLE_EQ(all[DistanceKind::kWasserstein], wasserstein_1(a, b));
    EXPECT_GE(all[DistanceKind::kJensenShannon], 0.0);
    EXPECT_LE(all[DistanceKind::kJensenShannon], 1.0);
    if (all[DistanceKind::kKolmogorovSmirnov] > 0.05) ++apart;
  }
  EXPECT_GT(apart, 100);
}

TEST(Distances, OfAShiftedUniformSampleAreTheShift) {
  std::vector<double> a;
  std::vector<double> b;
  for (int i = 0; i < 1024; ++i) {
    a.push_back(i / 1024.0);
    b.push_back(i / 1024.0 + 0.25);
  }
  EXPECT_NEAR(ks_statistic(a, b), 0.25, 1e-9);
  EXPECT_NEAR(wasserstein_1(a, b), 0.25, 1e-9);
}

TEST(Distances, AreSymmetricAndZeroOnEqualSamples) {
  Rng rng = testing::property_rng("Distances.AreSymmetricAndZeroOnEqualSamples");
  const auto a = random_values(rng, 57, true);
  const auto b = random_values(rng, 41, true);
  const Bins bins = shared_bins(a, ValueKind::kContinuous);
  const Distances ab = distances(a, b, bins);
  const Distances ba = distances(b, a, bins);
  const Distances aa = distances(a, a, bins);
  for (const DistanceKind kind : kDistanceKinds) {
    EXPECT_DOUBLE_EQ(ab[kind], ba[kind]);
    EXPECT_EQ(aa[kind], 0.0);
  }
}

TEST(Distances, WassersteinScalesWithTheUnitAndTheOthersDoNot) {
  Rng rng = testing::property_rng("Distances.WassersteinScalesWithTheUnit");
  auto a = random_values(rng, 60, false);
  auto b = random_values(rng, 80, false);
  const double ks = ks_statistic(a, b);
  const double w = wasserstein_1(a, b);
  for (double& v : a) v *= 1000.0;
  for (double& v : b) v *= 1000.0;
  EXPECT_DOUBLE_EQ(ks_statistic(a, b), ks);
  EXPECT_NEAR(wasserstein_1(a, b), 1000.0 * w, 1e-6);
}

TEST(JensenShannon, IsOneForDisjointAndZeroForProportionalHistograms) {
  EXPECT_DOUBLE_EQ(jensen_shannon(std::vector<double>{3, 0, 1, 0}, std::vector<double>{0, 2, 0, 5}),
                   1.0);
  EXPECT_EQ(jensen_shannon(std::vector<double>{3, 0, 1}, std::vector<double>{6, 0, 2}), 0.0);
}

TEST(JensenShannon, OfTwoCoins) {
  // p = (1, 0), q = (1/2, 1/2): divergence 1/2 log2(4/3) + 1/4 log2(2/3) + 1/4 log2 2.
  const double divergence = 0.5 * std::log2(4.0 / 3.0) + 0.25 * std::log2(2.0 / 3.0) + 0.25;
  EXPECT_NEAR(jensen_shannon(std::vector<double>{4, 0}, std::vector<double>{5, 5}),
              std::sqrt(divergence), 1e-15);
}

TEST(Distances, RefuseAnEmptySample) {
  EXPECT_THROW(ks_statistic({}, std::vector<double>{1.0}), LogicError);
  EXPECT_THROW(jensen_shannon(std::vector<double>{0.0}, std::vector<double>{1.0}), LogicError);
}

TEST(Distances, HaveDistinctNames) {
  std::set<std::string_view> names;
  for (const DistanceKind kind : kDistanceKinds) names.insert(distance_name(kind));
  EXPECT_EQ(names, (std::set<std::string_view>{"ks", "wasserstein", "jensen_shannon"}));
}

}  // namespace
}  // namespace plat::statistics
