#include "core/planar_graph.h"

#include <gtest/gtest.h>

#include "core/planar_faces.h"
#include "core/working_grid.h"
#include "support/property.h"

namespace plat {
namespace {

std::vector<Segment> random_segments(Rng& rng, int n, double extent_m) {
  std::vector<Segment> out;
  for (int i = 0; i < n; ++i) {
    const Point a{rng.uniform(0, extent_m), rng.uniform(0, extent_m)};
    out.push_back({a, a + Point{rng.uniform(-30, 30), rng.uniform(-30, 30)}});
  }
  return out;
}

/// Guarantee 1, by brute force: no two edges cross or overlap, no node lies inside an edge.
void expect_planar(const PlanarGraph& g) {
  for (std::size_t i = 0; i < g.edges.size(); ++i) {
    const Point a = g.nodes[g.edges[i].from];
    const Point b = g.nodes[g.edges[i].to];
    ASSERT_NE(a, b);
    for (const Point p : g.nodes) {
      if (p == a || p == b || orientation(a, b, p) != 0.0) continue;
      ASSERT_FALSE(dot(p - a, p - b) < 0.0)
          << "node (" << p.x << ", " << p.y << ") lies on an edge";
    }
    for (std::size_t j = i + 1; j < g.edges.size(); ++j) {
      const Point c = g.nodes[g.edges[j].from];
      const Point d = g.nodes[g.edges[j].to];
      const bool cross = orientation(a, b, c) * orientation(a, b, d) < 0 &&
                         orientation(c, d, a) * orientation(c, d, b) < 0;
      ASSERT_FALSE(cross) << "edges " << i << " and " << j;
    }
  }
}

TEST(NodeSegments, CrossingBecomesANode) {
  const std::vector<Segment> cross{{{0, 0}, {10, 10}}, {{0, 10}, {10, 0}}};
  const PlanarGraph g = node_segments(cross);
  EXPECT_EQ(g.nodes.size(), 5U);
  EXPECT_EQ(g.edges.size(), 4U);
}

TEST(NodeSegments, TouchingEndSplitsTheOtherSegmentThoughItIsOffTheGrid) {
  const Point foot = lerp({0, 0}, {10, 3}, 0.37);
  const std::vector<Segment> tee{{{0, 0}, {10, 3}}, {snap(foot), {4, 9}}};
  const PlanarGraph g = node_segments(tee);
  EXPECT_EQ(g.edges.size(), 3U);
}

TEST(NodeSegments, OverlapIsOneEdgeAndReported) {
  const std::vector<Segment> twice{{{0, 0}, {10, 0}}, {{4, 0}, {14, 0}}};
  const PlanarGraph g = node_segments(twice);
  EXPECT_EQ(g.edges.size(), 3U);
  ASSERT_EQ(g.overlaps.size(), 1U);
  EXPECT_EQ(g.edges[g.overlaps[0].edge].source, 0U);
  EXPECT_EQ(g.overlaps[0].source, 1U);
}

TEST(NodeSegments, RandomSegmentsArePlanarAndOnTheGrid) {
  Rng rng = testing::property_rng("NodeSegments.Random");
  int edges = 0;
  for (int i = 0; i < testing::iterations(20); ++i) {
    const PlanarGraph g = node_segments(random_segments(rng, 60, 60.0));
    for (const Point p : g.nodes) ASSERT_TRUE(is_on_grid(p));
    expect_planar(g);
    edges += static_cast<int>(g.edges.size());
  }
  EXPECT_GT(edges, testing::iterations(20) * 200) << "the cases must really cross";
}

TEST(NodeSegments, NearlyParallelBundleConverges) {
  std::vector<Segment> bundle;
  for (int i = 0; i < 40; ++i)
    bundle.push_back({{0, i * kGridStep_m}, {100, (40 - i) * kGridStep_m}});
  expect_planar(node_segments(bundle));
}

TEST(NodeSegments, OrderOfInputDoesNotMatter) {
  Rng rng = testing::property_rng("NodeSegments.Order");
  std::vector<Segment> segments = random_segments(rng, 80, 80.0);
  const PlanarGraph forward = node_segments(segments);
  std::reverse(segments.begin(), segments.end());
  const PlanarGraph backward = node_segments(segments);
  EXPECT_EQ(forward.nodes, backward.nodes);
  EXPECT_EQ(forward.edges.size(), backward.edges.size());
}

TEST(IsNoded, SpikeNarrowerThanAGridStepIsNot) {
  const double step = kGridStep_m;
  EXPECT_TRUE(is_noded({{{0, 0}, {50, 0}, {50, 40}, {0, 40}}, {}}));
  // The vertex (22, 40 + step) lies a fifteenth of a step off the edge that ends at (20, 40 +
  // step).
  EXPECT_FALSE(
      is_noded({{{0, 0}, {50, 0}, {50, 40}, {20, 40 + step}, {22, 40 + step}, {0, 41}}, {}}));
}

TEST(FindFaces, GridOfSquares) {
  std::vector<Segment> lines;
  for (int i = 0; i <= 4; ++i) {
    lines.push_back({{10.0 * i, 0}, {10.0 * i, 40}});
    lines.push_back({{0, 10.0 * i}, {40, 10.0 * i}});
  }
  const PlanarGraph g = node_segments(lines);
  const PlanarFaces faces = find_faces(g);
  ASSERT_EQ(faces.faces.size(), 16U);
  for (const Face& f : faces.faces) EXPECT_DOUBLE_EQ(area_m2(polygon_of(g, f)), 100.0);
}

TEST(FindFaces, NestedComponentsAreIslandsOfTheInnermostFace) {
  std::vector<Segment> lines;
  const auto square = [&](double low, double high) {
    const Ring r{{low, low}, {high, low}, {high, high}, {low, high}};
    for (std::size_t i = 0; i < 4; ++i) lines.push_back({r[i], r[(i + 1) % 4]});
  };
  square(0, 100);
  square(20, 80);
  square(40, 60);
  lines.push_back({{85, 50}, {95, 50}});  // an isolated street in the outer face
  const PlanarGraph g = node_segments(lines);
  const PlanarFaces faces = find_faces(g);
  ASSERT_EQ(faces.faces.size(), 3U);
  std::vector<double> areas;
  for (const Face& f : faces.faces) areas.push_back(area_m2(polygon_of(g, f)));
  std::sort(areas.begin(), areas.end());
  EXPECT_DOUBLE_EQ(areas[0], 400.0);
  EXPECT_DOUBLE_EQ(areas[1], 3600.0 - 400.0);
  EXPECT_DOUBLE_EQ(areas[2], 10000.0 - 3600.0);
}

TEST(FindFaces, AreasAddUpOverRandomGraphs) {
  Rng rng = testing::property_rng("FindFaces.Areas");
  int faces_seen = 0;
  for (int i = 0; i < testing::iterations(20); ++i) {
    std::vector<Segment> segments = random_segments(rng, 80, 70.0);
    const Ring frame{{-50, -50}, {150, -50}, {150, 150}, {-50, 150}};
    for (std::size_t k = 0; k < 4; ++k) segments.push_back({frame[k], frame[(k + 1) % 4]});
    const PlanarGraph g = node_segments(segments);
    const PlanarFaces faces = find_faces(g);
    double sum = 0.0;
    for (const Face& f : faces.faces) sum += area_m2(polygon_of(g, f));
    EXPECT_NEAR(sum, 40000.0, 1e-6);
    faces_seen += static_cast<int>(faces.faces.size());
  }
  EXPECT_GT(faces_seen, testing::iterations(20) * 20);
}

TEST(FindDeadEnds, TreesGoButCyclesStay) {
  const std::vector<Segment> lines{{{0, 0}, {10, 0}},
                                   {{10, 0}, {10, 10}},
                                   {{10, 10}, {0, 0}},
                                   {{10, 0}, {20, 0}},
                                   {{20, 0}, {25, 5}}};
  const PlanarGraph g = node_segments(lines);
  EXPECT_EQ(without_edges(g, find_dead_ends(g)).edges.size(), 3U);
}

TEST(SplitAtRepeatedNodes, FaceTouchingItselfBecomesAHole) {
  // A square with a triangle hanging from its corner inside: the face around it touches itself in
  // the corner.
  const std::vector<Segment> lines{{{0, 0}, {40, 0}}, {{40, 0}, {40, 40}}, {{40, 40}, {0, 40}},
                                   {{0, 40}, {0, 0}}, {{0, 0}, {20, 10}},  {{20, 10}, {10, 20}},
                                   {{10, 20}, {0, 0}}};
  const PlanarGraph g = node_segments(lines);
  const PlanarFaces faces = find_faces(g);
  ASSERT_EQ(faces.faces.size(), 2U);
  int with_hole = 0;
  for (const Face& f : faces.faces) with_hole += polygon_of(g, f).holes.size() == 1 ? 1 : 0;
  EXPECT_EQ(with_hole, 1);
}

}  // namespace
}  // namespace plat
