#include "sequences/given_paths.h"

#include <gtest/gtest.h>

#include "sequences/cheapest_ways.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::property_rng;

SequencePath path_of(Cost cost, std::uint32_t node) { return {cost, {{node, 0}}}; }

TEST(GivenPaths, LeavesOutWhatAnEarlierRunGave) {
  GivenPaths given;
  EXPECT_TRUE(given.add(path_of(1, 0)));
  EXPECT_TRUE(given.add(path_of(2, 1)));
  // A second run, with another path of cost 2 in front.
  EXPECT_FALSE(given.add(path_of(1, 0)));
  EXPECT_TRUE(given.add(path_of(2, 2)));
  EXPECT_FALSE(given.add(path_of(2, 1)));
  EXPECT_TRUE(given.add(path_of(3, 3)));
  EXPECT_EQ(given.count(), 4U);
}

/// Runs with growing limits, each of which orders equal costs at random and cuts where it likes.
TEST(GivenPaths, GivesEveryCostAsOftenAsThereArePathsOfIt) {
  Rng rng = property_rng("GivenPaths");
  for (int round = 0; round < 200; ++round) {
    std::vector<std::pair<Cost, std::uint32_t>> all;
    for (std::uint32_t node = 0; node < 40; ++node)
      all.emplace_back(static_cast<Cost>(rng.index(6)), node);
    GivenPaths given;
    std::vector<Cost> costs;
    for (std::size_t limit = 1; limit < 100; limit *= 4) {
      for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[rng.index(i)]);
      std::ranges::stable_sort(all, {}, [](const auto& path) { return path.first; });
      for (std::size_t i = 0; i < std::min(limit, all.size()) && given.count() < limit; ++i)
        if (given.add(path_of(all[i].first, all[i].second))) costs.push_back(all[i].first);
      ASSERT_EQ(given.count(), std::min(limit, all.size()));
    }
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(costs[i], all[i].first);
  }
}

TEST(CheapestWays, RefusesAWayWhereAsManyAreNoDearer) {
  for (const std::size_t limit : {1U, 3U}) {
    Rng rng = property_rng("CheapestWays");
    CheapestWays ways(limit, 2);
    std::vector<Cost> admitted;
    for (int i = 0; i < 200; ++i) {
      const auto cost = static_cast<Cost>(rng.index(50));
      const auto no_dearer = static_cast<std::size_t>(
          std::ranges::count_if(admitted, [cost](Cost other) { return other <= cost; }));
      ASSERT_EQ(ways.admit(1, cost), no_dearer < limit) << limit << " " << i;
      if (no_dearer < limit) admitted.push_back(cost);
    }
    EXPECT_EQ(ways.states(), 1U);
  }
}

TEST(CheapestWays, TakesNoMoreThanTheLimitOfAState) {
  CheapestWays one(1, 1);
  EXPECT_TRUE(one.admit(0, 9));
  EXPECT_TRUE(one.admit(0, 4));
  EXPECT_TRUE(one.take(0, 4));
  EXPECT_FALSE(one.take(0, 9));
  CheapestWays two(2, 1);
  for (const Cost cost : {9, 8, 7}) EXPECT_TRUE(two.admit(0, cost));
  EXPECT_TRUE(two.take(0, 7));
  EXPECT_TRUE(two.take(0, 8));
  EXPECT_FALSE(two.take(0, 9));
}

TEST(CheapestWays, AdmitsAndTakesEverythingWithoutALimit) {
  CheapestWays all(CheapestWays::kNoLimit, 0);
  for (const Cost cost : {3, 3, 4, 1}) {
    EXPECT_TRUE(all.admit(7, cost));
    EXPECT_TRUE(all.take(7, cost));
  }
  EXPECT_EQ(all.bytes_held(), 0U);
}

}  // namespace
}  // namespace plat::sequences
