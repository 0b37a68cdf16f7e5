#include "streets/network_cleaning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/working_grid.h"
#include "support/property.h"
#include "support/street_map.h"

namespace plat::streets {
namespace {

using plat::testing::ascii_points;
using plat::testing::streets_on;

std::size_t count(const CleanNetwork& clean, RepairKind kind) {
  return static_cast<std::size_t>(
      std::count_if(clean.repairs.begin(), clean.repairs.end(),
                    [&](const Repair& repair) { return repair.kind == kind; }));
}

double total_length_m(const StreetNetwork& network) {
  double total = 0.0;
  for (const Street& street : network.streets) total += length_m(street.line);
  return total;
}

TEST(BuildNetwork, CrossingBecomesANode) {
  const auto places = ascii_points(R"(
      C
     A+B
      D
  )",
                                   10.0);
  const CleanNetwork clean = build_network(streets_on(places, {"AB", "CD"}));
  EXPECT_EQ(clean.network.nodes.size(), 5U);
  EXPECT_EQ(clean.network.streets.size(), 4U);
  EXPECT_TRUE(clean.repairs.empty());
}

TEST(BuildNetwork, BridgeHasNoNodeWhereItCrosses) {
  const auto places = ascii_points(R"(
      C
     A+B
      D
  )",
                                   10.0);
  auto raw = streets_on(places, {"AB", "CD"});
  raw[1].attributes.level = 1;
  raw[1].attributes.structure = Structure::kBridge;
  const CleanNetwork clean = build_network(raw);
  EXPECT_EQ(clean.network.nodes.size(), 4U);
  EXPECT_EQ(clean.network.streets.size(), 2U);
}

TEST(BuildNetwork, BridgeIsConnectedAtItsOwnEnds) {
  // The bridge CD leaves the street AB in the middle, and goes on as DE on the ground.
  const auto places = ascii_points(R"(
      E
      D
      |
     ACB
  )",
                                   10.0);
  auto raw = streets_on(places, {"AB", "CD", "DE"});
  raw[1].attributes.level = 1;
  raw[1].attributes.structure = Structure::kBridge;
  const CleanNetwork clean = build_network(raw);
  EXPECT_EQ(clean.network.streets.size(), 4U);
  EXPECT_EQ(clean.network.nodes.size(), 5U);
  const auto degrees = node_degrees(clean.network);
  EXPECT_EQ(std::count(degrees.begin(), degrees.end(), 3U), 1);  // C
  EXPECT_EQ(std::count(degrees.begin(), degrees.end(), 2U), 1);  // D: ground and bridge differ
}

TEST(BuildNetwork, EndThatNearlyTouchesIsSnappedOntoTheStreet) {
  std::vector<RawStreet> raw{{"main", {{0, 0}, {100, 0}}, {}}, {"side", {{40, 0.5}, {40, 60}}, {}}};
  const CleanNetwork clean = build_network(raw);
  EXPECT_EQ(clean.network.streets.size(), 3U);
  ASSERT_EQ(count(clean, RepairKind::kSnappedEnd), 1U);
  EXPECT_EQ(clean.repairs.front().feature_id, "side");
  EXPECT_EQ(clean.repairs.front().place, (Point{40, 0}));
}

TEST(BuildNetwork, EndFartherThanTheSnappingDistanceStaysADeadEnd) {
  std::vector<RawStreet> raw{{"main", {{0, 0}, {100, 0}}, {}}, {"side", {{40, 1.5}, {40, 60}}, {}}};
  const CleanNetwork clean = build_network(raw);
  EXPECT_EQ(clean.network.streets.size(), 2U);
  EXPECT_TRUE(clean.repairs.empty());
}

TEST(BuildNetwork, EndsThatNearlyMeetAreOneNode) {
  std::vector<RawStreet> raw{{"a", {{0, 0}, {50, 0}}, {}}, {"b", {{50.4, 0.2}, {50, 60}}, {}}};
  raw[1].attributes.name = "other";  // else they would be one street
  const CleanNetwork clean = build_network(raw);
  EXPECT_EQ(clean.network.nodes.size(), 3U);
  EXPECT_EQ(count(clean, RepairKind::kSnappedEnd), 1U);
}

TEST(BuildNetwork, WayCutAtATileBorderIsOneStreetAgain) {
  const auto places = ascii_points("A..B..C", 10.0);
  const CleanNetwork clean = build_network(streets_on(places, {"AB", "BC"}));
  ASSERT_EQ(clean.network.streets.size(), 1U);
  EXPECT_EQ(clean.network.streets.front().line.size(), 3U);
  EXPECT_EQ(count(clean, RepairKind::kRejoined), 1U);
}

TEST(BuildNetwork, WayCutWithAGapIsOneStreetAgain) {
  std::vector<RawStreet> raw{{"7", {{0, 0}, {50, 0}}, {}}, {"7", {{50.3, 0}, {90, 0}}, {}}};
  EXPECT_EQ(build_network(raw).network.streets.size(), 1U);
}

TEST(BuildNetwork, StreetsThatDifferInNameAreNotJoined) {
  auto raw = streets_on(ascii_points("A..B..C", 10.0), {"AB", "BC"});
  raw[1].attributes.name = "other";
  EXPECT_EQ(build_network(raw).network.streets.size(), 2U);
}

TEST(BuildNetwork, JoinedStreetRunsAsItsFirstPartDoes) {
  const CleanNetwork clean = build_network(streets_on(ascii_points("A..B..C", 10.0), {"CB", "AB"}));
  ASSERT_EQ(clean.network.streets.size(), 1U);
  EXPECT_EQ(clean.network.streets.front().line.front(), (Point{60, 0}));
}

