#include "sequences/quantisation.h"

#include <gtest/gtest.h>

#include <vector>

namespace plat::sequences {
namespace {

TEST(Quantisation, FindsTheCommonDivisorInDecimalNotation) {
  const auto step = [](std::vector<double> values) { return common_step(values); };
  EXPECT_EQ(step({0.6, 1.5, 0.0}), 0.3);
  EXPECT_EQ(step({2.4, 3.2, 1.0}), 0.2);
  EXPECT_EQ(step({4, 6, 10}), 2.0);
  EXPECT_EQ(step({0.1, 0.25}), 0.05);
  EXPECT_EQ(step({1500, 2500}), 500.0);
  EXPECT_EQ(step({0.0, 0.0}), 1.0);
  EXPECT_EQ(step({}), 1.0);
  EXPECT_EQ(step({123456.7, 0.3}), 0.1);
}

TEST(Quantisation, FindsNoneForWhatWasMeasured) {
  EXPECT_FALSE(common_step(std::vector<double>{1.0 / 3.0}).has_value());
  EXPECT_FALSE(common_step(std::vector<double>{2e9}).has_value());
}

TEST(Quantisation, TellsMultiplesFromOthers) {
  EXPECT_EQ(quantised(3 * 0.2, 0.2).steps, 3);
  EXPECT_TRUE(quantised(0.1 + 0.2, 0.1).is_multiple());
  EXPECT_FALSE(quantised(0.5, 0.2).is_multiple());
  EXPECT_EQ(quantised(0.52, 0.2).steps, 3);
}

}  // namespace
}  // namespace plat::sequences
