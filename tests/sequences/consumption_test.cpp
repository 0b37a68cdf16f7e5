#include "sequences/consumption.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "sequences/state_groups.h"
#include "sequences/support/random_problems.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::property_rng;
using plat::testing::random_search_graph;

/// Every vector that a state of the zone may have.
std::vector<std::vector<Amount>> all_vectors(const Consumption& consumption, std::uint32_t zone) {
  std::vector<AmountRange> box;
  for (const AmountLimit& limit : consumption.limits(zone)) box.push_back({0, limit.largest});
  std::vector<std::vector<Amount>> all;
  for_each_vector(box, [&](auto vector) { all.emplace_back(vector.begin(), vector.end()); });
  return all;
}

bool is_within(std::span<const AmountRange> box, std::span<const Amount> vector) {
  for (std::size_t d = 0; d < box.size(); ++d)
    if (vector[d] < box[d].low || vector[d] > box[d].high) return false;
  return true;
}

TEST(Consumption, KnowsWhatMayHaveBeenBeforeALink) {
  Rng rng = property_rng("before a link");
  int before = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const SearchGraph graph = random_search_graph(rng);
    if (graph.links.empty()) continue;
    const Consumption consumption(graph);
    const Link& link = graph.links[rng.index(graph.links.size())];
    const auto heads = all_vectors(consumption, consumption.zone_of(link.to));
    const auto& head = heads[rng.index(heads.size())];
    std::vector<AmountRange> box(head.size());
    const bool is_possible = consumption.before_link(link, head, box);
    for (const auto& tail : all_vectors(consumption, consumption.zone_of(link.from))) {
      auto followed = tail;
      const bool leads_there = consumption.follow(link, followed) && followed == head;
      ASSERT_EQ(is_possible && is_within(box, tail), leads_there) << i;
      before += leads_there ? 1 : 0;
    }
  }
  EXPECT_GT(before, iterations(300) / 2);
}

TEST(Consumption, KnowsWhatMayHaveBeenBeforeAnArc) {
  Rng rng = property_rng("before an arc");
  int before = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const SearchGraph graph = random_search_graph(rng);
    const Consumption consumption(graph);
    const auto node = static_cast<std::uint32_t>(rng.index(graph.node_count()));
    const std::uint32_t zone = consumption.zone_of(node);
    const auto vectors = all_vectors(consumption, zone);
    const auto& head = vectors[rng.index(vectors.size())];
    std::vector<AmountRange> box(head.size());
    const bool is_possible = consumption.before_arc(zone, head, graph.uses(node), box);
    for (const auto& tail : vectors) {
      auto followed = tail;
      const bool leads_there =
          consumption.add(zone, followed, graph.uses(node)) && followed == head;
      ASSERT_EQ(is_possible && is_within(box, tail), leads_there) << i;
      before += leads_there ? 1 : 0;
    }
  }
  EXPECT_GT(before, iterations(300) / 2);
}

TEST(StateGroups, NumberEachVectorOfAZoneOnceInTheOrderOfInsertion) {
  Rng rng = property_rng("groups");
  StateGroups groups(2);
  std::map<std::vector<Amount>, std::uint32_t> numbers;  // zone, then amounts: in this order
  for (int i = 0; i < 3000; ++i) {
    const auto zone = static_cast<std::uint32_t>(rng.index(3));
    const std::vector<Amount> consumed{static_cast<Amount>(rng.index(20)),
                                       static_cast<Amount>(rng.index(20))};
    const std::vector<Amount> key{static_cast<Amount>(zone), consumed[0], consumed[1]};
    EXPECT_EQ(groups.find(zone, consumed),
              numbers.contains(key) ? numbers[key] : StateGroups::kNone);
    const auto number = numbers.emplace(key, static_cast<std::uint32_t>(numbers.size()));
    ASSERT_EQ(groups.insert(zone, consumed), number.first->second);
    EXPECT_TRUE(std::ranges::equal(groups.consumed(number.first->second), consumed));
  }
  EXPECT_GT(numbers.size(), 800U);
  for (auto a = numbers.begin(), b = std::next(a); b != numbers.end(); ++a, ++b) {
    EXPECT_TRUE(groups.precedes(a->second, b->second));
    EXPECT_FALSE(groups.precedes(b->second, a->second));
  }
}

}  // namespace
}  // namespace plat::sequences
