#include "parcels/skeleton_offset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

LowerPart cut(const Polygon& polygon, double offset_m, double min_width_m = 0.0) {
  return cut_roof(straight_skeleton(polygon).value(), offset_m, min_width_m);
}

/// Signed areas of the rim's loops, smallest first.
std::vector<double> loop_areas(const LowerPart& part) {
  std::map<std::uint32_t, std::uint32_t> next;
  for (const OffsetEdge& e : part.rim) next[e.from] = e.to;
  std::vector<double> out;
  while (!next.empty()) {
    Ring ring;
    for (auto it = next.begin(); it != next.end();) {
      const auto [from, to] = *it;
      ring.push_back(part.skeleton.nodes[from].position);
      next.erase(it);
      it = next.find(to);
    }
    out.push_back(signed_area_m2(ring));
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(SkeletonOffset, OfARectangleIsTheSmallerRectangle) {
  const LowerPart part = cut({{{0, 0}, {100, 0}, {100, 60}, {0, 60}}, {}}, 10.0);
  ASSERT_EQ(part.rim.size(), 4U);
  EXPECT_NEAR(loop_areas(part).at(0), 80.0 * 40.0, 1e-9);
  EXPECT_EQ(part.skeleton.arcs.size(), 4U) << "the corners' diagonals, the ridge is gone";
}

TEST(SkeletonOffset, PartsTheInsideOfANonConvexBlock) {
  // Two squares and a passage between them [VKW12, fig. 3 right].
  const Polygon dumbbell{{{0, 0},
                          {60, 0},
                          {60, 20},
                          {80, 20},
                          {80, 0},
                          {140, 0},
                          {140, 60},
                          {80, 60},
                          {80, 40},
                          {60, 40},
                          {60, 60},
                          {0, 60}},
                         {}};
  const auto apart = loop_areas(cut(dumbbell, 15.0));
  ASSERT_EQ(apart.size(), 2U);
  EXPECT_NEAR(apart[0], apart[1], 1e-9);
  EXPECT_EQ(loop_areas(cut(dumbbell, 5.0)).size(), 1U);
}

TEST(SkeletonOffset, AroundACourtyardIsAClockwiseLoop) {
  const Polygon block{{{0, 0}, {100, 0}, {100, 100}, {0, 100}},
                      {{{40, 40}, {40, 60}, {60, 60}, {60, 40}}}};
  const auto areas = loop_areas(cut(block, 10.0));
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_NEAR(areas[0], -40.0 * 40.0, 1e-9);
  EXPECT_NEAR(areas[1], 80.0 * 80.0, 1e-9);
}

TEST(SkeletonOffset, BeyondTheRidgeThereIsNone) {
  const Polygon rectangle{{{0, 0}, {100, 0}, {100, 60}, {0, 60}}, {}};
  const LowerPart part = cut(rectangle, 30.5);
  EXPECT_TRUE(part.rim.empty());
  EXPECT_EQ(part.skeleton.arcs.size(), straight_skeleton(rectangle)->arcs.size());
}

TEST(SkeletonOffset, ANarrowPatioIsNotMade) {
  const Polygon rectangle{{{0, 0}, {100, 0}, {100, 60}, {0, 60}}, {}};
  EXPECT_TRUE(cut(rectangle, 28.0, 5.0).rim.empty()) << "it would be 4 m wide";
  EXPECT_EQ(cut(rectangle, 27.0, 5.0).rim.size(), 4U) << "it is 6 m wide";
}

TEST(SkeletonOffset, NodesLieAtTheOffsetAndLoopsAreClosed) {
  Rng rng = testing::property_rng("SkeletonOffset.Closed");
  int edges_seen = 0;
  for (const Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(200))) {
    const double offset_m = rng.uniform(2.0, 25.0);
    const LowerPart part = cut(polygon, offset_m);
    std::map<std::uint32_t, int> balance;
    std::map<std::uint32_t, int> ends;
    for (const OffsetEdge& e : part.rim) {
      ++balance[e.from];
      --balance[e.to];
      ++ends[e.from];
      ++ends[e.to];
      ++edges_seen;
      ASSERT_EQ(part.skeleton.nodes[e.from].time_m, offset_m);
      // No contour edge is nearer than the offset; round a reflex corner the mitre is farther.
      ASSERT_GE(boundary_distance_m(polygon, part.skeleton.nodes[e.from].position),
                offset_m - 1e-6);
    }
    for (const auto& [node, count] : ends) {
      ASSERT_EQ(count, 2);
      ASSERT_EQ(balance[node], 0);
    }
  }
  EXPECT_GT(edges_seen, testing::iterations(200) * 4);
}

}  // namespace
}  // namespace plat::parcels
