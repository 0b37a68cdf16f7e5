#include "parcels/fronts.h"

#include <gtest/gtest.h>

#include <numbers>

#include "parcels/made_blocks.h"
#include "parcels/random_divisions.h"

namespace plat::parcels {
namespace {

using testing::rectangle_block;
using testing::with_streets_on;

TEST(Fronts, EndAtCorners) {
  const auto fronts = fronts_of(rectangle_block(100, 40));
  ASSERT_EQ(fronts.size(), 4U);
  EXPECT_EQ(length_m(fronts[0]), 100.0);
  EXPECT_EQ(length_m(fronts[1]), 40.0);
}

TEST(Fronts, GoOnThroughBends) {
  const blocks::Block block =
      blocks::block_from_contour(BlockId{}, {{{0, 0}, {50, -5}, {100, 0}, {100, 40}, {0, 40}}, {}});
  const auto fronts = fronts_of(block);
  ASSERT_EQ(fronts.size(), 4U);
  EXPECT_EQ(fronts[0].line, (Polyline{{0, 0}, {50, -5}, {100, 0}}));
}

TEST(Fronts, AreOneAcrossTheStartOfTheRing) {
  const blocks::Block block =
      blocks::block_from_contour(BlockId{}, {{{50, -5}, {100, 0}, {100, 40}, {0, 40}, {0, 0}}, {}});
  const auto fronts = fronts_of(block);
  ASSERT_EQ(fronts.size(), 4U);
  EXPECT_EQ(
      fronts[0].line.size() + fronts[1].line.size() + fronts[2].line.size() + fronts[3].line.size(),
      9U);
}

TEST(Fronts, AreStreetEdgesOnly) {
  const auto fronts = fronts_of(with_streets_on(rectangle_block(100, 40), {1}));
  ASSERT_EQ(fronts.size(), 1U);
  EXPECT_EQ(fronts[0].line, (Polyline{{100, 0}, {100, 40}}));
}

TEST(Fronts, WithoutAnyStreetEveryOuterEdgeIsAssumedToBeOne) {
  EXPECT_EQ(fronts_of(with_streets_on(rectangle_block(100, 40), {})).size(), 4U);
}

TEST(Fronts, OfARingWithoutACornerIsClosed) {
  Ring circle;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 40.0;
    circle.push_back({50.0 * std::cos(angle), 50.0 * std::sin(angle)});
  }
  const auto fronts = fronts_of(blocks::block_from_contour(BlockId{}, {circle, {}}));
  ASSERT_EQ(fronts.size(), 1U);
  EXPECT_TRUE(fronts[0].is_closed);
  EXPECT_NEAR(length_m(fronts[0]), 2.0 * std::numbers::pi * 50.0, 1.0);
}

TEST(Fronts, APlaceLiesOnTheFrontAndLooksIntoTheBlock) {
  const auto fronts = fronts_of(rectangle_block(100, 40));
  const FrontPlace place = place_at(fronts[2], 30.0);  // the top runs from (100, 40) to (0, 40)
  EXPECT_EQ(place.point, (Point{70, 40}));
  EXPECT_EQ(place.inward, (Point{0, -1}));
  EXPECT_EQ(place_at(fronts[2], 1000.0).point, (Point{0, 40}));
}

TEST(RandomDivisions, FillTheLengthInOrder) {
  Rng rng(3);
  for (const double deviation : {0.0, 0.3, 5.0}) {
    const auto ends = random_divisions(120.0, 10, deviation, rng);
    ASSERT_EQ(ends.size(), 11U);
    EXPECT_EQ(ends.front(), 0.0);
    EXPECT_NEAR(ends.back(), 120.0, 1e-9);
    for (std::size_t i = 1; i < ends.size(); ++i) {
      // A quarter against nine of four times the mean.
      EXPECT_GE(ends[i] - ends[i - 1], 120.0 * 0.25 / 36.25);
      if (deviation == 0.0) {
        EXPECT_NEAR(ends[i] - ends[i - 1], 12.0, 1e-9);
      }
    }
  }
}

TEST(RandomDivisions, SpreadAsAskedFor) {
  Rng rng(3);
  const auto ends = random_divisions(10000.0, 1000, 0.2, rng);
  double squares = 0.0;
  for (std::size_t i = 1; i < ends.size(); ++i)
    squares += (ends[i] - ends[i - 1] - 10.0) * (ends[i] - ends[i - 1] - 10.0);
  EXPECT_NEAR(std::sqrt(squares / 1000.0), 2.0, 0.2);
}

}  // namespace
}  // namespace plat::parcels
