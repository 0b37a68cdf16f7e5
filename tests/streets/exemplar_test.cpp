#include "streets/exemplar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "streets/network_cleaning.h"
#include "support/property.h"
#include "support/random_streets.h"
#include "support/street_map.h"

namespace plat::streets {
namespace {

using plat::testing::ascii_points;
using plat::testing::random_streets;
using plat::testing::streets_on;

StreetNetwork network_of(const std::vector<RawStreet>& raw) {
  StreetNetwork network = build_network(raw).network;
  for (Street& street : network.streets)
    street.width_m = street.attributes.given_width_m.value_or(10.0);
  return network;
}

std::vector<IntersectionPoint> points_at(const Exemplar& exemplar, Point place) {
  std::vector<IntersectionPoint> out;
  for (const IntersectionPoint& point : exemplar.points) {
    if (point.place == place) out.push_back(point);
  }
  return out;
}

struct Drawn {
  std::map<char, Point> places;
  StreetNetwork network;
  Exemplar exemplar;
  [[nodiscard]] std::vector<IntersectionPoint> at(char letter) const {
    return points_at(exemplar, places.at(letter));
  }
};

Drawn drawn(std::string_view drawing, const std::vector<std::string>& ways, double step_m = 50.0) {
  Drawn out{ascii_points(drawing, step_m), {}, {}};
  out.network = network_of(streets_on(out.places, ways));
  out.exemplar = exemplar_of(out.network, {});
  return out;
}

TEST(ExemplarOf, CrossingOfTwoStreetsIsOnePointWithTwoPassing) {
  const Drawn city = drawn(R"(
      D
     AXB
      C
  )",
                           {"AXB", "CXD"});
  EXPECT_EQ(city.exemplar.points.size(), 5U);
  ASSERT_EQ(city.at('X').size(), 1U);
  EXPECT_EQ(city.at('X')[0].a.connections, 2);
  ASSERT_TRUE(city.at('X')[0].b.has_value());
  EXPECT_EQ(city.at('X')[0].b->connections, 2);
}

TEST(ExemplarOf, TeeHasOneStreetPassingAndOneEnding) {
  const Drawn city = drawn(R"(
      D
     AXB
  )",
                           {"AXB", "XD"});
  ASSERT_EQ(city.at('X').size(), 1U);
  EXPECT_EQ(city.at('X')[0].a.connections, 2);
  EXPECT_EQ(city.at('X')[0].b->connections, 1);
}

TEST(ExemplarOf, DeadEndHasOneStreet) {
  const Drawn city = drawn("AB", {"AB"});
  ASSERT_EQ(city.exemplar.points.size(), 2U);
  EXPECT_EQ(city.at('A')[0].a.connections, 1);
  EXPECT_FALSE(city.at('A')[0].b.has_value());
}

TEST(ExemplarOf, CrossingOfFiveArmsIsTwoPoints) {
  const Drawn city = drawn(R"(
     E D
      .
     AXB
      .
      C
  )",
                           {"AXB", "CX", "XD", "XE"});
  // AB and one of the arms from below pass, one arm ends: three streets.
  const auto points = city.at('X');
  ASSERT_EQ(points.size(), 2U);
  int connections = 0;
  for (const IntersectionPoint& point : points) {
    for (const PassingStreet& street : streets_of(point)) connections += street.connections;
  }
  EXPECT_EQ(connections, 5);
  EXPECT_TRUE(points[0].b.has_value());
  EXPECT_FALSE(points[1].b.has_value());
  EXPECT_EQ(points[1].a.connections, 1);
}

TEST(ExemplarOf, BendAndChangeOfAttributesAreNoPoints) {
  const auto places = ascii_points("A B C D", 50.0);
  auto raw = streets_on(places, {"AB", "BCD"});
  raw[0].attributes.street_class = "primary";
  const Exemplar exemplar = exemplar_of(network_of(raw), {});
  EXPECT_EQ(exemplar.points.size(), 2U);
}

TEST(ExemplarOf, BridgeHasNoPointWhereItCrosses) {
  const auto places = ascii_points(R"(
      D
     AXB
      C
  )",
                                   50.0);
  auto raw = streets_on(places, {"AB", "CD"});
  raw[1].attributes.level = 1;
  EXPECT_TRUE(points_at(exemplar_of(network_of(raw), {}), places.at('X')).empty());
}

TEST(ExemplarOf, LoopThatEndsOnItsOwnStemCountsTwice) {
  // A teardrop: the stem goes straight on into the loop, whose other end comes back at A.
  const Drawn city = drawn(R"(
            C
     S  A     B
  )",
                           {"SABCA"});
  const auto points = city.at('A');
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].a.connections, 2);
  ASSERT_TRUE(points[0].b.has_value());
  EXPECT_EQ(points[0].b->connections, 1);
  // The loop comes back to where it began: only the stem has a chord.
  EXPECT_EQ(points[0].a.distance_mean_m, 150.0);
  EXPECT_EQ(points[0].a.tortuosity, 1.0);
}

