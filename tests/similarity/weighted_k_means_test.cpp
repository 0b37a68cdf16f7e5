#include "similarity/weighted_k_means.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/failure.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using Weights = std::vector<double>;

NumberTable random_table(std::size_t rows, std::size_t columns, Rng& rng) {
  NumberTable table{columns, {}};
  for (std::size_t i = 0; i < rows * columns; ++i)
    table.values.push_back(std::floor(rng.uniform(0, 30)));  // whole numbers: rows come twice
  return table;
}

double squared(const NumberTable& a, std::size_t i, const NumberTable& b, std::size_t k,
               const Weights& weights) {
  double sum = 0.0;
  for (std::size_t c = 0; c < a.columns; ++c)
    sum += weights[c] * (a.row(i)[c] - b.row(k)[c]) * (a.row(i)[c] - b.row(k)[c]);
  return sum;
}

std::size_t different_rows(const NumberTable& table) {
  std::set<std::vector<double>> rows;
  for (std::size_t i = 0; i < table.rows(); ++i)
    rows.emplace(table.row(i).begin(), table.row(i).end());
  return rows.size();
}

TEST(WeightedKMeans, FindsGroupsThatLieApart) {
  NumberTable table{1, {0, 1, 2, 100, 101, 102, 1000}};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const auto found = weighted_k_means(table, Weights{1}, 3, rng).clusters;
    ASSERT_EQ(found.members.size(), 3U);
    EXPECT_EQ(found.cluster_of[0], found.cluster_of[2]);
    EXPECT_EQ(found.cluster_of[3], found.cluster_of[5]);
    EXPECT_EQ(std::set(found.cluster_of.begin(), found.cluster_of.end()).size(), 3U);
    EXPECT_EQ(found.representative(found.cluster_of[0]), 1U);
    EXPECT_EQ(found.representative(found.cluster_of[4]), 4U);
  }
}

TEST(WeightedKMeans, HasNoEmptyClusterAndAsManyAsAskedForOrAsDifferentRows) {
  Rng rng = testing::property_rng("WeightedKMeansClusters");
  int fewer_rows = 0;
  for (int round = 0; round < testing::iterations(200); ++round) {
    const NumberTable table = random_table(1 + rng.index(60), 1 + rng.index(2), rng);
    const Weights weights(table.columns, 2.0);
    const std::size_t wanted = 1 + rng.index(50);
    const auto found = weighted_k_means(table, weights, wanted, rng).clusters;
    EXPECT_EQ(found.members.size(), std::min(wanted, different_rows(table)));
    fewer_rows += different_rows(table) < wanted ? 1 : 0;
    std::vector<std::uint32_t> all;
    for (std::size_t k = 0; k < found.members.size(); ++k) {
      EXPECT_FALSE(found.members[k].empty());
      for (const std::uint32_t i : found.members[k]) EXPECT_EQ(found.cluster_of[i], k);
      all.insert(all.end(), found.members[k].begin(), found.members[k].end());
    }
    EXPECT_EQ(all.size(), table.rows());
  }
  EXPECT_GT(fewer_rows, 10);
}

TEST(WeightedKMeans, AClusterThatLosesItsRowsTakesAnother) {
  // From the seeds (3, 1), (1, 1), (0, 2), which k-means++ rarely draws, the second loses all rows.
  const NumberTable table{2, {6, 11, 4, 3, 3, 1, 1, 1, 0, 2, 2, 11}};
  for (std::uint64_t seed = 0; seed < 50000; ++seed) {
    Rng rng(seed);
    const auto found = weighted_k_means(table, Weights{1, 1}, 3, rng);
    ASSERT_EQ(found.clusters.members.size(), 3U);
    for (const auto& members : found.clusters.members) ASSERT_FALSE(members.empty()) << seed;
  }
}

TEST(WeightedKMeans, SumOfSquaresNeverRises) {
  Rng rng = testing::property_rng("WeightedKMeansSum");
  std::size_t steps = 0;
  for (int round = 0; round < testing::iterations(100); ++round) {
    const NumberTable table = random_table(100, 3, rng);
    const auto sums = weighted_k_means(table, Weights{1, 0.5, 3}, 12, rng).sum_of_squares;
    for (std::size_t s = 1; s < sums.size(); ++s) EXPECT_LE(sums[s], sums[s - 1] * (1 + 1e-12));
    steps += sums.size();
  }
  EXPECT_GT(steps, 400U);
}

