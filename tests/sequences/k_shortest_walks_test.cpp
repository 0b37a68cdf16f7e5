#include "sequences/k_shortest_walks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::property_rng;

/// A graph with its arcs listed; vertex 0 is the source, the last one the sink.
class ListedGraph {
 public:
  struct Arc {
    std::uint32_t tail;
    std::uint32_t head;
    Cost cost;
  };
  ListedGraph(std::uint32_t vertices, std::vector<Arc> arcs)
      : arcs_(std::move(arcs)), labels_(vertices, {kUnreachable, 0}) {
    labels_[sink()] = {0, 0};
    for (std::uint32_t round = 0; round < vertices; ++round)
      for (const Arc& arc : arcs_)
        if (labels_[arc.head].first < kUnreachable)
          labels_[arc.tail] = std::min(labels_[arc.tail], {labels_[arc.head].first + arc.cost,
                                                           labels_[arc.head].second + 1});
  }

  [[nodiscard]] std::uint32_t vertex_count() const {
    return static_cast<std::uint32_t>(labels_.size());
  }
  [[nodiscard]] std::uint32_t source() const { return 0; }
  [[nodiscard]] std::uint32_t sink() const { return vertex_count() - 1; }
  [[nodiscard]] Cost distance(std::uint32_t vertex) const { return labels_[vertex].first; }
  [[nodiscard]] bool is_shortest(std::uint32_t tail, std::uint32_t head, Cost cost) const {
    return labels_[tail] == std::pair(labels_[head].first + cost, labels_[head].second + 1);
  }
  template <class Visit>
  void for_each_arc(std::uint32_t vertex, Visit visit) const {
    ++visits;
    for (std::uint32_t arc = 0; arc < arcs_.size(); ++arc)
      if (arcs_[arc].tail == vertex) visit(arc, arcs_[arc].head, arcs_[arc].cost);
  }
  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }

  mutable int visits = 0;

 private:
  std::vector<Arc> arcs_;
  std::vector<std::pair<Cost, std::uint32_t>> labels_;
};
static_assert(WalkGraph<ListedGraph>);

/// Parallel arcs, loops and circles; no arc leaves the sink. Costs from one up, so that walks of a
/// given cost are finitely many.
ListedGraph random_graph(Rng& rng, std::uint32_t vertices, std::size_t arcs) {
  std::vector<ListedGraph::Arc> out;
  for (std::size_t i = 0; i < arcs; ++i)
    out.push_back({static_cast<std::uint32_t>(rng.index(vertices - 1)),
                   static_cast<std::uint32_t>(rng.index(vertices)),
                   static_cast<Cost>(1 + rng.index(3))});
  return {vertices, out};
}

/// The costs of all walks up to `limit`, ascending, by trying every way.
std::vector<Cost> all_costs(const ListedGraph& graph, Cost limit) {
  std::vector<Cost> found;
  std::vector<std::pair<std::uint32_t, Cost>> open{{graph.source(), 0}};
  while (!open.empty()) {
    const auto [vertex, cost] = open.back();
    open.pop_back();
    if (vertex == graph.sink()) found.push_back(cost);
    for (const auto& arc : graph.arcs())
      if (arc.tail == vertex && cost + arc.cost <= limit)
        open.emplace_back(arc.head, cost + arc.cost);
  }
  std::ranges::sort(found);
  return found;
}

/// What the walk costs by its arcs, or -1 where it is none.
Cost cost_of(const ListedGraph& graph, const Walk& walk) {
  std::uint32_t vertex = graph.source();
  Cost cost = 0;
  for (const auto& [arc, head] : walk.arcs) {
    if (graph.arcs()[arc].tail != vertex || graph.arcs()[arc].head != head) return -1;
    vertex = head;
    cost += graph.arcs()[arc].cost;
  }
  return vertex == graph.sink() ? cost : -1;
}

std::vector<std::uint32_t> arcs_of(const Walk& walk) {
  std::vector<std::uint32_t> arcs;
  for (const auto& step : walk.arcs) arcs.push_back(step.arc);
  return arcs;
}

TEST(KShortestWalks, FindsEveryWalkOnceInOrderOfCost) {
  Rng rng = property_rng("walks");
  int with_many = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const ListedGraph graph = random_graph(rng, 5, 12);
    const std::vector<Cost> costs = all_costs(graph, 9);
    KShortestWalks walks(graph);
    std::set<std::vector<std::uint32_t>> seen;
    Walk walk;
    for (const Cost cost : costs) {
      ASSERT_TRUE(walks.next(walk)) << i;
      ASSERT_EQ(walk.cost, cost) << i;
      ASSERT_EQ(cost_of(graph, walk), cost) << i;
      ASSERT_TRUE(seen.insert(arcs_of(walk)).second) << i;
    }
    const bool has_more = walks.next(walk);
    ASSERT_TRUE(!has_more || walk.cost > 9) << i;
    with_many += costs.size() > 20 ? 1 : 0;
  }
  EXPECT_GT(6 * with_many, iterations(300));
}

