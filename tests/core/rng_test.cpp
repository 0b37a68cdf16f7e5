#include "core/rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/failure.h"

namespace plat {
namespace {

TEST(Rng, FirstValuesAreFrozen) {
  // Every published result depends on these: a change here changes them all.
  Rng rng(1);
  EXPECT_EQ(rng(), 12966619160104079557ULL);
  EXPECT_EQ(rng(), 9600361134598540522ULL);
  EXPECT_EQ(rng(), 10590380919521690900ULL);
  Rng zero(0);
  EXPECT_EQ(zero(), 11091344671253066420ULL);
}

TEST(Rng, FirstNormalsAndUniformsAreFrozen) {
  Rng rng(1);
  EXPECT_DOUBLE_EQ(rng.uniform_01(), 0.70292183315885048);
  EXPECT_DOUBLE_EQ(rng.normal(0.0, 1.0), -0.3676778609677715);
}

TEST(Rng, SameSeedSameStream) {
  Rng a(42);
  Rng b(42);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(a(), b());
}

TEST(Rng, UniformHasItsMomentsAndRange) {
  Rng rng(3);
  constexpr int kDraws = 200'000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = rng.uniform(-2.0, 4.0);
    ASSERT_GE(x, -2.0);
    ASSERT_LT(x, 4.0);
    sum += x;
    squares += x * x;
  }
  const double mean = sum / kDraws;
  EXPECT_NEAR(mean, 1.0, 4.0 * std::sqrt(3.0 / kDraws));
  EXPECT_NEAR(squares / kDraws - mean * mean, 3.0, 0.03);
}

TEST(Rng, NormalHasItsMomentsAndTails) {
  Rng rng(4);
  constexpr int kDraws = 200'000;
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = (rng.normal(10.0, 2.0) - 10.0) / 2.0;
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    beyond_two += std::abs(x) > 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 0.02);
  EXPECT_NEAR(fourth / kDraws, 3.0, 0.12);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kDraws, 0.0455, 0.003);
}

TEST(Rng, IndexIsUniformAndStaysInRange) {
  Rng rng(5);
  constexpr int kDraws = 70'000;
  int counts[7] = {};
  for (int i = 0; i < kDraws; ++i) ++counts[rng.index(7)];
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 7, 500);
}

TEST(Rng, IndexOfAnEmptyRangeIsOurFault) {
  Rng rng(5);
  EXPECT_THROW(rng.index(0), LogicError);
}

TEST(DeriveSeed, DependsOnEveryKeyAndOnTheirOrder) {
  const std::set<std::uint64_t> seeds{derive_seed(1, {}),     derive_seed(2, {}),
                                      derive_seed(1, {0}),    derive_seed(1, {1, 2}),
                                      derive_seed(1, {2, 1}), derive_seed(1, {1, 2, 0}),
                                      derive_seed(1, {1}),    derive_seed(2, {1})};
  EXPECT_EQ(seeds.size(), 8U);
}

TEST(DeriveSeed, StreamsOfNeighbouringKeysAreIndependent) {
  // Correlation of the first draws over pairs of neighbouring streams, and of each stream's
  // successive draws.
  constexpr int kStreams = 20'000;
  double across = 0.0;
  double along = 0.0;
  double previous = 0.0;
  for (std::uint64_t k = 0; k < kStreams; ++k) {
    Rng rng(derive_seed(9, {k}));
    const double x = rng.uniform(-1.0, 1.0);
    const double y = rng.uniform(-1.0, 1.0);
    across += 3.0 * x * previous / kStreams;
    along += 3.0 * x * y / kStreams;
    previous = x;
  }
  EXPECT_NEAR(across, 0.0, 4.0 / std::sqrt(kStreams));
  EXPECT_NEAR(along, 0.0, 4.0 / std::sqrt(kStreams));
}

TEST(SeedKey, IsFnv1a) {
  EXPECT_EQ(seed_key(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(seed_key("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(seed_key("foobar"), 0x85944171f73967e8ULL);
}

}  // namespace
}  // namespace plat
