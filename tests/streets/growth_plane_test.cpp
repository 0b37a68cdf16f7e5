#include "streets/growth_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/exact_orientation.h"
#include "support/property.h"

namespace plat::streets {
namespace {

GrowthSite site_of(std::vector<Point> places) {
  GrowthSite site;
  PassingStreet street;
  street.distance_mean_m = 100.0;
  for (const Point p : places) site.points.push_back({p, street, {}, {}});
  return site;
}

GrowthPlane plane_over(const GrowthSite& site) {
  auto plane = GrowthPlane::over(site);
  EXPECT_TRUE(plane.has_value()) << (plane ? "" : plane.error().message);
  return std::move(*plane);
}

Polygon box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

StreetNetwork one_street(Polyline line) {
  StreetNetwork network;
  network.nodes = {line.front(), line.back()};
  Street street;
  street.from = 0;
  street.to = 1;
  street.line = std::move(line);
  street.width_m = 10.0;
  network.streets.push_back(street);
  return network;
}

TEST(GrowthPlane, CoincidentPointsShareAVertexAlsoWithAnExistingNode) {
  GrowthSite site = site_of({{50, 50}, {0, 0}, {50, 50}});
  site.existing = one_street({{0, 0}, {0, 90}});
  const GrowthPlane plane = plane_over(site);
  EXPECT_EQ(plane.vertices().size(), 3U);
  EXPECT_EQ(plane.vertex_of_point(0), plane.vertex_of_point(2));
  EXPECT_EQ(plane.vertex_of_point(1), 0U);
}

TEST(GrowthPlane, RefusesCrossings) {
  GrowthPlane plane = plane_over(site_of({{0, 0}, {10, 10}, {0, 10}, {10, 0}}));
  EXPECT_TRUE(plane.admits(2, 3));
  plane.add(0, 1);
  EXPECT_FALSE(plane.admits(2, 3));
  EXPECT_TRUE(plane.admits(0, 2));
}

TEST(GrowthPlane, RefusesWhatIsThereAlready) {
  GrowthSite site = site_of({{0, 0}, {10, 0}});
  site.existing = one_street({{20, 0}, {25, 5}, {30, 0}});
  GrowthPlane plane = plane_over(site);
  EXPECT_FALSE(plane.admits(0, 1)) << "connected by a bent street";
  plane.add(2, 3);
  EXPECT_FALSE(plane.admits(2, 3));
  EXPECT_FALSE(plane.admits(3, 2));
  EXPECT_FALSE(plane.admits(2, 2));
}

TEST(GrowthPlane, RefusesToPassThroughAVertex) {
  const GrowthPlane plane = plane_over(site_of({{0, 0}, {20, 20}, {10, 10}}));
  EXPECT_FALSE(plane.admits(0, 1));
  EXPECT_TRUE(plane.admits(0, 2));
}

TEST(GrowthPlane, RefusesOverlapsAndTouchesButInCommonEnds) {
  GrowthSite site = site_of({{0, 0}, {20, 0}, {10, 5}, {5, -5}});
  site.existing = one_street({{-10, 0}, {-5, 20}, {10, 5}});  // its end is point 2
  site.existing.nodes[1] = {10, 5};
  GrowthPlane plane = plane_over(site);
  plane.add(2, 3);
  EXPECT_TRUE(plane.admits(3, 1)) << "meets it at a node";
  // A vertex on the inside of a street can only be reached by crossing or touching it.
  GrowthSite other = site_of({{0, 10}, {10, 20}});
  other.existing = one_street({{-10, 10}, {10, 10}});
  EXPECT_FALSE(plane_over(other).admits(2, 3));
}

TEST(GrowthPlane, RefusesABendOfAStreetAsAnEnd) {
  GrowthSite site = site_of({{5, 5}, {5, 30}});
  site.existing = one_street({{0, 0}, {5, 5}, {10, 0}});
  EXPECT_FALSE(plane_over(site).admits(2, 3));
}

TEST(GrowthPlane, StaysInsideTheBoundary) {
  // A boundary shaped like a U: straight from arm to arm leaves it.
  GrowthSite site = site_of({{10, 90}, {90, 90}, {10, 10}, {50, 200}});
  site.boundary = Polygon{
      {{0, 0}, {100, 0}, {100, 100}, {60, 100}, {60, 20}, {40, 20}, {40, 100}, {0, 100}}, {}};
  const GrowthPlane plane = plane_over(site);
  EXPECT_FALSE(plane.admits(0, 1));
  EXPECT_TRUE(plane.admits(0, 2));
  EXPECT_FALSE(plane.is_usable(3));
  EXPECT_FALSE(plane.admits(0, 3));
}

TEST(GrowthPlane, MayTouchTheBoundaryAndRunAlongIt) {
  GrowthSite site = site_of({{0, 0}, {0, 100}, {50, 50}, {100, 100}, {20, 100}, {80, 100}});
  site.boundary = Polygon{
      {{0, 0}, {100, 0}, {100, 100}, {60, 100}, {60, 50}, {40, 50}, {40, 100}, {0, 100}}, {}};
  const GrowthPlane plane = plane_over(site);
  EXPECT_TRUE(plane.admits(0, 1)) << "along an edge";
  EXPECT_TRUE(plane.admits(0, 2)) << "to a place on an edge";
  EXPECT_FALSE(plane.admits(1, 2)) << "the notch is outside";
  EXPECT_FALSE(plane.admits(4, 5)) << "along the notch's mouth";
  EXPECT_TRUE(plane.admits(2, 0));
}

TEST(GrowthPlane, StaysOutOfObstacles) {
  GrowthSite site = site_of({{0, 0}, {100, 0}, {50, 0}, {40, 20}, {60, 20}, {40, -10}, {60, -10}});
  site.obstacles = {box(40, -10, 60, 10)};
  const GrowthPlane plane = plane_over(site);
  EXPECT_FALSE(plane.admits(0, 1));
  EXPECT_FALSE(plane.is_usable(2)) << "in the water";
  EXPECT_TRUE(plane.admits(3, 4));
  EXPECT_TRUE(plane.admits(5, 6)) << "along the shore";
}

TEST(GrowthPlane, CurvesAreHeldToTheSame) {
  GrowthPlane plane = plane_over(site_of({{0, 0}, {100, 0}, {0, 30}, {100, 30}, {50, 20}}));
  plane.add(0, 1);
  plane.add(2, 3);
  EXPECT_FALSE(plane.bend(0, 1, Polyline{{0, 0}, {50, 40}, {100, 0}})) << "crosses a street";
  EXPECT_FALSE(plane.bend(0, 1, Polyline{{0, 0}, {50, 20}, {100, 0}})) << "bends at a vertex";
  EXPECT_FALSE(plane.bend(0, 1, Polyline{{0, 0}, {60, -9}, {40, -9}, {70, 9}, {30, 3}, {100, 0}}))
      << "crosses itself";
  EXPECT_TRUE(plane.bend(0, 1, Polyline{{0, 0}, {50, 15}, {100, 0}}));
  EXPECT_FALSE(plane.bend(2, 3, Polyline{{0, 30}, {50, 14}, {100, 30}})) << "crosses the curve";
  EXPECT_TRUE(plane.bend(2, 3, Polyline{{0, 30}, {50, 16}, {100, 30}}))
      << "the straight one is gone";
}

TEST(GrowthPlane, DecisionsAreExactFarFromTheOriginAndOverLongWays) {
  // A vertex one grid step beside a way of 50 km, where a double cross product rounds.
  const double step = kGridStep_m;
  const Point far{1'000'000.0, 1'000'000.0};
  const GrowthSite on =
      site_of({far, far + Point{50'001.0, 33'334.0}, far + Point{25'000.5, 16'667.0}});
  EXPECT_FALSE(plane_over(on).admits(0, 1));
  const GrowthSite beside =
      site_of({far, far + Point{50'001.0, 33'334.0}, far + Point{25'000.5, 16'667.0 + step}});
  EXPECT_TRUE(plane_over(beside).admits(0, 1));
}

TEST(GrowthPlane, AgreesWithBruteForce) {
  int admitted = 0;
  int refused = 0;
  Rng rng = testing::property_rng("GrowthPlane.AgreesWithBruteForce");
  for (int round = 0; round < testing::iterations(40); ++round) {
    std::vector<Point> places;
    for (int i = 0; i < 30; ++i)
      places.push_back({static_cast<double>(rng.index(12)), static_cast<double>(rng.index(12))});
    GrowthSite site = site_of(places);
    for (IntersectionPoint& point : site.points) point.a.distance_mean_m = 2.0;
    GrowthPlane plane = plane_over(site);
    const auto vertices = plane.vertices();
    std::vector<Segment> there;
    for (int k = 0; k < 120; ++k) {
      const auto u = static_cast<std::uint32_t>(rng.index(vertices.size()));
      const auto v = static_cast<std::uint32_t>(rng.index(vertices.size()));
      const Segment s{vertices[u], vertices[v]};
      bool expected = u != v;
      for (const Point p : vertices)
        if (p != s.a && p != s.b && lies_on(s, p)) expected = false;
      for (const Segment& t : there) {
        const bool is_joined = s.a == t.a || s.a == t.b || s.b == t.a || s.b == t.b;
        const bool is_same = (s.a == t.a && s.b == t.b) || (s.a == t.b && s.b == t.a);
        if (is_same || (!is_joined && meet(s, t))) expected = false;
      }
      ASSERT_EQ(plane.admits(u, v), expected);
      (expected ? admitted : refused)++;
      if (!expected) continue;
      plane.add(u, v);
      there.push_back(s);
    }
  }
  EXPECT_GT(admitted, 300);
  EXPECT_GT(refused, 300);
}

TEST(GrowthPlane, FailsForSitesThatCannotBeUsed) {
  const auto code = [](const GrowthSite& site) { return GrowthPlane::over(site).error().code; };
  EXPECT_EQ(code(site_of({{0, 0}, {std::nan(""), 0}})), FailureCode::kNotFinite);
  EXPECT_EQ(code(site_of({{1e9, 0}})), FailureCode::kNotFinite);
  GrowthSite site = site_of({{0, 0}});
  site.open_ends.push_back({.node = 0});
  EXPECT_EQ(code(site), FailureCode::kUnknownEntity);
  site = site_of({{0, 0}});
  site.boundary = Polygon{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}};
  EXPECT_EQ(code(site), FailureCode::kNotSimple);
  site.boundary = Polygon{};
  EXPECT_FALSE(GrowthPlane::over(site).has_value());
  site = site_of({{0, 0}});
  site.existing = one_street({{0, 0}, {10, 0}});
  site.existing.nodes[1] = {11, 0};
  EXPECT_EQ(code(site), FailureCode::kEmptyGeometry);
}

TEST(AssembleGrowth, KeepsExistingStreetsFirstAndUnchangedButForNodeNumbers) {
  GrowthSite site = site_of({{-50, 0}, {100, 0}, {200, 200}});
  site.existing = one_street({{0, 0}, {5, 5}, {100, 0}});
  GrowthPlane plane = plane_over(site);
  ASSERT_TRUE(plane.admits(2, 0));
  plane.add(2, 0);
  const std::vector<GrownEdge> edges{{.from = 2, .to = 0, .segment = {1, 0}, .width_m = 8.0}};
  const Growth growth = assemble_growth(site, plane, edges);
  EXPECT_EQ(growth.network.nodes, (std::vector<Point>{{-50, 0}, {0, 0}, {100, 0}}));
  ASSERT_EQ(growth.network.streets.size(), 2U);
  EXPECT_EQ(growth.network.streets[0].line, site.existing.streets[0].line);
  EXPECT_EQ(growth.network.streets[0].from, 1U);
  EXPECT_EQ(growth.network.streets[0].to, 2U);
  EXPECT_EQ(growth.network.streets[1].from, 0U);
  EXPECT_EQ(growth.network.streets[1].to, 1U);
  EXPECT_EQ(growth.network.streets[1].width_m, 8.0);
  EXPECT_EQ(growth.network.streets[1].width_source, WidthSource::kExample);
  EXPECT_EQ(growth.segments.at(0).hierarchy, 1);
  EXPECT_EQ(growth.left_alone, (std::vector<std::uint32_t>{1, 2}));
}

TEST(AssembleGrowth, NodesCrossingsWhereAGrowerAllowedThem) {
  const GrowthSite site = site_of({{0, 0}, {100, 100}, {0, 100}, {100, 0}});
  GrowthPlane plane = plane_over(site);
  plane.add(0, 1);
  const auto crossings = plane.crossings(2, 3);
  ASSERT_TRUE(crossings.has_value());
  EXPECT_EQ(*crossings, (std::vector<Point>{{50, 50}}));
  plane.add_across(2, 3, *crossings);
  const std::vector<GrownEdge> edges{{.from = 0, .to = 1, .segment = {0, 0}},
                                     {.from = 2, .to = 3, .segment = {0, 1}}};
  const Growth growth = assemble_growth(site, plane, edges);
  EXPECT_EQ(growth.network.nodes.size(), 5U);
  EXPECT_EQ(growth.network.streets.size(), 4U);
  EXPECT_EQ(node_degrees(growth.network), (std::vector<std::uint32_t>{1, 1, 4, 1, 1}));
}

TEST(AssembleGrowth, EndsAStreetAtTheOneItWouldCross) {
  const GrowthSite site = site_of({{0, 0}, {100, 100}, {0, 100}, {100, 0}});
  GrowthPlane plane = plane_over(site);
  plane.add(0, 1);
  const std::uint32_t tee = plane.add_up_to(2, 3, *plane.crossings(2, 3));
  const std::vector<GrownEdge> edges{{.from = 0, .to = 1, .segment = {0, 0}},
                                     {.from = 2, .to = tee, .segment = {0, 1}}};
  const Growth growth = assemble_growth(site, plane, edges);
  EXPECT_EQ(growth.network.streets.size(), 3U);
  EXPECT_EQ(growth.left_alone, (std::vector<std::uint32_t>{3}));
}

TEST(GrowthPlane, CrossingsKeepClearOfNodesAndExistingStreets) {
  GrowthSite site = site_of({{0, 0}, {100, 100}, {0, 100}, {100, 0}, {50, 50.5}});
  GrowthPlane plane = plane_over(site);
  plane.add(0, 1);
  EXPECT_FALSE(plane.crossings(2, 3).has_value()) << "half a metre from a vertex";
  site = site_of({{0, 100}, {100, 0}});
  site.existing = one_street({{0, 0}, {100, 100}});
  EXPECT_FALSE(plane_over(site).crossings(2, 3).has_value());
}

}  // namespace
}  // namespace plat::streets
