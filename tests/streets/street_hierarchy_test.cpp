#include "streets/street_hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "streets/network_cleaning.h"
#include "support/property.h"
#include "support/random_streets.h"
#include "support/street_map.h"

namespace plat::streets {
namespace {

using plat::testing::ascii_points;
using plat::testing::random_streets;
using plat::testing::streets_on;

struct Ordered {
  StreetNetwork network;
  std::vector<StreetChain> chains;
};

Ordered ordered(std::vector<RawStreet> raw, const HierarchyOptions& options = {}) {
  Ordered out{build_network(raw).network, {}};
  for (Street& street : out.network.streets)
    street.width_m = street.attributes.given_width_m.value_or(10.0);
  out.chains = chains_of(out.network);
  assign_hierarchy(out.network, out.chains, options);
  return out;
}

/// The level of the chain that holds a piece of the raw street `id`.
int level_of(const Ordered& city, std::string_view id) {
  for (const StreetChain& chain : city.chains) {
    for (const StreetChain::Piece& piece : chain.pieces) {
      if (city.network.streets[piece.street].source_id == id) return chain.hierarchy;
    }
  }
  return -1;
}

TEST(AssignHierarchy, CountsBranchingsFromTheMainStreet) {
  const auto places = ascii_points(R"(
         G
      D
      P  Q  R
     A        B
      C
  )",
                                   50.0);
  const Ordered city = ordered(streets_on(places, {"AB", "CD", "PQR", "QG"}));
  EXPECT_EQ(level_of(city, "AB"), 0);
  EXPECT_EQ(level_of(city, "CD"), 1);
  EXPECT_EQ(level_of(city, "PQR"), 2);
  EXPECT_EQ(level_of(city, "QG"), 3);
}

TEST(AssignHierarchy, LoopTakesTheShorterWay) {
  // QE begins at PT of level 2, and ends at the main street.
  const auto places = ascii_points(R"(
      D
      P   Q T
     A    E    B
      C
  )",
                                   50.0);
  const Ordered city = ordered(streets_on(places, {"AB", "CD", "PQT", "QE"}));
  EXPECT_EQ(level_of(city, "PQT"), 2);
  EXPECT_EQ(level_of(city, "QE"), 1);
}

TEST(AssignHierarchy, WidthMakesAStreetImportant) {
  const auto places = ascii_points(R"(
       D
     A  . B
       C
  )",
                                   50.0);
  auto raw = streets_on(places, {"AB", "CD"});
  raw[1].attributes.given_width_m = 40.0;
  EXPECT_EQ(level_of(ordered(raw), "CD"), 0);
  EXPECT_EQ(level_of(ordered(raw), "AB"), 1);
  EXPECT_EQ(level_of(ordered(raw, {.importance = Importance::kLength}), "AB"), 0);
  raw[1].attributes.given_width_m = 14.0;  // wider, but 1.5 times shorter
  EXPECT_EQ(level_of(ordered(raw), "AB"), 0);
  EXPECT_EQ(level_of(ordered(raw, {.importance = Importance::kWidth}), "CD"), 0);
}

TEST(AssignHierarchy, BridgeDoesNotMeetWhatItCrosses) {
  const auto places = ascii_points(R"(
        D
     A    B
     E    F
        C
  )",
                                   50.0);
  auto raw = streets_on(places, {"AB", "CD", "EF"});
  raw[0].attributes.level = 1;
  raw[0].attributes.given_width_m = 30.0;
  const Ordered city = ordered(raw);
  EXPECT_EQ(level_of(city, "AB"), 0);
  EXPECT_EQ(level_of(city, "EF") + level_of(city, "CD"), 1);  // a part of its own: 0 and 1
}

TEST(AssignHierarchy, ShareOfTheChainsIsMainAtLeastOne) {
  std::vector<RawStreet> raw;
  for (int i = 0; i < 20; ++i)
    raw.push_back({std::to_string(i), {{0.0, 50.0 * i}, {500.0 + i, 50.0 * i}}, {}});
  raw.push_back({"across", {{100.0, -10.0}, {100.0, 960.0}}, {}});
  for (const auto& [share, count] : {std::pair{0.0, 1}, {0.1, 2}, {0.5, 11}, {1.0, 21}}) {
    const Ordered city = ordered(raw, {.main_share_01 = share});
    EXPECT_EQ(std::count_if(city.chains.begin(), city.chains.end(),
                            [](const StreetChain& c) { return c.hierarchy == 0; }),
              count);
  }
}

TEST(AssignHierarchy, NoChainsNoLevels) {
  std::vector<StreetChain> none;
  assign_hierarchy({}, none);
  EXPECT_TRUE(none.empty());
}

double importance(const Ordered& city, std::size_t chain) {
  return length_m(city.network, city.chains[chain]) * width_m(city.network, city.chains[chain]);
}

/// Levels by relaxation over all pairs of chains until nothing moves.
std::vector<int> brute_force_levels(const Ordered& city, double main_share_01) {
  constexpr int kFar = 1000000;
  const std::size_t n = city.chains.size();
  std::vector<std::set<std::uint32_t>> nodes(n);
  for (std::size_t c = 0; c < n; ++c)
    nodes[c] = {city.chains[c].nodes.begin(), city.chains[c].nodes.end()};
  const auto meet = [&](std::size_t a, std::size_t b) {
    return std::any_of(nodes[a].begin(), nodes[a].end(),
                       [&](std::uint32_t node) { return nodes[b].contains(node); });
  };
  std::vector<int> levels(n, kFar);
  const auto best_without_level = [&] {
    std::size_t best = n;
    for (std::size_t c = 0; c < n; ++c) {
      if (levels[c] == kFar && (best == n || importance(city, c) > importance(city, best)))
        best = c;
    }
    return best;
  };
  const auto wanted = std::max(1LL, std::llround(main_share_01 * static_cast<double>(n)));
  for (long long i = 0; i < wanted; ++i) levels[best_without_level()] = 0;
  for (;;) {
    for (bool has_moved = true; has_moved;) {
      has_moved = false;
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
          if (levels[a] + 1 >= levels[b] || !meet(a, b)) continue;
          levels[b] = levels[a] + 1;
          has_moved = true;
        }
      }
    }
    const std::size_t next = best_without_level();
    if (next == n) return levels;
    levels[next] = 0;
  }
}

TEST(AssignHierarchy, AgreesWithBruteForce) {
  Rng rng = plat::testing::property_rng("AgreesWithBruteForce");
  int deepest = 0;
  int parts = 0;
  for (int i = 0; i < plat::testing::iterations(60); ++i) {
    auto raw = random_streets(rng, 3 + rng.index(30), 500.0);
    for (RawStreet& street : raw) street.attributes.given_width_m = rng.uniform(6.0, 30.0);
    const double share = rng.uniform(0.0, 0.2);
    const Ordered city = ordered(raw, {.main_share_01 = share});
    std::vector<int> levels;
    for (const StreetChain& chain : city.chains) levels.push_back(chain.hierarchy);
    EXPECT_EQ(levels, brute_force_levels(city, share));
    deepest = std::max(deepest, *std::max_element(levels.begin(), levels.end()));
    parts += std::count(levels.begin(), levels.end(), 0) >
                     std::max(1LL, std::llround(share * static_cast<double>(levels.size())))
                 ? 1
                 : 0;
  }
  EXPECT_GE(deepest, 4);
  EXPECT_GE(parts, 10);
}

}  // namespace
}  // namespace plat::streets
