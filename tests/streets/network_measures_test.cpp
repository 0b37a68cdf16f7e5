#include "streets/network_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/working_grid.h"
#include "streets/network_cleaning.h"
#include "streets/network_faces.h"
#include "support/property.h"
#include "support/street_map.h"

namespace plat::streets {
namespace {

using plat::testing::ascii_points;
using plat::testing::property_rng;
using plat::testing::streets_on;

StreetNetwork drawn(std::string_view map, const std::vector<std::string>& ways,
                    double step_m = 10.0) {
  return build_network(streets_on(ascii_points(map, step_m), ways)).network;
}

StreetNetwork of_lines(const std::vector<Polyline>& lines) {
  std::vector<RawStreet> raw;
  for (const Polyline& line : lines) raw.push_back({std::to_string(raw.size()), line, {}});
  return build_network(raw).network;
}

/// Random segments of a square kilometre, noded.
StreetNetwork random_network(Rng& rng, int count) {
  std::vector<Polyline> lines;
  for (int i = 0; i < count; ++i) {
    const Point a{rng.uniform(0.0, 1000.0), rng.uniform(0.0, 1000.0)};
    const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
    const double size = rng.uniform(50.0, 500.0);
    lines.push_back({a, a + size * Point{std::cos(angle), std::sin(angle)}});
  }
  return of_lines(lines);
}

/// Every street cut at its bends.
StreetNetwork split(const StreetNetwork& network) {
  StreetNetwork out;
  std::vector<Polyline> lines;
  for (const Street& street : network.streets) {
    for (std::size_t i = 1; i < street.line.size(); ++i)
      lines.push_back({street.line[i - 1], street.line[i]});
  }
  std::set<Point> places;
  for (const Polyline& line : lines) places.insert({line.front(), line.back()});
  out.nodes.assign(places.begin(), places.end());
  const auto number = [&](Point p) {
    return static_cast<std::uint32_t>(std::lower_bound(out.nodes.begin(), out.nodes.end(), p) -
                                      out.nodes.begin());
  };
  for (const Polyline& line : lines) {
    Street street;
    street.id = {static_cast<std::uint32_t>(out.streets.size())};
    street.line = line;
    street.from = number(line.front());
    street.to = number(line.back());
    out.streets.push_back(street);
  }
  return out;
}

// A ladder of three rungs with a dead end behind it; the lower rail bends at J.
constexpr std::string_view kLadder = R"(
   A-B-C-H
   | | |
   D-E-F

     J
)";
const std::vector<std::string> kLadderWays{"ABCH", "DEF", "AD", "BE", "CF", "EJ"};

TEST(NetworkGraph, StreetsThatOnlyGoOnAreOneEdge) {
  auto raw = streets_on(ascii_points("A-B\n  |\n  C", 10.0), {"AB", "BC"});
  raw[1].attributes.name = "other";
  const StreetNetwork network = build_network(raw).network;
  ASSERT_EQ(network.streets.size(), 2U);
  const NetworkGraph graph = network_graph(network);
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.nodes.size(), 2U);
  EXPECT_EQ(graph.edges[0].length_m, 40.0);
  EXPECT_EQ(graph.edges[0].streets.size(), 2U);
}

TEST(NetworkGraph, KeptPlacesStayNodes) {
  auto raw = streets_on(ascii_points("A-B\n  |\n  C", 10.0), {"AB", "BC"});
  raw[1].attributes.name = "other";
  const std::vector<Point> kept{{20.0, 20.0}, {777.0, 0.0}};
  const NetworkGraph graph = network_graph(build_network(raw).network, kept);
  EXPECT_EQ(graph.edges.size(), 2U);
  EXPECT_EQ(graph.nodes.size(), 3U);
}

TEST(NetworkGraph, RingWithoutAnIntersectionHasOneNode) {
  const NetworkGraph graph = network_graph(drawn("A-B\n| |\nD-C", {"ABCDA"}));
  ASSERT_EQ(graph.nodes.size(), 1U);
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.edges[0].from, graph.edges[0].to);
  EXPECT_EQ(graph.edges[0].length_m, 80.0);
  EXPECT_EQ(node_degrees(graph), std::vector<std::uint32_t>{2});
}

