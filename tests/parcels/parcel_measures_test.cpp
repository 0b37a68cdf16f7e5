#include "parcels/parcel_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <set>

#include "core/failure.h"
#include "support/property.h"

namespace plat::parcels {
namespace {

Polygon rectangle(double x, double y, double w, double h) {
  return {{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, {}};
}

blocks::Block rectangular_block(double w, double h) {
  return blocks::block_from_contour(BlockId{1}, rectangle(0, 0, w, h));
}

/// Two rows of `columns` lots, w x h metres each, shrunk by `gap_m` on every side.
std::vector<Polygon> two_rows(int columns, double w, double h, double gap_m) {
  std::vector<Polygon> lots;
  for (int row = 0; row < 2; ++row) {
    for (int c = 0; c < columns; ++c)
      lots.push_back(rectangle(c * w + gap_m, row * h + gap_m, w - 2 * gap_m, h - 2 * gap_m));
  }
  return lots;
}

Polygon moved(Polygon p, double turn, Point shift) {
  const Point u{std::cos(turn), std::sin(turn)};
  const auto place = [&](Ring& ring) {
    for (Point& q : ring) q = shift + q.x * u + q.y * perpendicular(u);
  };
  place(p.outer);
  for (Ring& hole : p.holes) place(hole);
  return p;
}

void expect_near(const ParcelMeasures& a, const ParcelMeasures& b) {
  for (const MeasureColumn& column : measure_columns())
    EXPECT_NEAR(column.value(a), column.value(b), 1e-6 * (1.0 + column.value(a))) << column.name;
}

TEST(ParcelMeasures, OfASquare) {
  const Polygon square = rectangle(0, 0, 10, 10);
  const ParcelMeasures m = measure_parcels(rectangular_block(10, 10), std::span(&square, 1))[0];
  EXPECT_DOUBLE_EQ(m.area_m2, 100.0);
  EXPECT_DOUBLE_EQ(m.perimeter_m, 40.0);
  EXPECT_DOUBLE_EQ(m.width_m, 10.0);
  EXPECT_DOUBLE_EQ(m.aspect_ratio, 1.0);
  EXPECT_EQ(m.neighbours, 0);
  EXPECT_DOUBLE_EQ(m.frontage_m, 40.0);
  EXPECT_TRUE(m.has_street_access);
  EXPECT_NEAR(m.compactness, std::numbers::pi / 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(m.rectangularity, 1.0);
  EXPECT_EQ(m.corners, 4);
}

TEST(ParcelMeasures, OfAnLWithACollinearVertex) {
  const Polygon shape{{{0, 0}, {10, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}, {}};
  const ParcelMeasures m = measure_parcels(rectangular_block(20, 20), std::span(&shape, 1))[0];
  EXPECT_DOUBLE_EQ(m.area_m2, 300.0);
  EXPECT_EQ(m.corners, 6);
  EXPECT_NEAR(m.frontage_m, 60.0, 1e-9);
  // The box of least area is the square, not the one along the diagonal of the hull.
  EXPECT_NEAR(m.rectangularity, 0.75, 1e-12);
}

TEST(ParcelMeasures, OfAParcelAroundACourtyard) {
  Polygon ring = rectangle(0, 0, 30, 30);
  ring.holes.push_back({{10, 10}, {10, 20}, {20, 20}, {20, 10}});
  const std::vector<Polygon> parcels{ring, rectangle(10, 10, 10, 10)};
  const auto m = measure_parcels(rectangular_block(30, 30), parcels);
  EXPECT_DOUBLE_EQ(m[0].area_m2, 800.0);
  EXPECT_DOUBLE_EQ(m[0].perimeter_m, 160.0);
  EXPECT_EQ(m[0].neighbours, 1);
  EXPECT_EQ(m[1].neighbours, 1);
  EXPECT_DOUBLE_EQ(m[1].frontage_m, 0.0);
  EXPECT_FALSE(m[1].has_street_access);
}

TEST(ParcelMeasures, OfTwoRowsHaveKnownNeighbours) {
  for (const double gap_m : {0.0, 0.1}) {
    const auto m = measure_parcels(rectangular_block(50, 40), two_rows(5, 10, 20, gap_m));
    for (std::size_t i = 0; i < m.size(); ++i) {
      const bool is_end = i % 5 == 0 || i % 5 == 4;
      EXPECT_EQ(m[i].neighbours, is_end ? 2 : 3) << i << " gap " << gap_m;
      EXPECT_NEAR(m[i].frontage_m, is_end ? 30.0 : 10.0, 8 * gap_m) << i;
      EXPECT_TRUE(m[i].has_street_access);
    }
  }
}

TEST(ParcelMeasures, DoNotReachAcrossAPath) {
  const auto m = measure_parcels(rectangular_block(50, 40), two_rows(5, 10, 20, 0.4));
  for (const ParcelMeasures& p : m) EXPECT_EQ(p.neighbours, 0);
}

TEST(ParcelMeasures, CountNeighboursThatMeetInTJunctions) {
  // One lot across, three behind it, whose edges are parts of its long edge.
  const std::vector<Polygon> parcels{rectangle(0, 0, 30, 10), rectangle(0, 10, 10, 10),
                                     rectangle(10, 10, 10, 10), rectangle(20, 10, 10, 10)};
  const auto m = measure_parcels(rectangular_block(30, 20), parcels);
  EXPECT_EQ(m[0].neighbours, 3);
  EXPECT_EQ(m[1].neighbours, 2);
  EXPECT_EQ(m[2].neighbours, 3);
}

TEST(ParcelMeasures, FrontOnlyEdgesThatFaceAStreet) {
  blocks::Block block = rectangular_block(50, 40);
  block.edges[0][0] = {};  // the southern side faces no street
  const auto m = measure_parcels(block, two_rows(5, 10, 20, 0.0));
  EXPECT_DOUBLE_EQ(m[0].frontage_m, 20.0);
  EXPECT_DOUBLE_EQ(m[2].frontage_m, 0.0);
  EXPECT_FALSE(m[2].has_street_access);
  EXPECT_DOUBLE_EQ(m[7].frontage_m, 10.0);
}

TEST(ParcelMeasures, CountFrontageOnceWhereTheContourHasMoreVertices) {
  blocks::Block block = blocks::block_from_contour(
      BlockId{1}, Polygon{{{0, 0}, {3, -0.05}, {7, 0.05}, {10, 0}, {10, 10}, {0, 10}}, {}});
  const Polygon square = rectangle(0, 0, 10, 10);
  const ParcelMeasures m = measure_parcels(block, std::span(&square, 1))[0];
  EXPECT_NEAR(m.frontage_m, 40.0, 1e-9);
}

TEST(ParcelMeasures, DoNotDependOnOrderPositionOrRotation) {
  Rng rng = testing::property_rng("ParcelMeasures.DoNotDependOnOrder");
  const blocks::Block block = rectangular_block(80, 40);
  std::vector<Polygon> lots = two_rows(8, 10, 20, 0.05);
  const auto plain = measure_parcels(block, lots);
  for (int i = 0; i < testing::iterations(30); ++i) {
    const double turn = rng.uniform(0, 2 * std::numbers::pi);
    const Point shift{rng.uniform(-3000, 3000), rng.uniform(-3000, 3000)};
    const blocks::Block there =
        blocks::block_from_contour(BlockId{1}, moved(block.contour, turn, shift));
    std::vector<Polygon> reversed;
    for (const Polygon& lot : lots) reversed.insert(reversed.begin(), moved(lot, turn, shift));
    auto m = measure_parcels(there, reversed);
    std::reverse(m.begin(), m.end());
    for (std::size_t k = 0; k < m.size(); ++k) expect_near(plain[k], m[k]);
  }
}

TEST(ParcelMeasures, RefuseAParcelWithoutArea) {
  const Polygon flat{{{0, 0}, {5, 0}, {10, 0}}, {}};
  EXPECT_THROW(measure_parcels(rectangular_block(10, 10), std::span(&flat, 1)), LogicError);
}

TEST(ParcelMeasures, TakeMillisecondsForALargeBlock) {
  const auto start = std::chrono::steady_clock::now();
  const auto m = measure_parcels(rectangular_block(10.0 * 1000, 40), two_rows(1000, 10, 20, 0.0));
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(spent.count()));
  EXPECT_EQ(m.size(), 2000U);
  EXPECT_LT(spent.count(), 2.0);
}

TEST(MeasureColumns, HaveUniqueNamesAndAValueEach) {
  ParcelMeasures m;
  m.neighbours = 3;
  m.has_street_access = true;
  std::set<std::string_view> names;
  for (const MeasureColumn& column : measure_columns()) {
    names.insert(column.name);
    EXPECT_FALSE(column.title.empty());
    EXPECT_FALSE(column.momepy.empty());
    if (column.name == "neighbours") {
      EXPECT_EQ(column.value(m), 3.0);
    }
    if (column.name == "has_street_access") {
      EXPECT_EQ(column.value(m), 1.0);
    }
  }
  EXPECT_EQ(names.size(), measure_columns().size());
}

}  // namespace
}  // namespace plat::parcels
