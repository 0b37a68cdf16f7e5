#include "parcels/parcel_style.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "parcels/parcel_measures.h"

namespace plat::parcels {
namespace {

Polygon rectangle(double x, double y, double w, double h) {
  return {{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, {}};
}

blocks::Block block_of(double w, double h) {
  return blocks::block_from_contour(BlockId{1}, rectangle(0, 0, w, h));
}

/// Rows of 10 x 10 m lots between two streets; the sides face none.
blocks::Block between_two_streets(double w, double h) {
  blocks::Block block = block_of(w, h);
  for (const std::size_t side : {1U, 3U}) block.edges[0][side] = {};
  return block;
}

std::vector<Polygon> lattice(int columns, int rows) {
  std::vector<Polygon> lots;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) lots.push_back(rectangle(10.0 * c, 10.0 * r, 10, 10));
  }
  return lots;
}

TEST(ParcelStyle, HasMeansAndSampleDeviations) {
  const std::vector<Polygon> lots{rectangle(0, 0, 10, 20), rectangle(10, 0, 20, 30)};
  const blocks::Block block = block_of(30, 30);
  const ParcelStyle style = style_of(block, lots);
  EXPECT_EQ(style.count, 2U);
  EXPECT_DOUBLE_EQ(style.area_mean_m2, 400.0);
  EXPECT_DOUBLE_EQ(style.area_deviation_m2, 200.0 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(style.width_mean_m, 15.0);
  EXPECT_DOUBLE_EQ(style.width_deviation_m, 5.0 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(style.aspect_ratio_mean, 1.75);
  EXPECT_EQ(style_of(block, std::span(lots).first(1)).area_deviation_m2, 0.0);
}

TEST(ParcelStyle, OfNoParcelsIsEmpty) {
  const ParcelStyle style = style_of(block_of(30, 30), {});
  EXPECT_EQ(style.count, 0U);
  EXPECT_EQ(style.area_mean_m2, 0.0);
  EXPECT_EQ(style.rows_mean, 0.0);
}

TEST(ParcelStyle, KnowsWhoReachesTheStreetAndHowMuchOfTheLandDoes) {
  // A patio of 20 x 20 m in a ring of four lots, 10 m deep.
  const std::vector<Polygon> lots{rectangle(0, 0, 40, 10), rectangle(30, 10, 10, 20),
                                  rectangle(0, 30, 40, 10), rectangle(0, 10, 10, 20),
                                  rectangle(10, 10, 20, 20)};
  const ParcelStyle style = style_of(block_of(40, 40), lots);
  EXPECT_DOUBLE_EQ(style.access_share_01, 0.8);
  EXPECT_DOUBLE_EQ(style.access_area_01, 0.75);
  EXPECT_DOUBLE_EQ(style.rows_mean, 1.2);
}

TEST(ParcelRows, CountParcelsFromTheNearestStreet) {
  const std::vector<int> rows = parcel_rows(between_two_streets(30, 50), lattice(3, 5));
  EXPECT_EQ(rows, (std::vector<int>{1, 1, 1, 2, 2, 2, 3, 3, 3, 2, 2, 2, 1, 1, 1}));
  EXPECT_DOUBLE_EQ(style_of(between_two_streets(30, 50), lattice(3, 5)).rows_mean, 1.8);
}

TEST(ParcelRows, DoNotDependOnTheOrderOfTheParcels) {
  std::vector<Polygon> lots = lattice(2, 7);
  const std::vector<int> rows = parcel_rows(between_two_streets(20, 70), lots);
  std::reverse(lots.begin(), lots.end());
  std::vector<int> reversed = parcel_rows(between_two_streets(20, 70), lots);
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_EQ(rows, reversed);
}

TEST(ParcelRows, AreZeroWhereNoStreetIsReached) {
  blocks::Block block = block_of(30, 20);
  block.edges[0].assign(4, {});
  const std::vector<Polygon> lots = lattice(3, 2);
  EXPECT_EQ(parcel_rows(block, lots), std::vector<int>(6, 0));
  EXPECT_EQ(style_of(block, lots).rows_mean, 0.0);
  // An island: nobody's neighbour.
  const std::vector<Polygon> apart{rectangle(0, 0, 30, 5), rectangle(10, 8, 5, 5)};
  EXPECT_EQ(parcel_rows(block_of(30, 20), apart), (std::vector<int>{1, 0}));
}

TEST(BoundsAround, AreTheMeanPlusMinusKDeviations) {
  const Bounds bounds = bounds_around(500.0, 100.0, 2.0, 1.0);
  EXPECT_EQ(bounds.low, 300.0);
  EXPECT_EQ(bounds.high, 700.0);
}

TEST(BoundsAround, KeepTheFloorAndATenthOfTheMean) {
  EXPECT_EQ(bounds_around(100.0, 100.0, 2.0, 1.0).low, 1.0);
  EXPECT_DOUBLE_EQ(bounds_around(100.0, 0.0, 2.0, 1.0).high, 110.0);
  const Bounds degenerate = bounds_around(0.0, 0.0, 2.0, 1.0);
  EXPECT_LE(degenerate.low, degenerate.high);
}

}  // namespace
}  // namespace plat::parcels