TEST(NetworkGraph, LadderHasItsIntersectionsAndDeadEnds) {
  const NetworkGraph graph = network_graph(drawn(kLadder, kLadderWays));
  // B, C, E of degree 3, 3 and 4; H and J dead ends; A, D, F just go on.
  std::vector<std::uint32_t> degrees = node_degrees(graph);
  std::sort(degrees.begin(), degrees.end());
  EXPECT_EQ(degrees, (std::vector<std::uint32_t>{1, 1, 3, 3, 4}));
  EXPECT_EQ(graph.edges.size(), 6U);
}

TEST(NetworkGraph, EveryStreetIsInOneEdgeAndSplittingChangesNothing) {
  Rng rng = property_rng("network_graph_split");
  int several = 0;
  for (int i = 0; i < plat::testing::iterations(20); ++i) {
    const StreetNetwork network = random_network(rng, 30);
    const NetworkGraph graph = network_graph(network);
    std::vector<int> times(network.streets.size(), 0);
    for (const auto& edge : graph.edges) {
      EXPECT_LE(edge.from, edge.to);
      for (const std::uint32_t street : edge.streets) ++times[street];
    }
    EXPECT_EQ(times, std::vector<int>(network.streets.size(), 1));
    const NetworkGraph again = network_graph(split(network));
    EXPECT_EQ(again.nodes, graph.nodes);
    EXPECT_EQ(again.edges.size(), graph.edges.size());
    several += graph.edges.size() > 30 ? 1 : 0;
  }
  EXPECT_GT(several, 10);
}

TEST(Circuity, IsLengthByStraightLength) {
  // One edge of 40 m whose ends are 20 sqrt 2 m apart.
  const NetworkGraph graph = network_graph(of_lines({{{0, 0}, {20, 0}, {20, 20}}}));
  EXPECT_NEAR(circuity(graph), 40.0 / (20.0 * std::numbers::sqrt2), 1e-12);
}

TEST(OrientationEntropy, OfAStraightStreetAGridAndAllDirections) {
  const auto entropy = [](const std::vector<Polyline>& lines) {
    return orientation_entropy(network_graph(of_lines(lines)), BearingWeight::kEdge);
  };
  EXPECT_NEAR(entropy({{{0, 0}, {0, 100}}}), std::log(2.0), 1e-12);
  EXPECT_NEAR(entropy({{{0, 0}, {0, 100}}, {{300, 0}, {400, 0}}}), std::log(4.0), 1e-12);
  std::vector<Polyline> fan;
  for (int k = 0; k < 18; ++k) {
    const double angle = k * 10.0 * std::numbers::pi / 180.0;
    const Point from{500.0 * k, 0.0};
    fan.push_back({from, from + 200.0 * Point{std::sin(angle), std::cos(angle)}});
  }
  EXPECT_NEAR(entropy(fan), std::log(36.0), 1e-12);
}

TEST(OrientationEntropy, ZeroIsTheMiddleOfABin) {
  const auto entropy = [](double a_deg, double b_deg) {
    std::vector<Polyline> lines;
    for (const double deg : {a_deg, b_deg}) {
      const double angle = deg * std::numbers::pi / 180.0;
      const Point from{500.0 * static_cast<double>(lines.size()), 0.0};
      lines.push_back({from, from + 200.0 * Point{std::sin(angle), std::cos(angle)}});
    }
    return orientation_entropy(network_graph(of_lines(lines)), BearingWeight::kEdge);
  };
  EXPECT_NEAR(entropy(-4.9, 4.9), std::log(2.0), 1e-12);
  EXPECT_NEAR(entropy(4.9, 5.1), std::log(4.0), 1e-12);
}

TEST(OrientationEntropy, MayCountEdgesByLength) {
  const NetworkGraph graph = network_graph(of_lines({{{0, 0}, {0, 300}}, {{500, 0}, {600, 0}}}));
  const double expected = -0.75 * std::log(0.375) - 0.25 * std::log(0.125);
  EXPECT_NEAR(orientation_entropy(graph, BearingWeight::kLength), expected, 1e-12);
}

