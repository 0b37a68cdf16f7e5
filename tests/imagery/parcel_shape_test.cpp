#include "imagery/parcel_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "blocks/block.h"
#include "parcels/parcel_measures.h"

namespace plat::imagery {
namespace {

Polygon rectangle(double x, double y, double w, double h) {
  return {{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, {}};
}

/// Eight lots of 10 x 30 m in two rows; every edge of the block is a street.
struct Rows {
  blocks::Block block = blocks::block_from_contour(BlockId{1}, rectangle(0, 0, 40, 60));
  std::vector<Polygon> lots;
  Rows() {
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 4; ++column)
        lots.push_back(rectangle(10.0 * column, 30.0 * row, 10, 30));
    }
  }
};

TEST(ParcelShape, StreetFrontsSumToTheFrontage) {
  const Rows rows;
  const auto fronts = parcels::street_fronts(rows.block, rows.lots);
  const auto measures = parcels::measure_parcels(rows.block, rows.lots);
  for (std::size_t i = 0; i < rows.lots.size(); ++i) {
    double sum = 0.0;
    for (const Segment& front : fronts[i]) sum += length(front);
    EXPECT_NEAR(sum, measures[i].frontage_m, 1e-9);
    EXPECT_GT(sum, 0.0);
  }
}

TEST(ParcelShape, ALotInTheRowFrontsAShortSideAndACornerTwo) {
  const Rows rows;
  const auto fronts = parcels::street_fronts(rows.block, rows.lots);
  std::vector<BoxSides> classes;
  for (std::size_t i = 0; i < rows.lots.size(); ++i) {
    const ParcelShape shape = shape_of(rows.lots[i], fronts[i]);
    EXPECT_DOUBLE_EQ(shape.box.length_m, 30.0);
    ASSERT_TRUE(shape.street_sides.has_value());
    classes.push_back(front_class(*shape.street_sides, Mirroring::kAllowed));
  }
  const BoxSides corner = front_class(kBelow | kEnd, Mirroring::kAllowed);
  const BoxSides row = front_class(kEnd, Mirroring::kAllowed);
  EXPECT_EQ(classes, (std::vector<BoxSides>{corner, row, row, corner, corner, row, row, corner}));
}

TEST(ParcelShape, AShortPieceOfStreetIsNoSecondFront) {
  const std::vector<Segment> fronts{{{0, 0}, {30, 0}}, {{30, 0}, {30, 2}}};
  EXPECT_EQ(shape_of(rectangle(0, 0, 30, 10), fronts).street_sides, kBelow);
  const std::vector<Segment> only{{{30, 0}, {30, 2}}};
  EXPECT_EQ(shape_of(rectangle(0, 0, 30, 10), only).street_sides, kEnd);
}

TEST(ParcelShape, UnknownStreetsAreNotNoStreets) {
  EXPECT_FALSE(shape_of(rectangle(0, 0, 30, 10), std::nullopt).street_sides.has_value());
  EXPECT_EQ(shape_of(rectangle(0, 0, 30, 10), std::vector<Segment>{}).street_sides, kNoSide);
}

TEST(ParcelShape, NineClassesOfSidesWithMirrorsAndTenWithout) {
  std::set<BoxSides> allowed;
  std::set<BoxSides> forbidden;
  for (BoxSides sides = 0; sides < 16; ++sides) {
    allowed.insert(front_class(sides, Mirroring::kAllowed));
    forbidden.insert(front_class(sides, Mirroring::kForbidden));
  }
  EXPECT_EQ(allowed.size(), 9U);
  EXPECT_EQ(forbidden.size(), 10U);
}

TEST(ParcelShape, ASymmetryExistsJustWithinAClassAndTurnsBeforeItMirrors) {
  for (const Mirroring mirroring : {Mirroring::kAllowed, Mirroring::kForbidden}) {
    for (BoxSides a = 0; a < 16; ++a) {
      for (BoxSides b = 0; b < 16; ++b) {
        const auto s = symmetry_between(a, b, mirroring);
        EXPECT_EQ(s.has_value(), front_class(a, mirroring) == front_class(b, mirroring));
        if (s) {
          EXPECT_EQ(moved_sides(a, *s), b);
        }
      }
    }
  }
  EXPECT_EQ(symmetry_between(kEnd, kStart, Mirroring::kAllowed), Symmetry::kTurned);
  EXPECT_EQ(symmetry_between(kBelow | kEnd, kBelow | kStart, Mirroring::kAllowed),
            Symmetry::kMirroredAlong);
}

TEST(BoxFrame, LaysTheSidesWhereTheSymmetryPutsThem) {
  const ParcelShape shape = shape_of(rectangle(3, 4, 30, 10), std::nullopt);
  for (const Symmetry s :
       {Symmetry::kKept, Symmetry::kTurned, Symmetry::kMirroredAlong, Symmetry::kMirroredAcross}) {
    const BoxFrame frame(shape.box, s);
    const Point v = perpendicular(shape.box.axis);
    const Point middle_of_end = shape.box.center + 0.5 * shape.box.length_m * shape.box.axis;
    const Point middle_of_above = shape.box.center + 0.5 * shape.box.width_m * v;
    EXPECT_NEAR(frame.to_frame(middle_of_end).x,
                moved_sides(kEnd, s) == kEnd ? frame.length_m() : 0.0, 1e-12);
    EXPECT_NEAR(frame.to_frame(middle_of_above).y,
                moved_sides(kAbove, s) == kAbove ? frame.width_m() : 0.0, 1e-12);
    const Point p{11.5, 7.25};
    EXPECT_NEAR(distance(frame.to_world(frame.to_frame(p)), p), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace plat::imagery
