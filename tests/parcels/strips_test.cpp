#include "parcels/strips.h"

#include <gtest/gtest.h>

#include <cmath>

#include "parcels/contour_simplification.h"
#include "parcels/made_blocks.h"
#include "parcels/slices.h"

namespace plat::parcels {
namespace {

/// A 100 x 40 m block: bottom, right, top, left on streets 0 .. 3 of these widths.
StripLayout layout_of(const blocks::Block& block, const std::vector<double>& widths,
                      CornerScheme scheme) {
  std::vector<blocks::BlockEdge> labels = block.edges[0];
  for (std::size_t i = 0; i < labels.size(); ++i)
    labels[i].street_width_m = widths[i % widths.size()];
  return lay_out_strips(block.contour, labels, 0.0, {.corners = scheme}).value();
}

double trimmed_m(const StripLayout& layout, std::uint32_t edge) {
  const Strip& strip = layout.strips[layout.strip_of_edge[edge]];
  return strip.trimmed_start_m + strip.trimmed_end_m;
}

TEST(Strips, RectangleHasOneStripPerStreet) {
  const auto layout =
      layout_of(testing::rectangle_block(100, 40), {12.0}, CornerScheme::kStreetWidth);
  ASSERT_EQ(layout.strips.size(), 4U);
  EXPECT_EQ(front_length_m(layout, layout.strips[layout.strip_of_edge[0]]), 100.0);
}

TEST(Strips, CornersGoToTheWiderStreet) {
  const auto layout =
      layout_of(testing::rectangle_block(100, 40), {8.0, 20.0}, CornerScheme::kStreetWidth);
  EXPECT_EQ(trimmed_m(layout, 0), 40.0) << "the long sides lose 20 m at each end";
  EXPECT_EQ(trimmed_m(layout, 2), 40.0);
  EXPECT_EQ(trimmed_m(layout, 1), 0.0);
  EXPECT_EQ(trimmed_m(layout, 3), 0.0);
}

TEST(Strips, CornersGoToTheLongerFrontByLength) {
  const auto layout =
      layout_of(testing::rectangle_block(100, 40), {8.0, 20.0}, CornerScheme::kStreetLength);
  EXPECT_EQ(trimmed_m(layout, 0), 0.0);
  EXPECT_EQ(trimmed_m(layout, 1), 40.0) << "all of the short sides' land changes hands";
  EXPECT_EQ(trimmed_m(layout, 3), 40.0);
}

TEST(Strips, EqualWidthsGoToTheLongerFront) {
  const auto layout =
      layout_of(testing::rectangle_block(100, 40), {12.0}, CornerScheme::kStreetWidth);
  EXPECT_EQ(trimmed_m(layout, 0), 0.0);
  EXPECT_EQ(trimmed_m(layout, 1), 40.0);
}

TEST(Strips, ReflexCornerGoesToNobody) {
  const blocks::Block l = blocks::block_from_contour(
      BlockId{}, {{{0, 0}, {90, 0}, {90, 30}, {30, 30}, {30, 80}, {0, 80}}, {}});
  const auto layout = layout_of(l, {10.0, 20.0}, CornerScheme::kStreetWidth);
  const Strip& before = layout.strips[layout.strip_of_edge[2]];
  const Strip& after = layout.strips[layout.strip_of_edge[3]];
  EXPECT_EQ(before.trimmed_end_m, 0.0);
  EXPECT_EQ(after.trimmed_start_m, 0.0);
}

TEST(Strips, AcuteWedgeKeepsItsCentreline) {
  // Streets that meet at about 17 degrees.
  const blocks::Block wedge =
      blocks::block_from_contour(BlockId{}, {{{0, 0}, {100, 0}, {100, 30}}, {}});
  const auto layout = layout_of(wedge, {10.0, 11.0, 20.0}, CornerScheme::kStreetWidth);
  EXPECT_EQ(layout.strips[layout.strip_of_edge[0]].trimmed_start_m, 0.0);
  EXPECT_EQ(layout.strips[layout.strip_of_edge[2]].trimmed_end_m, 0.0);
}

TEST(Strips, FacesWithoutStreetJoinAStripThatHasOne) {
  const auto block = testing::with_streets_on(testing::rectangle_block(100, 40), {0});
  const auto layout = lay_out_strips(block.contour, block.edges[0], 0.0, {}).value();
  ASSERT_EQ(layout.strips.size(), 1U);
  for (const std::uint32_t strip : layout.strip_of_edge) EXPECT_EQ(strip, 0U);
  EXPECT_TRUE(layout.walls.empty());
}

TEST(Strips, BlockWithoutStreetIsAFailure) {
  const auto block = testing::with_streets_on(testing::rectangle_block(100, 40), {});
  const auto layout = lay_out_strips(block.contour, block.edges[0], 0.0, {});
  ASSERT_FALSE(layout);
  EXPECT_EQ(layout.error().code, FailureCode::kNoStreet);
}

TEST(Slices, ArePerpendicularAndAsManyAsTheFrontHoldsLots) {
  const auto layout =
      layout_of(testing::rectangle_block(100, 40), {12.0}, CornerScheme::kStreetLength);
  Rng rng(1);
  const auto cuts = slice_strips(layout, {10.0, 0.0}, rng);
  // Ten lots on each long side: nine cuts; the short sides lost all their land.
  ASSERT_EQ(cuts.size(), 18U);
  for (const Segment& cut : cuts) {
    EXPECT_EQ(cut.a.x, cut.b.x);
    EXPECT_NEAR(length(cut), 20.0, 0.002) << "from the street to the ridge";
    EXPECT_NEAR(cut.a.x, 10.0 * std::round(cut.a.x / 10.0), 0.001) << "evenly spaced";
  }
}

TEST(Slices, SpacingIsScaledToAWholeNumberOfLots) {
  const auto layout =
      layout_of(testing::rectangle_block(100, 40), {12.0}, CornerScheme::kStreetLength);
  for (const auto& [spacing, lots] : {std::pair{14.0, 7}, std::pair{33.0, 3}, std::pair{90.0, 1}}) {
    Rng rng(1);
    EXPECT_EQ(static_cast<int>(slice_strips(layout, {spacing, 0.5}, rng).size()), 2 * (lots - 1));
  }
}

TEST(Slices, FollowTheGuideAwayFromTheStreet) {
  // An outer bend of one street: its two faces share an arc, which slices from either side meet.
  blocks::Block block = testing::rectangle_block(60, 60);
  for (std::uint32_t i = 0; i < 4; ++i) block.edges[0][i].logical_street = i < 2 ? 0U : 1U;
  const auto layout = lay_out_strips(block.contour, block.edges[0], 0.0, {}).value();
  ASSERT_EQ(layout.strips.size(), 2U);
  Rng rng(1);
  int bent = 0;
  for (const Segment& cut : slice_strips(layout, {9.0, 0.0}, rng)) {
    const Point d = cut.b - cut.a;
    bent += d.x != 0.0 && d.y != 0.0 ? 1 : 0;
  }
  EXPECT_GT(bent, 4) << "slices that go on along the bisector";
}

TEST(SimplifyContour, DropsVerticesWithinTheToleranceButNotAStreetsEnd) {
  blocks::Block block = blocks::block_from_contour(
      BlockId{}, {{{0, 0}, {50, -0.1}, {100, 0}, {100, 40}, {0, 40}}, {}});
  EXPECT_EQ(simplify_contour(block, 0.25).polygon.outer.size(), 4U);
  EXPECT_EQ(simplify_contour(block, 0.05).polygon.outer.size(), 5U);
  block.edges[0][1].logical_street = 99;
  const LabelledContour kept = simplify_contour(block, 0.25);
  EXPECT_EQ(kept.polygon.outer.size(), 5U);
  EXPECT_EQ(kept.labels.size(), 5U);
}

TEST(SimplifyContour, NeverMakesTheContourInvalid) {
  // With 20 m of tolerance the notch's bottom would cross the hole.
  const Polygon notched{{{0, 0}, {100, 0}, {100, 40}, {52, 40}, {50, 15}, {48, 40}, {0, 40}},
                        {{{45, 5}, {45, 12}, {55, 12}, {55, 5}}}};
  const blocks::Block block = blocks::block_from_contour(BlockId{}, notched);
  for (const double tolerance : {0.0, 1.0, 20.0, 1000.0}) {
    const LabelledContour out = simplify_contour(block, tolerance);
    std::size_t vertices = out.polygon.outer.size();
    for (const Ring& hole : out.polygon.holes) vertices += hole.size();
    EXPECT_EQ(out.labels.size(), vertices);
    for (const Point p : out.polygon.outer)
      EXPECT_NE(std::find(notched.outer.begin(), notched.outer.end(), p), notched.outer.end());
  }
}

}  // namespace
}  // namespace plat::parcels