TEST(MeasureFaces, IslandsAreTakenOffAndDeadEndsAreNot) {
  const StreetNetwork network = of_lines({{{0, 0}, {100, 0}, {100, 50}, {0, 50}, {0, 0}},
                                          {{10, 10}, {30, 10}, {30, 30}, {10, 30}, {10, 10}},
                                          {{50, 0}, {50, 20}}});
  std::vector<FaceShape> faces = measure_faces(network);
  ASSERT_EQ(faces.size(), 2U);
  std::sort(faces.begin(), faces.end(),
            [](const FaceShape& a, const FaceShape& b) { return a.area_m2 < b.area_m2; });
  EXPECT_EQ(faces[0].area_m2, 400.0);
  EXPECT_EQ(faces[0].aspect_ratio, 1.0);
  EXPECT_EQ(faces[1].area_m2, 5000.0 - 400.0);
  EXPECT_EQ(faces[1].perimeter_m, 300.0 + 80.0);
  EXPECT_EQ(faces[1].aspect_ratio, 2.0);
  EXPECT_EQ(faces[1].rectangularity, 4600.0 / 5000.0);
}

TEST(MeasureFaces, TunnelsBoundNone) {
  StreetNetwork network =
      of_lines({{{0, 0}, {100, 0}, {100, 50}, {0, 50}, {0, 0}}, {{50, 0}, {50, 50}}});
  EXPECT_EQ(measure_faces(network).size(), 2U);
  for (Street& street : network.streets) {
    const bool is_middle = street.line.front().x == 50.0 && street.line.back().x == 50.0;
    if (is_middle && street.line.size() == 2) street.attributes.structure = Structure::kTunnel;
  }
  EXPECT_EQ(measure_faces(network).size(), 1U);
}

/// All shortest ways by trying every intermediate node: what Brandes' sums must be.
std::vector<double> brute_force_betweenness(const NetworkGraph& graph) {
  const std::size_t n = graph.nodes.size();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  constexpr double kSame_m = 1e-6;  // shorter than the working grid, longer than rounding
  std::vector<std::vector<double>> d(n, std::vector<double>(n, kFar));
  for (std::size_t v = 0; v < n; ++v) d[v][v] = 0.0;
  for (const auto& e : graph.edges) {
    if (e.from == e.to) continue;
    d[e.from][e.to] = d[e.to][e.from] = std::min(d[e.from][e.to], e.length_m);
  }
  const auto edge = d;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
  // Ways from s to t: summed over the last edge, in the order of distance from s.
  std::vector<std::vector<double>> ways(n, std::vector<double>(n, 0.0));
  for (std::size_t s = 0; s < n; ++s) {
    std::vector<std::size_t> order;
    for (std::size_t v = 0; v < n; ++v) {
      if (d[s][v] < kFar) order.push_back(v);
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return d[s][a] < d[s][b]; });
    ways[s][s] = 1.0;
    for (const std::size_t v : order) {
      for (const std::size_t u : order) {
        if (u != v && edge[u][v] < kFar && std::abs(d[s][u] + edge[u][v] - d[s][v]) < kSame_m)
          ways[s][v] += ways[s][u];
      }
    }
  }
  std::vector<double> sums(n, 0.0);
  for (std::size_t s = 0; s < n; ++s)
    for (std::size_t t = s + 1; t < n; ++t)
      for (std::size_t v = 0; v < n && d[s][t] < kFar; ++v) {
        if (v != s && v != t && std::abs(d[s][v] + d[v][t] - d[s][t]) < kSame_m)
          sums[v] += ways[s][v] * ways[v][t] / ways[s][t];
      }
  const auto count = static_cast<double>(n);
  for (double& sum : sums) sum *= 2.0 / ((count - 1.0) * (count - 2.0));
  return sums;
}

