#include "sequences/monotone_queue.h"

#include <gtest/gtest.h>

#include <queue>

#include "support/property.h"

namespace plat::sequences {
namespace {

TEST(MonotoneQueue, GivesKeysInAscendingOrderAsAnotherQueueDoes) {
  Rng rng = plat::testing::property_rng("MonotoneQueue");
  MonotoneQueue<int> queue;
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> oracle;
  std::uint64_t last = 0;
  for (int i = 0; i < 20'000; ++i) {
    if (oracle.empty() || rng.index(5) < 3) {
      const std::uint64_t key = last + (std::uint64_t{rng.index(1000)} << rng.index(40));
      queue.push(key, i);
      oracle.push(key);
      continue;
    }
    last = queue.pop().key;
    ASSERT_EQ(last, oracle.top());
    oracle.pop();
    ASSERT_EQ(queue.size(), oracle.size());
  }
}

TEST(MonotoneQueue, GivesWhatCameLastAtTheKeyJustTakenNext) {
  MonotoneQueue<int> queue;
  for (const int value : {1, 2, 3}) queue.push(7, value);
  EXPECT_EQ(queue.pop().key, 7U);
  queue.push(7, 4);
  EXPECT_EQ(queue.pop().value, 4);
}

TEST(MonotoneQueue, RefusesAKeyBelowTheLast) {
  MonotoneQueue<int> queue;
  queue.push(7, 1);
  queue.pop();
  EXPECT_THROW(queue.push(6, 1), LogicError);
}

}  // namespace
}  // namespace plat::sequences
