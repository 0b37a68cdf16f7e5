#include "statistics/rank_correlation.h"

#include <gtest/gtest.h>

namespace plat::statistics {
namespace {

using Values = std::vector<double>;

TEST(Midranks, TiesShareTheMeanOfTheirRanks) {
  EXPECT_EQ(midranks(Values{5, 1, 5, 9, 5}), (Values{3, 1, 3, 5, 3}));
  EXPECT_TRUE(midranks(Values{}).empty());
}

TEST(Spearman, IsOneForAnyIncreasingFunctionAndMinusOneForADecreasingOne) {
  EXPECT_DOUBLE_EQ(*spearman(Values{1, 2, 3, 4}, Values{1, 8, 27, 64}), 1.0);
  EXPECT_DOUBLE_EQ(*spearman(Values{1, 2, 3, 4}, Values{9, 3, 1, 0}), -1.0);
}

TEST(Spearman, AgreesWithScipy) {
  // scipy.stats.spearmanr([1, 2, 2, 4, 7, 3], [3, 1, 4, 4, 9, 2])
  EXPECT_NEAR(*spearman(Values{1, 2, 2, 4, 7, 3}, Values{3, 1, 4, 4, 9, 2}), 0.5735294117647058,
              1e-12);
}

TEST(Spearman, IsUnknownForASampleOfOneValue) {
  EXPECT_FALSE(spearman(Values{1, 2, 3}, Values{4, 4, 4}).has_value());
  EXPECT_FALSE(spearman(Values{}, Values{}).has_value());
}

}  // namespace
}  // namespace plat::statistics