TEST(MeasureRoutes, BetweennessIsThatOfBruteForce) {
  Rng rng = property_rng("betweenness_brute_force");
  int connected = 0;
  for (int i = 0; i < plat::testing::iterations(20); ++i) {
    const NetworkGraph graph = network_graph(random_network(rng, 40));
    const RouteMeasures routes = measure_routes(graph, {.sources = 100000, .targets = 1}, rng);
    EXPECT_EQ(routes.sources.size(), graph.nodes.size());
    const std::vector<double> expected = brute_force_betweenness(graph);
    for (std::size_t v = 0; v < expected.size(); ++v)
      ASSERT_NEAR(routes.betweenness[v], expected[v], 1e-9) << v;
    connected += *std::max_element(expected.begin(), expected.end()) > 0.05 ? 1 : 0;
  }
  EXPECT_GT(connected, 5);
}

TEST(MeasureRoutes, EquallyLongWaysShareTheBetweenness) {
  // Two ways of 40 m from A to C; the nodes on them would be none by their degree.
  const StreetNetwork network = split(drawn("A-B\n| |\nD-C", {"ABCDA"}));
  const std::vector<Point> kept{{0, 20}, {20, 20}, {20, 0}, {0, 0}};
  const NetworkGraph graph = network_graph(network, kept);
  ASSERT_EQ(graph.nodes.size(), 4U);
  Rng rng(1);
  const RouteMeasures routes = measure_routes(graph, {.sources = 4, .targets = 1}, rng);
  for (const double value : routes.betweenness) EXPECT_NEAR(value, 0.5 / 3.0, 1e-12);
}

TEST(MeasureRoutes, SomePivotsStandForAll) {
  Rng rng = property_rng("betweenness_pivots");
  const NetworkGraph graph = network_graph(random_network(rng, 40));
  const auto all = measure_routes(graph, {.sources = 100000, .targets = 1}, rng).betweenness;
  // The mean over many draws of pivots is the exact value.
  std::vector<double> sums(all.size(), 0.0);
  constexpr int kDraws = 400;
  for (int i = 0; i < kDraws; ++i) {
    const auto some = measure_routes(graph, {.sources = 10, .targets = 1}, rng);
    EXPECT_EQ(some.sources.size(), 10U);
    for (std::size_t v = 0; v < sums.size(); ++v) sums[v] += some.betweenness[v] / kDraws;
  }
  const auto most =
      static_cast<std::size_t>(std::max_element(all.begin(), all.end()) - all.begin());
  ASSERT_GT(all[most], 0.0);
  EXPECT_NEAR(sums[most] / all[most], 1.0, 0.1);
}

TEST(MeasureRoutes, RoutesAreAsLongAsTheStreets) {
  // An L of two edges of 30 m: a dead end at B keeps its corner a node.
  const NetworkGraph graph =
      network_graph(of_lines({{{0, 0}, {30, 0}}, {{30, 0}, {30, 30}}, {{30, 0}, {40, 0}}}));
  Rng rng(3);
  const RouteMeasures routes = measure_routes(graph, {.sources = 4, .targets = 50}, rng);
  EXPECT_EQ(routes.routes.size(), 200U);
  EXPECT_EQ(routes.unreachable, 0U);
  double longest = 0.0;
  for (const Route& route : routes.routes) {
    EXPECT_NE(route.from, route.to);
    longest = std::max(longest, route.ratio());
  }
  EXPECT_NEAR(longest, std::numbers::sqrt2, 1e-12);
}

TEST(MeasureRoutes, PairsThatNoWayConnectsAreCounted) {
  const NetworkGraph graph = network_graph(of_lines({{{0, 0}, {30, 0}}, {{500, 0}, {530, 0}}}));
  Rng rng(4);
  const RouteMeasures routes = measure_routes(graph, {.sources = 4, .targets = 60}, rng);
  EXPECT_EQ(routes.routes.size() + routes.unreachable, 240U);
  EXPECT_GT(routes.unreachable, 100U);
  EXPECT_GT(routes.routes.size(), 40U);
}

double value_of(const NetworkMeasures& measures, std::string_view name) {
  for (const NetworkScalar& scalar : network_scalars()) {
    if (scalar.name == name) return scalar.value(measures).value();
  }
  ADD_FAILURE() << "no scalar " << name;
  return 0.0;
}