TEST(ExemplarOf, LoneRingHasNoPoint) {
  const Drawn city = drawn(R"(
     A B
     D C
  )",
                           {"ABCDA"});
  ASSERT_EQ(city.exemplar.chains.size(), 1U);
  EXPECT_TRUE(city.exemplar.chains[0].is_closed);
  EXPECT_TRUE(city.exemplar.points.empty());
}

TEST(ExemplarOf, GridWithEveryKindOfNode) {
  // Three streets east, two north of which one goes on to a dead end at Z; one street apart.
  const Drawn city = drawn(R"(
     A..B..C..D
        .  .
     E..F..G..H
        .  .
     I..J..K..L
        .
        Z     S...T
  )",
                           {"ABCD", "EFGH", "IJKL", "BFJZ", "CGK", "ST"});
  EXPECT_EQ(city.at('B').size(), 1U);
  EXPECT_EQ(city.at('F')[0].b->connections, 2);
  EXPECT_EQ(city.at('K')[0].b->connections, 1);
  EXPECT_FALSE(city.at('Z')[0].b.has_value());
  // Crossings and tees B, C, F, G, J, K; the ends of three streets; Z; the street apart.
  EXPECT_EQ(city.exemplar.points.size(), 6U + 6U + 1U + 2U);
}

TEST(ExemplarOf, StyleIsThatOfTheWholeStreet) {
  // Intersections at 0, 100, 300 m, then a right angle's turn away over a detour.
  std::vector<RawStreet> raw{{"main", {{0, 0}, {100, 0}, {300, 0}, {300, 30}, {340, 30}}, {}},
                             {"s1", {{100, 0}, {100, 90}}, {}},
                             {"s2", {{300, 0}, {300, -90}}, {}}};
  for (RawStreet& street : raw) street.attributes.name = street.source_id;
  raw[0].attributes.given_width_m = 24.0;
  const Exemplar exemplar = exemplar_of(network_of(raw), {});
  const auto points = points_at(exemplar, {100, 0});
  ASSERT_EQ(points.size(), 1U);
  const PassingStreet& main = points[0].a;
  EXPECT_EQ(main.hierarchy, 0);
  EXPECT_EQ(main.width_m, 24.0);
  EXPECT_NEAR(main.distance_mean_m, (100.0 + 200.0 + 50.0) / 3.0, 1e-9);
  EXPECT_NEAR(main.distance_variance_m2, 35000.0 / 6.0, 1e-6);
  EXPECT_NEAR(main.tortuosity, (1.0 + 1.0 + 70.0 / 50.0) / 3.0, 1e-12);
  const double turn = std::atan2(30.0, 40.0);
  EXPECT_NEAR(main.angle_mean_rad, turn / 2.0, 1e-12);
  EXPECT_NEAR(main.angle_variance_rad2, turn * turn / 2.0, 1e-12);
}

TEST(ExemplarOf, TurnsToBothSidesDoNotCancel) {
  std::vector<RawStreet> raw{{"main", {{0, 0}, {100, 0}, {200, 50}, {300, 50}}, {}},
                             {"s1", {{100, 0}, {100, -90}}, {}},
                             {"s2", {{200, 50}, {200, 140}}, {}}};
  const Exemplar exemplar = exemplar_of(network_of(raw), {});
  const PassingStreet main = points_at(exemplar, {0, 0}).at(0).a;
  EXPECT_NEAR(main.angle_mean_rad, std::atan2(50.0, 100.0), 1e-12);
  EXPECT_NEAR(main.angle_variance_rad2, 0.0, 1e-12);
}

TEST(ExemplarOf, RingHasAsManyDistancesAsPoints) {
  std::vector<RawStreet> raw{{"ring", {{0, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 0}}, {}},
                             {"s", {{50, 0}, {50, -90}}, {}},
                             {"n", {{50, 100}, {50, 190}}, {}}};
  for (RawStreet& street : raw) street.attributes.name = street.source_id;
  const Exemplar exemplar = exemplar_of(network_of(raw), {});
  const PassingStreet ring = points_at(exemplar, {50, 0}).at(0).a;
  EXPECT_EQ(ring.distance_mean_m, 100.0);
  EXPECT_EQ(ring.distance_variance_m2, 0.0);
  EXPECT_EQ(ring.tortuosity, 2.0);
  EXPECT_NEAR(ring.angle_mean_rad, std::numbers::pi, 1e-12);
}

