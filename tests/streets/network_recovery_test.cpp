#include "streets/network_recovery.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/working_grid.h"
#include "streets/network_cleaning.h"
#include "support/property.h"

namespace plat::streets {
namespace {

using plat::testing::property_rng;

/// Streets as they are drawn, each at its own ends, none noded with another.
StreetNetwork as_drawn(const std::vector<Polyline>& lines) {
  StreetNetwork out;
  for (const Polyline& line : lines) {
    out.nodes.push_back(line.front());
    out.nodes.push_back(line.back());
  }
  std::sort(out.nodes.begin(), out.nodes.end());
  out.nodes.erase(std::unique(out.nodes.begin(), out.nodes.end()), out.nodes.end());
  const auto number = [&](Point p) {
    return static_cast<std::uint32_t>(std::lower_bound(out.nodes.begin(), out.nodes.end(), p) -
                                      out.nodes.begin());
  };
  for (const Polyline& line : lines) {
    Street street;
    street.id = {static_cast<std::uint32_t>(out.streets.size())};
    street.from = number(line.front());
    street.to = number(line.back());
    street.line = line;
    out.streets.push_back(std::move(street));
  }
  return out;
}

std::vector<int> zeros(const StreetNetwork& network) {
  return std::vector<int>(network.streets.size(), 0);
}

RecoveryShares by_edges(const StreetNetwork& known, const StreetNetwork& grown,
                        std::span<const Point> places = {}) {
  const auto a = zeros(known);
  const auto b = zeros(grown);
  return shares_of(recover_edges({known, a}, {grown, b}, places));
}

RecoveryShares by_length(const StreetNetwork& known, const StreetNetwork& grown,
                         const LengthRecoveryOptions& options = {}) {
  const auto a = zeros(known);
  const auto b = zeros(grown);
  return shares_of(recover_length({known, a}, {grown, b}, options));
}

// A square ABCD of 100 m with its diagonal AC.
constexpr Point kA{0, 0};
constexpr Point kB{100, 0};
constexpr Point kC{100, 100};
constexpr Point kD{0, 100};
const std::vector<Point> kPlaces{kA, kB, kC, kD};
const std::vector<Polyline> kSquare{{kA, kB}, {kB, kC}, {kC, kD}, {kD, kA}, {kA, kC}};

TEST(RecoverEdges, SharesAreOfTheRightSide) {
  // Three of the five, and the other diagonal's half: B to a new place.
  const StreetNetwork grown = as_drawn({{kA, kB}, {kC, kB}, {kD, kA}, {kB, {50, 40}}});
  const RecoveryShares shares = by_edges(as_drawn(kSquare), grown, kPlaces);
  EXPECT_EQ(shares.known, 5.0);
  EXPECT_EQ(shares.recovered, 3.0);
  EXPECT_EQ(shares.grown, 4.0);
  EXPECT_EQ(shares.recall_01(), 0.6);
  EXPECT_EQ(shares.precision_01(), 0.75);
  EXPECT_NEAR(shares.f1_01().value(), 2.0 * 3.0 / 9.0, 1e-12);
}

TEST(RecoverEdges, PlacesOnAStreetDivideIt) {
  // The grown street passes B on its way to C, and bends nowhere else.
  const StreetNetwork known = as_drawn({{kA, kB}, {kB, kC}});
  const StreetNetwork grown = as_drawn({{kA, kC}});
  EXPECT_EQ(by_edges(known, grown, kPlaces).recall_01(), 0.0);
  // Without the place B both are one edge from A to C.
  EXPECT_EQ(by_edges(known, grown).recall_01(), 1.0);
}

TEST(RecoverEdges, NewIntersectionsAreEndsToo) {
  // The diagonals cross in a node of the grown network, which is no place of the known one.
  const Point middle{50, 50};
  const StreetNetwork grown =
      as_drawn({{kA, middle}, {middle, kC}, {kB, middle}, {middle, kD}, {kA, kB}});
  const RecoveryShares shares = by_edges(as_drawn(kSquare), grown, kPlaces);
  EXPECT_EQ(shares.grown, 5.0);
  EXPECT_EQ(shares.right, 1.0);
}

TEST(RecoverEdges, APairCountsOnceWhateverItsLinesAndTheirSense) {
  const StreetNetwork known = as_drawn({{kA, kB}, {kA, {50, 20}, kB}, {kB, kC}});
  const StreetNetwork grown = as_drawn({{kB, {50, -30}, kA}});
  const RecoveryShares shares = by_edges(known, grown, kPlaces);
  EXPECT_EQ(shares.known, 2.0);
  EXPECT_EQ(shares.recovered, 1.0);
  EXPECT_EQ(shares.precision_01(), 1.0);
}

TEST(RecoverEdges, LevelsAreThoseOfTheSideJudged) {
  const StreetNetwork known = as_drawn({{kA, kB}, {kB, kC}, {kC, kD}});
  const StreetNetwork grown = as_drawn({{kA, kB}, {kB, kD}});
  const std::vector<int> known_levels{0, 1, 1};
  const std::vector<int> grown_levels{2, 1};
  const auto levels =
      shares_by_level(recover_edges({known, known_levels}, {grown, grown_levels}, kPlaces));
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels.at(0).recall_01(), 1.0);
  EXPECT_EQ(levels.at(0).precision_01(), std::nullopt);
  EXPECT_EQ(levels.at(1).recall_01(), 0.0);
  EXPECT_EQ(levels.at(1).precision_01(), 0.0);
  EXPECT_EQ(levels.at(2).precision_01(), 1.0);
}

TEST(RecoverLength, BufferedLengthIsExact) {
  // 100 m of which a parallel street 6 m off covers 40 m, and 8 m more at each end of it:
  // within 10 m of its ends, sqrt(100 - 36) along.
  const StreetNetwork known = as_drawn({{{0, 0}, {100, 0}}});
  const StreetNetwork grown = as_drawn({{{30, 6}, {70, 6}}});
  const RecoveryShares shares = by_length(known, grown);
  EXPECT_NEAR(shares.recovered, 56.0, 1e-9);
  EXPECT_NEAR(shares.right, 40.0, 1e-9);
  EXPECT_NEAR(by_length(known, grown, {.buffer_m = 5.0}).recovered, 0.0, 1e-12);
}

TEST(RecoverLength, StreetsThatCrossDoNotCover) {
  const StreetNetwork known = as_drawn({{{0, 0}, {100, 0}}});
  const StreetNetwork grown = as_drawn({{{50, -50}, {50, 50}}});
  EXPECT_EQ(by_length(known, grown).recovered, 0.0);
  LengthRecoveryOptions any;
  any.max_turn_rad = std::numbers::pi / 2;
  EXPECT_NEAR(by_length(known, grown, any).recovered, 20.0, 1e-9);
}

TEST(RecoverLength, WhatTwoStreetsCoverCountsOnce) {
  const StreetNetwork known = as_drawn({{{0, 0}, {100, 0}}});
  const StreetNetwork grown = as_drawn({{{-20, 3}, {60, 3}}, {{40, -3}, {120, -3}}});
  EXPECT_NEAR(by_length(known, grown).recovered, 100.0, 1e-9);
}

TEST(RecoverLength, ASlantedStreetCoversWhereItIsNear) {
  // Rises 1 in 4: within 10 m of the straight one along 40 m of it, and a little by its end.
  const StreetNetwork known = as_drawn({{{0, 0}, {200, 0}}});
  const StreetNetwork grown = as_drawn({{{0, 0}, {160, 40}}});
  const double by_strip = 10.0 * std::sqrt(1.0 + 16.0);
  EXPECT_NEAR(by_length(known, grown).recovered, by_strip, 1e-9);
  EXPECT_NEAR(by_length(grown, known).recovered, 10.0 * std::sqrt(17.0), 1e-9);
}

TEST(Recovery, OfNothingIsAbsent) {
  const StreetNetwork none;
  const StreetNetwork some = as_drawn({{kA, kB}});
  for (const auto& shares : {by_edges(none, some), by_length(none, some)}) {
    EXPECT_EQ(shares.recall_01(), std::nullopt);
    EXPECT_EQ(shares.precision_01(), 0.0);
    EXPECT_EQ(shares.f1_01(), std::nullopt);
  }
}

StreetNetwork random_network(Rng& rng, Point corner) {
  std::vector<RawStreet> raw;
  for (int i = 0; i < 30; ++i) {
    const auto place = [&] { return corner + Point{rng.uniform(0, 800), rng.uniform(0, 800)}; };
    raw.push_back({std::to_string(i), {place(), place()}, {}});
  }
  return build_network(raw).network;
}

TEST(Recovery, ANetworkRecoversItselfAndNothingOfAnotherFarAway) {
  Rng rng = property_rng("recovery_self");
  for (int i = 0; i < plat::testing::iterations(10); ++i) {
    const StreetNetwork network = random_network(rng, {});
    const StreetNetwork other = random_network(rng, {2000.0, 0.0});
    ASSERT_GT(network.streets.size(), 60U);
    EXPECT_EQ(by_edges(network, network, network.nodes).f1_01(), 1.0);
    EXPECT_NEAR(by_length(network, network).f1_01().value(), 1.0, 1e-12);
    EXPECT_EQ(by_edges(network, other, network.nodes).f1_01(), 0.0);
    EXPECT_EQ(by_length(network, other).f1_01(), 0.0);
  }
}

TEST(Recovery, SidesChangePlacesAndTwinsAgree) {
  Rng rng = property_rng("recovery_twins");
  int partly = 0;
  for (int i = 0; i < plat::testing::iterations(10); ++i) {
    const StreetNetwork known = random_network(rng, {});
    StreetNetwork grown = known;
    std::erase_if(grown.streets, [&](const Street&) { return rng.index(3) == 0; });
    const auto turned = [](StreetNetwork network) {
      std::vector<Polyline> lines;
      for (const Street& street : network.streets) {
        lines.emplace_back();
        for (const Point p : street.line) lines.back().push_back(perpendicular(p));
        std::reverse(lines.back().begin(), lines.back().end());
      }
      return as_drawn(lines);
    };
    const auto judge = [](const StreetNetwork& a, const StreetNetwork& b, bool edges) {
      std::vector<Point> places = a.nodes;
      places.insert(places.end(), b.nodes.begin(), b.nodes.end());
      return edges ? by_edges(a, b, places) : by_length(a, b);
    };
    for (const bool edges : {true, false}) {
      const RecoveryShares shares = judge(known, grown, edges);
      const RecoveryShares swapped = judge(grown, known, edges);
      EXPECT_EQ(shares.recall_01(), swapped.precision_01());
      EXPECT_EQ(shares.precision_01(), swapped.recall_01());
      const RecoveryShares twin = judge(turned(known), turned(grown), edges);
      EXPECT_NEAR(shares.recovered, twin.recovered, 1e-6);
      EXPECT_NEAR(shares.right, twin.right, 1e-6);
      partly += *shares.recall_01() > 0.3 && *shares.recall_01() < 0.95 ? 1 : 0;
    }
  }
  EXPECT_GT(partly, 10);
}

TEST(LevelsOf, ExistingStreetsComeFirst) {
  Growth growth;
  growth.network = as_drawn({{kA, kB}, {kB, kC}, {kC, kD}});
  growth.segments = {{3, 0}, {1, 1}};
  EXPECT_EQ(levels_of(growth, 7), (std::vector<int>{7, 3, 1}));
}

}  // namespace
}  // namespace plat::streets