TEST(WeightedKMeans, SettledRowsAreNearestToTheirOwnMean) {
  Rng rng = testing::property_rng("WeightedKMeansSettled");
  int settled = 0;
  for (int round = 0; round < testing::iterations(100); ++round) {
    const NumberTable table = random_table(80, 2, rng);
    const Weights weights{1, 4};
    const auto found = weighted_k_means(table, weights, 9, rng);
    if (!found.is_settled) continue;
    ++settled;
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const double own = squared(table, i, found.means, found.clusters.cluster_of[i], weights);
      for (std::size_t k = 0; k < found.means.rows(); ++k)
        EXPECT_LE(own, squared(table, i, found.means, k, weights) + 1e-9);
    }
  }
  EXPECT_GT(settled, 50);
}

TEST(WeightedKMeans, StopsAfterTheStepsAllowedAndSaysSo) {
  Rng rng = testing::property_rng("WeightedKMeansSteps");
  const NumberTable table = random_table(500, 3, rng);
  const auto found = weighted_k_means(table, Weights{1, 1, 1}, 20, rng, 2);
  EXPECT_EQ(found.sum_of_squares.size(), 2U);
  EXPECT_FALSE(found.is_settled);
}

TEST(WeightedKMeans, MembersComeNearestToTheMeanFirst) {
  Rng rng = testing::property_rng("WeightedKMeansMembers");
  const NumberTable table = random_table(200, 2, rng);
  const Weights weights{1, 2};
  const auto found = weighted_k_means(table, weights, 10, rng);
  for (std::size_t k = 0; k < found.clusters.members.size(); ++k) {
    double last = 0.0;
    for (const std::uint32_t i : found.clusters.members[k]) {
      const double at = squared(table, i, found.means, k, weights);
      EXPECT_GE(at, last - 1e-9);
      last = at;
    }
  }
}

TEST(WeightedKMeans, SameSeedSameClustersForAnyNumberOfThreads) {
  Rng rng = testing::property_rng("WeightedKMeansThreads");
  const NumberTable table = random_table(2000, 4, rng);
  const Weights weights{1, 1, 2, 0.5};
  std::vector<KMeansResult> results;
  for (const int jobs : {1, 2, 5}) {
    Rng same(7);
    results.push_back(weighted_k_means(table, weights, 40, same, 100, Jobs{jobs}));
    EXPECT_EQ(results.back().clusters, results.front().clusters);
    EXPECT_EQ(results.back().means.values, results.front().means.values);
  }
  Rng other(8);
  EXPECT_NE(weighted_k_means(table, weights, 40, other).clusters, results.front().clusters);
}

TEST(WeightedKMeans, AColumnOfWeightZeroChangesNothing) {
  Rng rng = testing::property_rng("WeightedKMeansZero");
  const NumberTable table = random_table(150, 2, rng);
  NumberTable one{1, {}};
  for (std::size_t i = 0; i < table.rows(); ++i) one.values.push_back(table.row(i)[0]);
  Rng first(3);
  Rng second(3);
  EXPECT_EQ(weighted_k_means(table, Weights{1, 0}, 8, first).clusters,
            weighted_k_means(one, Weights{1}, 8, second).clusters);
}

TEST(WeightedKMeans, ALargeWeightDecidesTheClusters) {
  // Two columns that divide the rows differently.
  const NumberTable table{2, {0, 0, 0, 9, 9, 0, 9, 9, 0, 1, 9, 8}};
  Rng first(1);
  Rng second(1);
  const auto by_x = weighted_k_means(table, Weights{1, 0.01}, 2, first).clusters;
  const auto by_y = weighted_k_means(table, Weights{0.01, 1}, 2, second).clusters;
  EXPECT_EQ(by_x.cluster_of[0], by_x.cluster_of[1]);
  EXPECT_NE(by_x.cluster_of[0], by_x.cluster_of[2]);
  EXPECT_EQ(by_y.cluster_of[0], by_y.cluster_of[2]);
  EXPECT_NE(by_y.cluster_of[0], by_y.cluster_of[1]);
}

TEST(WeightedKMeans, RefusesWhatIsNoTable) {
  Rng rng(1);
  EXPECT_THROW((void)weighted_k_means({1, {}}, Weights{1}, 1, rng), LogicError);
  EXPECT_THROW((void)weighted_k_means({2, {1, 2, 3}}, Weights{1, 1}, 1, rng), LogicError);
  EXPECT_THROW((void)weighted_k_means({1, {1, NAN}}, Weights{1}, 1, rng), LogicError);
  EXPECT_THROW((void)weighted_k_means({1, {1, 2}}, Weights{-1}, 1, rng), LogicError);
  EXPECT_THROW((void)weighted_k_means({1, {1, 2}}, Weights{1, 1}, 1, rng), LogicError);
}

TEST(ClusterCount, IsAPercentageOfTheThings) {
  EXPECT_EQ(cluster_count(2000, 5.0), 100U);
  EXPECT_EQ(cluster_count(13103, 1.0), 131U);
  EXPECT_EQ(cluster_count(10, 1.0), 1U);
}

}  // namespace
}  // namespace plat::similarity