TEST(ExemplarOf, ParcelsNearbyGiveTheirMeanArea) {
  const auto box = [](double x, double y, double side) {
    return Polygon{{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}};
  };
  const StreetNetwork network = network_of(std::vector<RawStreet>{{"s", {{0, 0}, {500, 0}}, {}}});
  const std::vector<Polygon> parcels{box(5, 5, 10), box(-30, 5, 20), box(35, 35, 30)};
  const Exemplar exemplar = exemplar_of(network, parcels);
  EXPECT_EQ(points_at(exemplar, {0, 0}).at(0).parcel_area_m2, (100.0 + 400.0) / 2.0);
  EXPECT_FALSE(points_at(exemplar, {500, 0}).at(0).parcel_area_m2.has_value());
  const Exemplar wide = exemplar_of(network, parcels, {.parcel_radius_m = 120.0});
  EXPECT_EQ(points_at(wide, {0, 0}).at(0).parcel_area_m2, (100.0 + 400.0 + 900.0) / 3.0);
}

TEST(ExemplarOf, EmptyNetworkHasNoPoints) {
  EXPECT_TRUE(exemplar_of({}, {}).points.empty());
  EXPECT_TRUE(open_ends_of({}, exemplar_of({}, {})).empty());
}

/// What has to hold for the exemplar of any network.
void expect_sound(const StreetNetwork& network, const Exemplar& exemplar) {
  const auto degrees = node_degrees(network);
  std::map<std::pair<double, double>, int> connections;
  std::map<std::pair<double, double>, std::vector<int>> levels;
  ASSERT_EQ(exemplar.chains_of_point.size(), exemplar.points.size());
  for (std::size_t i = 0; i < exemplar.points.size(); ++i) {
    const IntersectionPoint& point = exemplar.points[i];
    if (i > 0) {
      EXPECT_LE(exemplar.points[i - 1].place, point.place);
    }
    const Exemplar::Chains& chains = exemplar.chains_of_point[i];
    ASSERT_EQ(chains.b.has_value(), point.b.has_value());
    std::vector<std::uint32_t> numbers{chains.a};
    if (chains.b) numbers.push_back(*chains.b);
    const auto streets = streets_of(point);
    for (std::size_t k = 0; k < streets.size(); ++k) {
      PassingStreet style = exemplar.styles.at(numbers[k]);
      style.connections = streets[k].connections;
      EXPECT_EQ(style, streets[k]);
      EXPECT_EQ(style.hierarchy, exemplar.chains[numbers[k]].hierarchy);
      EXPECT_GE(style.tortuosity, 1.0);
      EXPECT_GE(style.distance_variance_m2, 0.0);
      EXPECT_LE(style.angle_mean_rad, std::numbers::pi);
      connections[{point.place.x, point.place.y}] += style.connections;
      levels[{point.place.x, point.place.y}].push_back(style.hierarchy);
    }
  }
  for (const auto& [place, of_streets] : levels)
    EXPECT_TRUE(std::is_sorted(of_streets.begin(), of_streets.end()));
  std::size_t passed = 0;
  for (std::size_t node = 0; node < degrees.size(); ++node) {
    const auto it = connections.find({network.nodes[node].x, network.nodes[node].y});
    if (it == connections.end()) {
      EXPECT_TRUE(degrees[node] == 2 || degrees[node] == 0);
      ++passed;
    } else {
      EXPECT_EQ(static_cast<std::uint32_t>(it->second), degrees[node]);
    }
  }
  EXPECT_EQ(passed + connections.size(), network.nodes.size());
}

TEST(ExemplarOf, CoversEveryPassageAndEndOfRandomNetworks) {
  Rng rng = plat::testing::property_rng("CoversEveryPassageAndEndOfRandomNetworks");
  std::size_t crowded = 0;
  for (int i = 0; i < plat::testing::iterations(80); ++i) {
    auto raw = random_streets(rng, 3 + rng.index(30), 400.0);
    // Streets that begin at one place make crossings of many.
    const Point hub{200.0, 200.0};
    for (std::uint64_t k = rng.index(7); k > 0; --k)
      raw.push_back({"hub", {hub, {rng.uniform(0, 400), rng.uniform(0, 400)}}, {}});
    const StreetNetwork network = network_of(raw);
    const Exemplar exemplar = exemplar_of(network, {});
    expect_sound(network, exemplar);
    for (std::size_t k = 1; k < exemplar.points.size(); ++k)
      crowded += exemplar.points[k - 1].place == exemplar.points[k].place ? 1 : 0;
  }
  EXPECT_GT(crowded, 20U);
}