TEST(MeasureNetwork, LadderHasTheNumbersOfItsDrawing) {
  Rng rng(5);
  const NetworkMeasures measures = measure_network(drawn(kLadder, kLadderWays), {}, rng);
  EXPECT_EQ(measures.intersections, 3U);
  EXPECT_EQ(measures.dead_ends, 2U);
  EXPECT_EQ(measures.land_area_m2, 2 * 20.0 * 20.0);
  EXPECT_EQ(value_of(measures, "dead_end_share_01"), 0.4);
  EXPECT_EQ(value_of(measures, "mean_degree"), 12.0 / 5.0);
  EXPECT_NEAR(value_of(measures, "edges_per_km2"), 6.0 / 800e-6, 1e-6);
  EXPECT_NEAR(value_of(measures, "length_km_per_km2"), 180.0 / 800e-6 / 1000.0, 1e-6);
}

TEST(MeasureNetwork, ARingIsNeitherAnIntersectionNorADeadEnd) {
  Rng rng(5);
  const NetworkMeasures measures = measure_network(drawn("A-B\n| |\nD-C", {"ABCDA"}), {}, rng);
  EXPECT_EQ(measures.node_degree, std::vector<double>{2.0});
  EXPECT_EQ(measures.intersections, 0U);
  EXPECT_EQ(measures.dead_ends, 0U);
}

TEST(MeasureNetwork, DensitiesArePerTheLandGiven) {
  Rng rng(5);
  NetworkMeasureOptions options;
  options.land_area_m2 = 1e6;
  const NetworkMeasures measures = measure_network(drawn(kLadder, kLadderWays), options, rng);
  EXPECT_EQ(value_of(measures, "edges_per_km2"), 6.0);
  EXPECT_EQ(value_of(measures, "land_area_km2"), 1.0);
}

TEST(MeasureNetwork, ANetworkWithoutFacesHasNoDensities) {
  Rng rng(5);
  const NetworkMeasures measures = measure_network(of_lines({{{0, 0}, {30, 0}}}), {}, rng);
  for (const NetworkScalar& scalar : network_scalars()) {
    const bool is_density = scalar.name.ends_with("_per_km2");
    EXPECT_EQ(scalar.value(measures).has_value(), !is_density) << scalar.name;
  }
}

TEST(MeasureNetwork, ANetworkWithoutStreetsHasNothing) {
  Rng rng(5);
  const NetworkMeasures measures = measure_network({}, {}, rng);
  for (const NetworkSample& sample : network_samples())
    EXPECT_TRUE(sample.values(measures).empty()) << sample.name;
}

TEST(MeasureNetwork, TurnedMirroredAndMovedNetworksMeasureTheSame) {
  Rng rng = property_rng("measure_network_twins");
  const StreetNetwork network = random_network(rng, 80);
  const auto place = [&](auto move) {
    std::vector<Polyline> lines;
    for (const Street& street : network.streets) {
      Polyline line;
      for (const Point p : street.line) line.push_back(move(p));
      lines.push_back(line);
    }
    NetworkMeasureOptions options;
    options.routes = {.sources = 100000, .targets = 1};
    Rng stream(6);
    return measure_network(of_lines(lines), options, stream);
  };
  const NetworkMeasures measures = place([](Point p) { return p; });
  ASSERT_GT(measures.block_area_m2.size(), 5U);
  for (const NetworkMeasures& twin : {place([](Point p) { return perpendicular(p); }),
                                      place([](Point p) { return Point{-p.x, p.y}; }),
                                      place([](Point p) { return p + Point{2000.0, -512.0}; })}) {
    for (const NetworkSample& sample : network_samples()) {
      // Nodes are drawn by their order; a triangle has three boxes of least area.
      if (sample.name == "transport_ratio" || sample.name == "block_aspect_ratio") continue;
      std::vector<double> a = sample.values(measures);
      std::vector<double> b = sample.values(twin);
      ASSERT_EQ(a.size(), b.size()) << sample.name;
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i], b[i], 1e-9 * std::max(1.0, std::abs(a[i]))) << sample.name;
    }
    EXPECT_NEAR(measures.circuity, twin.circuity, 1e-12);
  }
}

}  // namespace
}  // namespace plat::streets
