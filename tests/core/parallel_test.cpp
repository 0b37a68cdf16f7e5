#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "core/rng.h"

namespace plat {
namespace {

std::vector<double> draws(int jobs) {
  return parallel_map<double>(500, Jobs{jobs}, [](std::size_t i) {
    Rng rng(derive_seed(1, {i}));
    double sum = 0.0;
    for (std::size_t k = 0; k <= i % 97; ++k) sum += rng.normal(0.0, 1.0);
    return sum;
  });
}

TEST(ParallelMap, ResultDoesNotDependOnTheThreadCount) {
  const std::vector<double> one = draws(1);
  EXPECT_EQ(one, draws(2));
  EXPECT_EQ(one, draws(4));
  EXPECT_EQ(one, draws(0));
}

TEST(ParallelFor, CallsEveryIndexOnce) {
  std::vector<std::atomic<int>> calls(1000);
  parallel_for(calls.size(), Jobs{4}, [&](std::size_t i) { ++calls[i]; });
  for (const auto& count : calls) ASSERT_EQ(count.load(), 1);
}

TEST(ParallelFor, NothingToDoIsFine) {
  parallel_for(0, Jobs{2}, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, ExceptionReachesTheCaller) {
  for (const int jobs : {1, 2, 4}) {
    EXPECT_THROW(parallel_for(100, Jobs{jobs},
                              [](std::size_t i) {
                                if (i == 37) throw std::domain_error("37");
                              }),
                 std::domain_error);
  }
}

}  // namespace
}  // namespace plat
