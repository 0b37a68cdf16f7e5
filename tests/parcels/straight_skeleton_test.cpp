#include "parcels/straight_skeleton.h"

#include <gtest/gtest.h>

#include <numbers>

#include "parcels/made_blocks.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

FailureCode code_of(const Polygon& polygon, const SkeletonLimits& limits = {}) {
  const auto skeleton = straight_skeleton(polygon, limits);
  return skeleton ? FailureCode{0} : skeleton.error().code;
}

const Polygon kSquare{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {}};

TEST(StraightSkeleton, SquareHasFourEqualFacesThatMeetInTheMiddle) {
  const StraightSkeleton s = straight_skeleton(kSquare).value();
  ASSERT_EQ(s.faces.size(), 4U);
  for (const Ring& face : s.faces) EXPECT_DOUBLE_EQ(signed_area_m2(face), 100.0);
  ASSERT_EQ(s.nodes.size(), 5U);
  EXPECT_EQ(s.nodes[4].position, (Point{10, 10}));
  EXPECT_DOUBLE_EQ(s.nodes[4].time_m, 10.0);
  EXPECT_EQ(s.arcs.size(), 4U);
}

TEST(StraightSkeleton, RectangleHasARidge) {
  const StraightSkeleton s = straight_skeleton(testing::rectangle_block(50, 20).contour).value();
  ASSERT_EQ(s.nodes.size(), 6U);
  EXPECT_EQ(s.arcs.size(), 5U);
  EXPECT_DOUBLE_EQ(signed_area_m2(s.faces[0]), 50.0 * 10.0 - 100.0);
  EXPECT_DOUBLE_EQ(signed_area_m2(s.faces[1]), 100.0);
}

TEST(StraightSkeleton, ReflexCornerOfAnLHasAnArcToo) {
  const Polygon l{{{0, 0}, {40, 0}, {40, 10}, {10, 10}, {10, 40}, {0, 40}}, {}};
  const StraightSkeleton s = straight_skeleton(l).value();
  EXPECT_EQ(s.faces.size(), 6U);
  int at_reflex = 0;
  for (const auto& arc : s.arcs) at_reflex += arc.lower == 3 ? 1 : 0;
  EXPECT_EQ(at_reflex, 1);
}

TEST(StraightSkeleton, CourtyardHasFacesOfItsOwnEdges) {
  const Polygon p{{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{{10, 10}, {10, 20}, {20, 20}, {20, 10}}}};
  const StraightSkeleton s = straight_skeleton(p).value();
  ASSERT_EQ(s.faces.size(), 8U);
  for (std::size_t k = 4; k < 8; ++k) EXPECT_EQ(s.faces[k].front(), p.holes[0][k - 4]);
}

TEST(StraightSkeleton, FacesSumToTheBlockAndTimesAreDistances) {
  Rng rng = testing::property_rng("StraightSkeleton.Random");
  int inner_nodes = 0;
  for (const Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(150))) {
    const auto s = straight_skeleton(polygon);
    ASSERT_TRUE(s) << s.error().message;
    std::vector<Segment> edges;
    for_each_edge(polygon, [&](const Segment& e) { edges.push_back(e); });
    ASSERT_EQ(s->faces.size(), edges.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      ASSERT_EQ(s->faces[k][0], edges[k].a) << "a face starts with its edge";
      ASSERT_EQ(s->faces[k][1], edges[k].b);
      sum += signed_area_m2(s->faces[k]);
    }
    EXPECT_NEAR(sum, area_m2(polygon), 1e-6 * sum);
    for (const auto& arc : s->arcs) {
      ASSERT_LE(s->nodes[arc.lower].time_m, s->nodes[arc.upper].time_m);
      const auto& top = s->nodes[arc.upper];
      ++inner_nodes;
      for (const std::uint32_t face : arc.faces) {
        // Distance to the edge's line is the time at which the front arrives.
        const Segment& e = edges[face];
        EXPECT_NEAR(cross(normalized(e.b - e.a), top.position - e.a), top.time_m, 1e-6);
      }
    }
  }
  EXPECT_GT(inner_nodes, testing::iterations(150) * 5);
}

TEST(StraightSkeleton, GatesAnswerWithACode) {
  Polygon clockwise = kSquare;
  std::reverse(clockwise.outer.begin(), clockwise.outer.end());
  EXPECT_EQ(code_of(clockwise), FailureCode::kNotSimple);
  EXPECT_EQ(code_of({{{0, 0}, {20, 20}, {20, 0}, {0, 20}}, {}}), FailureCode::kNotSimple)
      << "bow-tie";
  EXPECT_EQ(code_of({{{0, 0}, {20, 0}, {20, 0}, {20, 20}}, {}}), FailureCode::kNotSimple)
      << "duplicate vertex";
  EXPECT_EQ(code_of({kSquare.outer, {{{10, 10}, {10, 30}, {15, 10}}}}), FailureCode::kBadHole);
  EXPECT_EQ(code_of({kSquare.outer, {{{0, 5}, {5, 10}, {5, 5}}}}), FailureCode::kBadHole)
      << "a hole that touches";
  EXPECT_EQ(code_of({}), FailureCode::kEmptyGeometry);
}

TEST(StraightSkeleton, LimitsAnswerWithACode) {
  EXPECT_EQ(code_of(kSquare, {.max_vertices = 3}), FailureCode::kTooManyVertices);
  EXPECT_EQ(code_of(kSquare, {.max_events = 2}), FailureCode::kTimeLimit);
  EXPECT_EQ(code_of(kSquare, {.max_vertices = 4}), FailureCode{0});
}

TEST(StraightSkeleton, TimeGuardStopsALongConstruction) {
  Rng rng = testing::property_rng("StraightSkeleton.Guard");
  const Ring star = testing::star_ring(rng, 200, 50, 100, {0, 0});
  const auto admitted = admit_polygon({star, {}}, 1000);
  ASSERT_TRUE(admitted);
  EXPECT_EQ(code_of(*admitted, {.max_seconds = 0.0}), FailureCode::kTimeLimit);
}

}  // namespace
}  // namespace plat::parcels
