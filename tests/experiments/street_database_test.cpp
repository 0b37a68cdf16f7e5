#include "rcksp_scaling/street_database.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "sequences/compiled_problem.h"

namespace plat::rcksp {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

std::set<Pair> pairs_of(const StreetDatabase& street, bool only_free) {
  std::set<Pair> out;
  for (const sequences::Transition& transition : street.database.transitions)
    if (!only_free || transition.cost == 0) out.emplace(transition.from, transition.to);
  return out;
}

TEST(StreetDatabase, HasTheThesissSize) {
  const StreetDatabase street = street_database({}, 1);
  EXPECT_EQ(street.database.elements.size(), 74U);
  EXPECT_EQ(street.database.transitions.size(), 5402U);
  EXPECT_EQ(pairs_of(street, false).size(), 5402U);
  for (const auto& [from, to] : pairs_of(street, false)) EXPECT_NE(from, to);
}

/// The feasible (building, amount) pairs of a street: reached from its beginning and from its end.
std::size_t feasible_pairs(const StreetDatabase& street, int length) {
  const std::size_t n = street.buildings.size();
  const auto levels = static_cast<std::size_t>(length) + 1;
  std::vector<std::vector<bool>> ends(levels, std::vector<bool>(n, false));
  for (std::size_t at = 0; at < levels; ++at) {
    for (std::size_t e = 0; e < n; ++e) {
      const auto own = static_cast<std::size_t>(street.buildings[e].length);
      if (own > at) continue;
      ends[at][e] = own == at;
      for (std::size_t before = 0; before < n; ++before)
        if (before != e && ends[at - own][before]) ends[at][e] = true;
    }
  }
  // All transitions exist in both directions: what can end at an amount can begin so far from the
  // end.
  std::size_t count = 0;
  for (std::size_t at = 0; at < levels; ++at)
    for (std::size_t e = 0; e < n; ++e) {
      const auto own = static_cast<std::size_t>(street.buildings[e].length);
      const std::size_t mirrored = levels - 1 - at + own;
      count += ends[at][e] && mirrored < levels && ends[mirrored][e];
    }
  return count;
}

TEST(StreetDatabase, ComesNearTheThesissNodeCounts) {
  const StreetDatabase street = street_database({}, 1);
  EXPECT_NEAR(static_cast<double>(feasible_pairs(street, 250)), 10e3, 0.06 * 10e3);
  EXPECT_NEAR(static_cast<double>(feasible_pairs(street, 500)), 30e3, 0.05 * 30e3);
  EXPECT_NEAR(static_cast<double>(feasible_pairs(street, 1000)), 66e3, 0.005 * 66e3);
  EXPECT_NEAR(static_cast<double>(feasible_pairs(street, 2500)), 177e3, 0.005 * 177e3);
  EXPECT_NEAR(static_cast<double>(feasible_pairs(street, 10000)), 732e3, 0.005 * 732e3);
}

TEST(StreetDatabase, IsTheSameForTheSameSeedOnly) {
  const StreetDatabase one = street_database({}, 1);
  const StreetDatabase same = street_database({}, 1);
  const StreetDatabase other = street_database({}, 2);
  bool differs = false;
  for (std::size_t i = 0; i < one.database.transitions.size(); ++i) {
    EXPECT_EQ(one.database.transitions[i].cost, same.database.transitions[i].cost);
    differs |= one.database.transitions[i].cost != other.database.transitions[i].cost;
  }
  EXPECT_TRUE(differs);
}

TEST(StreetDatabase, KeepsABuildingsCrossSectionInLargerDatabases) {
  const StreetDatabase few = street_database({.elements = 10}, 1);
  const StreetDatabase many = street_database({.elements = 100, .resources = 4}, 1);
  for (std::size_t i = 0; i < few.buildings.size(); ++i) {
    EXPECT_EQ(few.buildings[i].height_m, many.buildings[i].height_m);
    EXPECT_EQ(few.buildings[i].depth_m, many.buildings[i].depth_m);
  }
}

TEST(StreetDatabase, NestsDensitiesAndSharesOfFreeTransitions) {
  const auto sparse = pairs_of(street_database({.density_01 = 0.1}, 1), false);
  const auto dense = pairs_of(street_database({.density_01 = 0.4}, 1), false);
  EXPECT_NEAR(static_cast<double>(sparse.size()), 540.0, 80.0);
  EXPECT_TRUE(std::ranges::includes(dense, sparse));
  std::set<std::uint32_t> tails;
  for (const auto& [from, to] : sparse) tails.insert(from);
  EXPECT_GT(tails.size(), 70U);  // spread over all buildings, not all pairs of a few
  const auto few = pairs_of(street_database({.zero_cost_share_01 = 0.2}, 1), true);
  const auto many = pairs_of(street_database({.zero_cost_share_01 = 0.9}, 1), true);
  EXPECT_NEAR(static_cast<double>(many.size()), 0.9 * 5402.0, 120.0);
  EXPECT_TRUE(std::ranges::includes(many, few));
  EXPECT_EQ(pairs_of(street_database({.zero_cost_share_01 = 1.0}, 1), true).size(), 5402U);
}

TEST(StreetDatabase, CostsAllTheSameWithoutSpread) {
  const StreetDatabase street = street_database({.cost_spread_01 = 0.0}, 1);
  for (const auto& transition : street.database.transitions)
    EXPECT_EQ(transition.cost, street.database.transitions.front().cost);
}

TEST(StreetProblem, BoundsTheLengthFromBothSidesAndOthersExactly) {
  const CellOptions options{.resources = 3, .length_m = 100.0, .length_slack_m = 1.0};
  const auto problem = street_problem(street_database(options, 1), options);
  ASSERT_EQ(problem.bounds.size(), 3U);
  EXPECT_EQ(problem.bounds[0], (sequences::Bounds{495, 500}));
  EXPECT_EQ(problem.bounds[1].min, problem.bounds[1].max);
  EXPECT_GT(problem.bounds[2].min, 0);
  EXPECT_EQ(compile(problem).graph.dimension_count, 3U);
}

}  // namespace
}  // namespace plat::rcksp