TEST(BuildNetwork, DuplicateIsRemovedAndReported) {
  const CleanNetwork clean =
      build_network(streets_on(ascii_points("A..B..C", 10.0), {"ABC", "CA"}));
  EXPECT_EQ(clean.network.streets.size(), 1U);
  ASSERT_EQ(count(clean, RepairKind::kDuplicate), 1U);
  EXPECT_EQ(clean.repairs.front().feature_id, "CA");
}

TEST(BuildNetwork, OverlappingPartIsRemovedAndReported) {
  const CleanNetwork clean =
      build_network(streets_on(ascii_points("A..B..C..D", 10.0), {"AC", "BD"}));
  EXPECT_DOUBLE_EQ(total_length_m(clean.network), 90.0);
  EXPECT_EQ(count(clean, RepairKind::kOverlap), 1U);
}

TEST(BuildNetwork, DeadEndIsKept) {
  const auto places = ascii_points(R"(
     A.B.C
       |
       D
  )",
                                   10.0);
  const CleanNetwork clean = build_network(streets_on(places, {"ABC", "BD"}));
  EXPECT_EQ(clean.network.streets.size(), 3U);
}

TEST(BuildNetwork, OvershootIsTrimmedAndReported) {
  std::vector<RawStreet> raw{{"main", {{0, 0}, {100, 0}}, {}},
                             {"side", {{40, -0.4}, {40, 60}}, {}}};
  const CleanNetwork clean = build_network(raw);
  EXPECT_EQ(clean.network.streets.size(), 3U);
  EXPECT_EQ(count(clean, RepairKind::kOvershoot) + count(clean, RepairKind::kSnappedEnd), 1U);
}

TEST(BuildNetwork, RingWithoutAJunctionIsOneClosedStreet) {
  const auto places = ascii_points(R"(
     A.B
     D.C
  )",
                                   20.0);
  const CleanNetwork clean = build_network(streets_on(places, {"ABCDA"}));
  ASSERT_EQ(clean.network.streets.size(), 1U);
  EXPECT_EQ(clean.network.streets.front().from, clean.network.streets.front().to);
}

TEST(BuildNetwork, ZeroLengthAndNotFiniteBecomeRows) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<RawStreet> raw{{"point", {{5, 5}, {5, 5}}, {}},
                             {"nan", {{0, 0}, {nan, 1}}, {}},
                             {"far", {{0, 0}, {1e9, 1}}, {}},
                             {"empty", {}, {}}};
  const CleanNetwork clean = build_network(raw);
  EXPECT_TRUE(clean.network.streets.empty());
  EXPECT_EQ(count(clean, RepairKind::kZeroLength), 2U);
  EXPECT_EQ(count(clean, RepairKind::kNotFinite), 2U);
}

TEST(BuildNetwork, SummaryCountsEachKind) {
  const std::vector<Repair> repairs{{"a", RepairKind::kDuplicate, {}, ""},
                                    {"b", RepairKind::kRejoined, {}, ""},
                                    {"c", RepairKind::kRejoined, {}, ""}};
  EXPECT_EQ(summary(repairs), "repairs: 3 (1 duplicate, 2 rejoined)");
}

std::vector<RawStreet> random_streets(Rng& rng) {
  std::vector<RawStreet> raw;
  for (int i = 0; i < 60; ++i) {
    RawStreet street;
    street.source_id = std::to_string(i);
    Point p{rng.uniform(0, 300), rng.uniform(0, 300)};
    for (int k = 0; k < 4; ++k) {
      street.line.push_back(snap(p));
      p = p + Point{rng.uniform(-60, 60), rng.uniform(-60, 60)};
    }
    raw.push_back(std::move(street));
  }
  return raw;
}

TEST(BuildNetwork, MirroredAndTranslatedInputGivesTheSameNetwork) {
  Rng rng = plat::testing::property_rng("MirroredAndTranslatedInputGivesTheSameNetwork");
  for (int i = 0; i < plat::testing::iterations(20); ++i) {
    const std::vector<RawStreet> raw = random_streets(rng);
    std::vector<RawStreet> twin = raw;
    for (RawStreet& street : twin) {
      for (Point& p : street.line) p = {2048.0 - p.x, p.y + 512.0};
    }
    const CleanNetwork a = build_network(raw);
    const CleanNetwork b = build_network(twin);
    EXPECT_EQ(a.network.streets.size(), b.network.streets.size());
    EXPECT_EQ(a.network.nodes.size(), b.network.nodes.size());
    // Crossings are rounded to the grid, ties to the same side: a millimetre each.
    EXPECT_NEAR(total_length_m(a.network), total_length_m(b.network), 1.0);
    EXPECT_GT(a.network.streets.size(), 100U);
  }
}

TEST(BuildNetwork, StreetsMeetAtTheirNodesAndCoverNothingTwice) {
  Rng rng = plat::testing::property_rng("StreetsMeetAtTheirNodesAndCoverNothingTwice");
  const CleanNetwork clean = build_network(random_streets(rng));
  std::map<std::pair<Point, Point>, int> pieces;
  for (const Street& street : clean.network.streets) {
    EXPECT_EQ(street.line.front(), clean.network.nodes[street.from]);
    EXPECT_EQ(street.line.back(), clean.network.nodes[street.to]);
    for (std::size_t i = 1; i < street.line.size(); ++i) {
      EXPECT_TRUE(is_on_grid(street.line[i]));
      const auto& [a, b] = std::pair(street.line[i - 1], street.line[i]);
      EXPECT_EQ(++pieces[a < b ? std::pair(a, b) : std::pair(b, a)], 1);
    }
  }
}

}  // namespace
}  // namespace plat::streets
