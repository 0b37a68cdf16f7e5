#include "synthesis/block_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthesis/grid_grower.h"

namespace plat::synthesis {
namespace {

blocks::Block rectangle(double length_m, double depth_m) {
  return blocks::block_from_contour(
      {0}, {{{0, 0}, {length_m, 0}, {length_m, depth_m}, {0, depth_m}}, {}});
}

/// A square of streets 0..3 and, away from it, street 4.
streets::StreetNetwork square() {
  streets::StreetNetwork network;
  network.nodes = {{0, 0}, {0, 100}, {100, 0}, {100, 100}, {300, 0}, {400, 0}};
  const std::pair<std::uint32_t, std::uint32_t> ends[] = {{0, 1}, {0, 2}, {1, 3}, {2, 3}, {4, 5}};
  for (const auto& [from, to] : ends) {
    streets::Street street;
    street.id = {static_cast<std::uint32_t>(network.streets.size())};
    street.from = from;
    street.to = to;
    street.line = {network.nodes[from], network.nodes[to]};
    street.width_m = 10.0;
    network.streets.push_back(street);
  }
  return network;
}

blocks::Block block_of_square() {
  blocks::Block block = blocks::block_from_contour({0}, {{{5, 5}, {95, 5}, {95, 95}, {5, 95}}, {}});
  const std::uint32_t streets[] = {1, 3, 2, 0};
  for (std::size_t i = 0; i < 4; ++i) block.edges[0][i].street = StreetId{streets[i]};
  return block;
}

streets::IntersectionPoint point(Point place, std::optional<double> area_m2) {
  streets::IntersectionPoint out;
  out.place = place;
  out.parcel_area_m2 = area_m2;
  return out;
}

TEST(PointAreas, AreThoseAtTheNodesOfTheStreetsThatABlockFaces) {
  const streets::StreetNetwork network = square();
  const std::vector<streets::IntersectionPoint> points{
      point({0, 0}, 300.0), point({100, 100}, 500.0), point({300, 0}, 9000.0),
      point({50, 50}, 7000.0), point({0, 100}, std::nullopt)};
  const PointAreas areas(network, points, {});
  const auto around = areas.around(block_of_square());
  ASSERT_TRUE(around);
  EXPECT_DOUBLE_EQ(around->mean_m2, 400.0);
  EXPECT_DOUBLE_EQ(around->deviation_m2, std::sqrt(2.0) * 100.0);
  EXPECT_NEAR(areas.everywhere()->mean_m2, 9800.0 / 3.0, 1e-9);
}

TEST(PointAreas, APlaceCountsOnceWithTheMeanOfItsPoints) {
  const streets::StreetNetwork network = square();
  const std::vector<streets::IntersectionPoint> points{
      point({0, 0}, 100.0), point({0, 0}, 200.0), point({0, 0}, 300.0), point({100, 0}, 600.0)};
  const auto around = PointAreas(network, points, {}).around(block_of_square());
  EXPECT_DOUBLE_EQ(around->mean_m2, 400.0);
}

TEST(PointAreas, PointsOfTheExistingCityCount) {
  const streets::StreetNetwork network = square();
  const std::vector<streets::IntersectionPoint> grown{point({0, 0}, 100.0)};
  const std::vector<streets::IntersectionPoint> existing{point({100, 0}, 300.0)};
  EXPECT_DOUBLE_EQ(PointAreas(network, grown, existing).around(block_of_square())->mean_m2, 200.0);
}

TEST(PointAreas, NothingIsSaidWhereNoParcelsAreKnown) {
  const streets::StreetNetwork network = square();
  const std::vector<streets::IntersectionPoint> points{point({0, 0}, std::nullopt),
                                                       point({100, 0}, 0.0)};
  const PointAreas areas(network, points, {});
  EXPECT_FALSE(areas.around(block_of_square()));
  EXPECT_FALSE(areas.everywhere());
}

TEST(StyleFor, CountsParcelsByArea) {
  EXPECT_EQ(style_for(rectangle(150, 60), {450.0, 90.0}).count, 20U);
  EXPECT_EQ(style_for(rectangle(150, 60), {1e6, 0.0}).count, 1U);
}

TEST(StyleFor, LotsAreAsDeepAsTheRowsMakeThem) {
  // Two rows of 30 m deep lots.
  const parcels::ParcelStyle two = style_for(rectangle(150, 60), {450.0, 90.0});
  EXPECT_DOUBLE_EQ(two.width_mean_m, 15.0);
  EXPECT_DOUBLE_EQ(two.aspect_ratio_mean, 2.0);
  EXPECT_DOUBLE_EQ(two.width_deviation_m, 3.0);
  // Too shallow for two: one row, 20 m deep.
  const parcels::ParcelStyle one = style_for(rectangle(150, 20), {300.0, 0.0});
  EXPECT_DOUBLE_EQ(one.width_mean_m, 15.0);
  EXPECT_NEAR(one.aspect_ratio_mean, 4.0 / 3.0, 1e-12);
}

TEST(StyleFor, TheNumberOfRowsMakesTheSquarerLot) {
  for (double depth_m = 12.0; depth_m < 120.0; depth_m *= 1.07) {
    const parcels::ParcelStyle style = style_for(rectangle(200, depth_m), {500.0, 0.0});
    const auto aspect = [&](double rows) {
      const double lot_depth_m = depth_m / rows;
      return std::exp(std::abs(std::log(lot_depth_m * lot_depth_m / 500.0)));
    };
    EXPECT_NEAR(style.aspect_ratio_mean, std::min(aspect(1.0), aspect(2.0)), 1e-9) << depth_m;
  }
}

TEST(StyleFor, EveryParcelHasStreetAccess) {
  const parcels::ParcelStyle style = style_for(rectangle(150, 60), {450.0, 90.0});
  EXPECT_DOUBLE_EQ(style.access_share_01, 1.0);
  EXPECT_DOUBLE_EQ(style.access_area_01, 1.0);
  EXPECT_DOUBLE_EQ(style.rows_mean, 1.0);
}

}  // namespace
}  // namespace plat::synthesis