TEST(KShortestWalks, EndsWhereThereIsNoFurtherWalk) {
  const ListedGraph graph(4, {{0, 1, 1}, {0, 2, 2}, {1, 3, 1}, {2, 3, 1}, {1, 2, 0}});
  KShortestWalks walks(graph);
  Walk walk;
  for (const Cost cost : {2, 2, 3}) {
    ASSERT_TRUE(walks.next(walk));
    EXPECT_EQ(walk.cost, cost);
  }
  EXPECT_FALSE(walks.next(walk));
  EXPECT_FALSE(walks.next(walk));
}

TEST(KShortestWalks, FindsNothingWhereTheSinkIsOutOfReach) {
  KShortestWalks walks(ListedGraph(3, {{0, 1, 1}, {1, 0, 1}}));
  Walk walk;
  EXPECT_FALSE(walks.next(walk));
  EXPECT_FALSE(walks.next(walk));
}

/// Three ways in a row, each free or for 0 again: of equal costs the youngest candidate first.
TEST(KShortestWalks, GoesDeepAmongEqualCosts) {
  const ListedGraph graph(4, {{0, 1, 0}, {0, 1, 0}, {1, 2, 0}, {1, 2, 0}, {2, 3, 0}, {2, 3, 0}});
  KShortestWalks walks(graph);
  Walk walk;
  std::vector<std::vector<std::uint32_t>> order;
  while (walks.next(walk)) order.push_back(arcs_of(walk));
  ASSERT_EQ(order.size(), 8U);
  EXPECT_EQ(order[0], (std::vector<std::uint32_t>{0, 2, 4}));
  EXPECT_EQ(order[1], (std::vector<std::uint32_t>{1, 2, 4}));
  EXPECT_EQ(order[2], (std::vector<std::uint32_t>{1, 3, 4}));
  EXPECT_EQ(order[3], (std::vector<std::uint32_t>{1, 3, 5}));
}

TEST(KShortestWalks, LeavesOutWhatBeginsLikeAForbiddenWalk) {
  Rng rng = property_rng("forbidden");
  int left_out = 0;
  for (int i = 0; i < iterations(200); ++i) {
    const ListedGraph graph = random_graph(rng, 5, 12);
    const std::size_t count = all_costs(graph, 9).size();
    KShortestWalks all(graph);
    KShortestWalks some(graph);
    // Forbidden: a walk whose last detour takes arc 0.
    const auto is_forbidden = [](const Walk& walk) {
      return walk.fixed > 0 && walk.arcs[walk.fixed - 1].arc == 0;
    };
    std::vector<std::vector<std::uint32_t>> prefixes;
    Walk walk;
    Walk other;
    for (std::size_t w = 0; w < count; ++w) {
      ASSERT_TRUE(all.next(walk));
      const auto arcs = arcs_of(walk);
      const bool is_left_out = std::ranges::any_of(prefixes, [&](const auto& prefix) {
        return arcs.size() >= prefix.size() &&
               std::equal(prefix.begin(), prefix.end(), arcs.begin());
      });
      left_out += is_left_out ? 1 : 0;
      if (is_left_out) continue;
      ASSERT_TRUE(some.next(other)) << i;
      ASSERT_EQ(other.cost, walk.cost) << i;
      if (!is_forbidden(other)) continue;
      some.forbid_extensions();
      const auto forbidden = arcs_of(other);
      prefixes.emplace_back(forbidden.begin(),
                            forbidden.begin() + static_cast<std::ptrdiff_t>(other.fixed));
    }
  }
  EXPECT_GT(left_out, iterations(200));
}

/// A thousand vertices, of which a walk meets few: heaps are not made for the others.
TEST(KShortestWalks, BuildsHeapsOnlyWhereWalksComeBy) {
  std::vector<ListedGraph::Arc> arcs{{0, 1, 1}, {0, 999, 1}, {1, 999, 2}};
  for (std::uint32_t v = 2; v + 1 < 999; ++v) arcs.push_back({v, v + 1, 0});
  arcs.push_back({998, 999, 0});
  arcs.push_back({0, 2, 100});
  KShortestWalks walks(ListedGraph(1000, arcs));
  Walk walk;
  ASSERT_TRUE(walks.next(walk));
  ASSERT_TRUE(walks.next(walk));
  EXPECT_EQ(walk.cost, 3);
  EXPECT_LT(walks.graph().visits, 10);
  ASSERT_TRUE(walks.next(walk));
  EXPECT_EQ(walk.cost, 100);
  EXPECT_EQ(walk.arcs.size(), 998U);
}

}  // namespace
}  // namespace plat::sequences
