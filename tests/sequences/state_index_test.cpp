#include "sequences/state_index.h"

#include <gtest/gtest.h>

#include <map>

#include "core/failure.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

/// Zones of 3 and 2 nodes; at most 4 and 9 of one dimension, of the other at least 2.
SearchGraph two_zones() {
  SearchGraph graph;
  graph.dimension_count = 2;
  graph.zones = {{0, 3, {}, {{0, 4}, {2, kUnbounded}}, {false, false}},
                 {3, 2, {}, {{0, 9}, {2, kUnbounded}}, {true, false}}};
  graph.node_uses.assign(10, 0);
  return graph;
}

void expect_one_to_one(StateIndex index) {
  Rng rng = plat::testing::property_rng("StateIndex");
  std::map<std::pair<std::uint32_t, std::vector<Amount>>, StateIndex::Id> known;
  std::map<StateIndex::Id, int> used;
  for (int i = 0; i < 5'000; ++i) {
    const std::uint32_t zone = rng.index(2) == 0 ? 0 : 1;
    const auto node = static_cast<std::uint32_t>(zone == 0 ? rng.index(3) : 3 + rng.index(2));
    const std::vector<Amount> consumed{static_cast<Amount>(rng.index(zone == 0 ? 5 : 10)),
                                       static_cast<Amount>(rng.index(3))};
    const StateIndex::Id id = index.id(zone, node, consumed.data());
    ASSERT_LT(id, index.size());
    const auto [found, is_new] = known.try_emplace({node, consumed}, id);
    ASSERT_EQ(found->second, id);
    ASSERT_EQ(is_new, ++used[id] == 1);
    std::vector<Amount> back(2);
    ASSERT_EQ(index.state(id, back), node);
    ASSERT_EQ(back, consumed);
  }
  EXPECT_EQ(known.size(), 3U * 5U * 3U + 2U * 10U * 3U);
}

TEST(StateIndex, NumbersStatesOneToOneFromTheStart) {
  const StateIndex index(two_zones(), 105);
  EXPECT_TRUE(index.is_dense());
  EXPECT_EQ(index.size(), 105U);
  expect_one_to_one(index);
}

TEST(StateIndex, NumbersStatesOneToOneWhereTheyAreMet) {
  const StateIndex index(two_zones(), 104);
  EXPECT_FALSE(index.is_dense());
  expect_one_to_one(index);
}

TEST(StateIndex, KeepsItsNumbersWhileItGrows) {
  SearchGraph graph = two_zones();
  graph.zones[0].bounds[0].max = 1'000'000'000;
  StateIndex index(graph, 1'000'000);
  ASSERT_FALSE(index.is_dense());
  for (Amount a = 0; a < 20'000; ++a) {
    const std::vector<Amount> consumed{a * 4096, a % 3};
    ASSERT_EQ(index.id(0, 1, consumed.data()), static_cast<StateIndex::Id>(a));
  }
  for (Amount a = 0; a < 20'000; ++a) {
    const std::vector<Amount> consumed{a * 4096, a % 3};
    ASSERT_EQ(index.id(0, 1, consumed.data()), static_cast<StateIndex::Id>(a));
  }
  EXPECT_GT(index.bytes_held(), 20'000U * 12U);
}

TEST(StateIndex, GivesFreshNumbersToStatesThatItKnows) {
  StateIndex index(two_zones(), 0);
  const std::vector<Amount> consumed{1, 1};
  const StateIndex::Id first = index.fresh_id(1, consumed.data());
  EXPECT_NE(index.fresh_id(1, consumed.data()), first);
}

}  // namespace
}  // namespace plat::sequences