TEST(ExemplarOf, DoesNotDependOnTheOrderOrSenseOfStreets) {
  Rng rng = plat::testing::property_rng("ExemplarOrder");
  for (int i = 0; i < plat::testing::iterations(40); ++i) {
    const StreetNetwork network = network_of(random_streets(rng, 3 + rng.index(30), 400.0));
    StreetNetwork twin = network;
    std::reverse(twin.streets.begin(), twin.streets.end());
    for (Street& street : twin.streets) {
      if (rng.index(2) == 0) continue;
      std::swap(street.from, street.to);
      std::reverse(street.line.begin(), street.line.end());
    }
    EXPECT_TRUE(exemplar_of(network, {}).points == exemplar_of(twin, {}).points);
  }
}

TEST(ExemplarOf, StyleDoesNotTurnWithTheNetwork) {
  Rng rng = plat::testing::property_rng("ExemplarTurned");
  for (int i = 0; i < plat::testing::iterations(40); ++i) {
    const StreetNetwork network = network_of(random_streets(rng, 3 + rng.index(30), 400.0));
    StreetNetwork twin = network;
    const auto move = [](Point& p) { p = perpendicular(p) + Point{731.0, -2048.0}; };
    for (Point& node : twin.nodes) move(node);
    for (Street& street : twin.streets) std::for_each(street.line.begin(), street.line.end(), move);
    Exemplar exemplar = exemplar_of(network, {});
    Exemplar turned = exemplar_of(twin, {});
    ASSERT_EQ(exemplar.points.size(), turned.points.size());
    const auto key = [](const IntersectionPoint& p) {
      return std::tuple(p.place, p.a.hierarchy, -p.a.connections, p.a.distance_mean_m);
    };
    const auto by_key = [&](const auto& a, const auto& b) { return key(a) < key(b); };
    for (IntersectionPoint& point : exemplar.points) move(point.place);
    std::sort(exemplar.points.begin(), exemplar.points.end(), by_key);
    std::sort(turned.points.begin(), turned.points.end(), by_key);
    for (std::size_t k = 0; k < turned.points.size(); ++k) {
      EXPECT_EQ(exemplar.points[k].place, turned.points[k].place);
      EXPECT_EQ(exemplar.points[k].a.hierarchy, turned.points[k].a.hierarchy);
      EXPECT_NEAR(exemplar.points[k].a.distance_mean_m, turned.points[k].a.distance_mean_m, 1e-6);
      EXPECT_NEAR(exemplar.points[k].a.angle_mean_rad, turned.points[k].a.angle_mean_rad, 1e-9);
      EXPECT_NEAR(exemplar.points[k].a.tortuosity, turned.points[k].a.tortuosity, 1e-9);
    }
  }
}

TEST(OpenEndsOf, GoStraightOnFromEveryEnd) {
  const Drawn city = drawn(R"(
      D
     AXB
  )",
                           {"AXB", "XD"});
  const auto ends = open_ends_of(city.network, city.exemplar);
  ASSERT_EQ(ends.size(), 4U);  // A, B, D and X, where XD would go on downwards
  std::map<char, Point> headings;
  for (const OpenEnd& end : ends) {
    for (const auto& [letter, place] : city.places) {
      if (city.network.nodes[end.node] == place) headings[letter] = end.heading;
    }
    EXPECT_EQ(end.street.connections, 1);
    EXPECT_EQ(end.street.width_m, 10.0);
  }
  EXPECT_EQ(headings.at('A'), (Point{-1, 0}));
  EXPECT_EQ(headings.at('B'), (Point{1, 0}));
  EXPECT_EQ(headings.at('D'), (Point{0, 1}));
  EXPECT_EQ(headings.at('X'), (Point{0, -1}));
}

TEST(OpenEndsOf, AreTheEndsOfTheExemplarsPoints) {
  Rng rng = plat::testing::property_rng("AreTheEndsOfTheExemplarsPoints");
  for (int i = 0; i < plat::testing::iterations(40); ++i) {
    const StreetNetwork network = network_of(random_streets(rng, 3 + rng.index(30), 400.0));
    const Exemplar exemplar = exemplar_of(network, {});
    std::map<std::pair<double, double>, int> ends;
    for (const IntersectionPoint& point : exemplar.points) {
      for (const PassingStreet& street : streets_of(point))
        ends[{point.place.x, point.place.y}] += street.connections == 1 ? 1 : 0;
    }
    const auto open_ends = open_ends_of(network, exemplar);
    EXPECT_TRUE(std::is_sorted(open_ends.begin(), open_ends.end(),
                               [](const auto& a, const auto& b) { return a.node < b.node; }));
    for (const OpenEnd& end : open_ends) {
      EXPECT_NEAR(length(end.heading), 1.0, 1e-12);
      --ends[{network.nodes[end.node].x, network.nodes[end.node].y}];
    }
    for (const auto& [place, count] : ends) EXPECT_EQ(count, 0);
  }
}

}  // namespace
}  // namespace plat::streets
