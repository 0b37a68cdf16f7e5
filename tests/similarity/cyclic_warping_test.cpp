#include "similarity/cyclic_warping.h"

#include <limits>

#include "support/property.h"

namespace plat::similarity {
namespace {

using plat::testing::iterations;
using plat::testing::property_rng;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Costs are floats between 0 and 1, sums are doubles.
constexpr double kRounding = 1e-9;

using Costs = std::vector<float>;

/// The cheapest closed warping through (0, begin), cell by cell on the torus laid open.
double cheapest_from(std::size_t n, const Costs& costs, std::size_t begin) {
  std::vector<std::vector<double>> reached(n + 1, std::vector<double>(n + 1, kInfinity));
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= n; ++j) {
      if (i == 0 && j == 0) {
        reached[i][j] = 0.0;
        continue;
      }
      const double before =
          std::min({i > 0 ? reached[i - 1][j] : kInfinity, j > 0 ? reached[i][j - 1] : kInfinity,
                    i > 0 && j > 0 ? reached[i - 1][j - 1] : kInfinity});
      reached[i][j] = before + costs[(i % n) * n + (begin + j) % n];
    }
  return reached[n][n];
}

double brute_force(std::size_t n, const Costs& costs) {
  double best = kInfinity;
  for (std::size_t begin = 0; begin < n; ++begin)
    best = std::min(best, cheapest_from(n, costs, begin));
  return best;
}

/// Unrelated costs, costs with many ties, or those of two turned rings that are alike.
Costs random_costs(Rng& rng, std::size_t n) {
  Costs costs(n * n);
  const std::uint64_t kind = rng.index(3);
  std::vector<double> a;
  for (std::size_t i = 0; i < n; ++i) a.push_back(rng.uniform_01());
  const std::size_t turn = rng.index(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (kind == 0) costs[i * n + j] = static_cast<float>(rng.uniform_01());
      if (kind == 1) costs[i * n + j] = static_cast<float>(rng.index(3));
      if (kind == 2)
        costs[i * n + j] =
            static_cast<float>(std::abs(a[i] - a[(j + turn) % n]) + 0.05 * rng.uniform_01());
    }
  return costs;
}

TEST(CyclicWarping, IsAsCheapAsTheCheapestOfAllBegins) {
  Rng rng = property_rng("CyclicWarping.Oracle");
  for (int i = 0; i < iterations(2000); ++i) {
    const std::size_t n = 1 + rng.index(24);
    const Costs costs = random_costs(rng, n);
    EXPECT_NEAR(cheapest_cyclic_warping(n, costs).cost, brute_force(n, costs), kRounding) << n;
  }
}

TEST(CyclicWarping, MatchesGoOnceAroundBothRingsAndCostWhatIsSaid) {
  Rng rng = property_rng("CyclicWarping.Matches");
  for (int i = 0; i < iterations(1000); ++i) {
    const std::size_t n = 2 + rng.index(24);
    const Costs costs = random_costs(rng, n);
    const CyclicWarping warping = cheapest_cyclic_warping(n, costs);
    const auto& matches = warping.matches;
    ASSERT_EQ(matches.front().first, 0U);
    double sum = 0.0;
    std::size_t around_first = 0;
    std::size_t around_second = 0;
    for (std::size_t k = 0; k < matches.size(); ++k) {
      const auto [a, b] = matches[k];
      const auto [next_a, next_b] = matches[(k + 1) % matches.size()];
      sum += costs[a * n + b];
      const std::size_t step_a = (next_a + n - a) % n;
      const std::size_t step_b = (next_b + n - b) % n;
      ASSERT_LE(std::max(step_a, step_b), 1U);
      ASSERT_GE(step_a + step_b, 1U);
      around_first += step_a;
      around_second += step_b;
      if (k + 1 < matches.size()) {
        ASSERT_LE(a, next_a);
      }
    }
    EXPECT_EQ(around_first, n);
    EXPECT_EQ(around_second, n);
    EXPECT_NEAR(sum, warping.cost, kRounding);
  }
}

TEST(CyclicWarping, CostsTheSameForRingsExchangedOrBegunElsewhere) {
  Rng rng = property_rng("CyclicWarping.Turned");
  for (int i = 0; i < iterations(500); ++i) {
    const std::size_t n = 1 + rng.index(30);
    const Costs costs = random_costs(rng, n);
    const double cost = cheapest_cyclic_warping(n, costs).cost;
    const std::size_t by_a = rng.index(n);
    const std::size_t by_b = rng.index(n);
    Costs turned(n * n);
    Costs exchanged(n * n);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        turned[((a + by_a) % n) * n + (b + by_b) % n] = costs[a * n + b];
        exchanged[b * n + a] = costs[a * n + b];
      }
    EXPECT_NEAR(cheapest_cyclic_warping(n, turned).cost, cost, kRounding);
    EXPECT_NEAR(cheapest_cyclic_warping(n, exchanged).cost, cost, kRounding);
  }
}

TEST(CyclicWarping, DwellsWhereOneRingIsStretched) {
  // Four places, of which the second ring has the first three times and lacks the third.
  const std::vector<int> a{0, 1, 2, 3};
  const std::vector<int> b{0, 0, 1, 3};
  Costs costs;
  for (const int p : a)
    for (const int q : b) costs.push_back(p == q ? 0.0F : 1.0F);
  const CyclicWarping warping = cheapest_cyclic_warping(4, costs);
  EXPECT_EQ(warping.cost, 1.0);  // the third has no like
  EXPECT_EQ(warping.matches.size(), 5U);
}

}  // namespace
}  // namespace plat::similarity
