#include "parcels/subdivision_trace.h"

#include <gtest/gtest.h>

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

TEST(SubdivisionTrace, NamesEveryStepOnce) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kTraceSteps; ++i)
    names.push_back(trace_step_name(static_cast<TraceStep>(i)));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace plat::parcels
