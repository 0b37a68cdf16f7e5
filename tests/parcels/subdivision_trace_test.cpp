#include "parcels/subdivision_trace.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_blocks.h"
#include "parcels/block_subdivider.h"

namespace plat::parcels {
namespace {

std::vector<Polygon> shapes_of(const Expected<std::vector<Parcel>>& parcels) {
  std::vector<Polygon> out;
  if (!parcels) return out;
  for (const Parcel& parcel : *parcels) out.push_back(parcel.shape);
  return out;
}

TEST(SubdivisionTrace, EveryStrategyMakesTheSameParcelsWhenWatched) {
  const blocks::Block block = testing::rectangle_block(120.0, 70.0);
  for (const std::string_view name : block_subdividers().names()) {
    const AnyBlockSubdivider subdivider = block_subdividers().make(name, {});
    Rng alone(7);
    Rng watched(7);
    SubdivisionTrace trace;
    const auto expected = shapes_of(subdivider.subdivide(block, alone));
    EXPECT_FALSE(expected.empty()) << name;
    EXPECT_EQ(shapes_of(subdivider.subdivide(block, watched, trace)), expected) << name;
  }
}

TEST(SubdivisionTrace, ObbShowsOneSplitPerParcelMore) {
  const blocks::Block block = testing::rectangle_block(120.0, 70.0);
  const AnyBlockSubdivider obb = block_subdividers().make("obb", {});
  Rng rng(7);
  SubdivisionTrace trace;
  const auto parcels = obb.subdivide(block, rng, trace);
  ASSERT_TRUE(parcels);
  EXPECT_EQ(trace.lines().size() + 1, parcels->size());
  EXPECT_EQ(trace.areas().size(), trace.lines().size());
  EXPECT_EQ(trace.lines().front().number, 0U);
  for (const SubdivisionTrace::Line& line : trace.lines()) EXPECT_EQ(line.step, TraceStep::kSplit);
}

std::size_t count(const SubdivisionTrace& trace, TraceStep step) {
  const auto is_step = [&](const auto& shown) { return shown.step == step; };
  return static_cast<std::size_t>(
      std::count_if(trace.lines().begin(), trace.lines().end(), is_step) +
      std::count_if(trace.areas().begin(), trace.areas().end(), is_step));
}

SubdivisionTrace skeleton_trace(const blocks::Block& block, const OptionMap& options) {
  Rng rng(7);
  SubdivisionTrace trace;
  EXPECT_TRUE(block_subdividers().make("skeleton", options).subdivide(block, rng, trace));
  return trace;
}

TEST(SubdivisionTrace, SkeletonShowsAFaceForEachEdgeAndTheArcsBetweenThem) {
  const SubdivisionTrace trace = skeleton_trace(testing::rectangle_block(120.0, 70.0), {});
  EXPECT_EQ(count(trace, TraceStep::kSkeletonFace), 4U);
  EXPECT_EQ(count(trace, TraceStep::kSkeletonArc), 5U);
  for (const SubdivisionTrace::Line& shown : trace.lines()) {
    if (shown.step == TraceStep::kSkeletonArc) {
      EXPECT_EQ(shown.number, 1U);  // four streets, four strips
    }
  }
  EXPECT_GT(count(trace, TraceStep::kSlice), 4U);
  EXPECT_EQ(count(trace, TraceStep::kOffset), 0U);
}

TEST(SubdivisionTrace, SkeletonsStripsFillTheBlockAndNoWallEndsAtACorner) {
  const blocks::Block block = testing::rectangle_block(120.0, 70.0);
  const SubdivisionTrace trace = skeleton_trace(block, {});
  double area = 0.0;
  for (const SubdivisionTrace::Area& shown : trace.areas()) {
    if (shown.step == TraceStep::kStrip) area += signed_area_m2(shown.area);
  }
  EXPECT_NEAR(area, 120.0 * 70.0, 0.01);
  std::size_t walls = 0;
  for (const SubdivisionTrace::Line& shown : trace.lines()) {
    if (shown.step != TraceStep::kWall) continue;
    ++walls;
    for (const Point corner : block.contour.outer) {
      EXPECT_GT(distance(shown.line.a, corner), 1.0);
      EXPECT_GT(distance(shown.line.b, corner), 1.0);
    }
  }
  EXPECT_GT(walls, 0U);
}

TEST(SubdivisionTrace, SkeletonShowsTheOffsetContour) {
  const SubdivisionTrace trace =
      skeleton_trace(testing::rectangle_block(120.0, 70.0), {{"offset_m", 20.0}});
  EXPECT_EQ(count(trace, TraceStep::kOffset), 4U);
}

TEST(SubdivisionTrace, NamesEveryStepOnce) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kTraceSteps; ++i)
    names.push_back(trace_step_name(static_cast<TraceStep>(i)));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace plat::parcels
