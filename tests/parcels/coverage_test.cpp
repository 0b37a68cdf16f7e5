// find_coverage_defect against coverages that were broken on purpose, and against its exact oracle.
#include "parcels/coverage.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/working_grid.h"
#include "parcels/block_subdivider.h"
#include "parcels/exact_coverage.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

/// Four squares of 10 m in a square of 20 m.
std::vector<Parcel> four_squares() {
  std::vector<Parcel> out;
  for (const Point low : {Point{0, 0}, Point{10, 0}, Point{10, 10}, Point{0, 10}}) {
    out.push_back({ParcelId{static_cast<std::uint32_t>(out.size())},
                   {{low, low + Point{10, 0}, low + Point{10, 10}, low + Point{0, 10}}, {}}});
  }
  return out;
}

/// The contour of four_squares() is found to be covered without the middles of its sides.
const Polygon kSquare{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {}};

bool is_coverage(const std::vector<Parcel>& parcels, const Polygon& contour = kSquare) {
  const bool plain = !find_coverage_defect(contour, parcels, kContourTolerance_m);
  const bool exact = !testing::find_exact_coverage_defect(contour, parcels, kContourTolerance_m);
  EXPECT_EQ(plain, exact) << "the oracle must agree";
  return plain;
}

TEST(FindCoverageDefect, AcceptsAValidCoverage) { EXPECT_TRUE(is_coverage(four_squares())); }

TEST(FindCoverageDefect, AcceptsAnOutlineOneGridStepOffTheContour) {
  auto parcels = four_squares();
  parcels[0].shape.outer[1].y += kGridStep_m;
  parcels[1].shape.outer[0].y += kGridStep_m;
  EXPECT_TRUE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsAMissingParcel) {
  auto parcels = four_squares();
  parcels.pop_back();
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsAGapOfOneGridStep) {
  auto parcels = four_squares();
  parcels[0].shape.outer[2] = parcels[0].shape.outer[2] - Point{kGridStep_m, kGridStep_m};
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsAnOverlapOfOneGridStep) {
  auto parcels = four_squares();
  parcels[0].shape.outer[2] = parcels[0].shape.outer[2] + Point{kGridStep_m, kGridStep_m};
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsTheSameParcelTwice) {
  auto parcels = four_squares();
  parcels.push_back(parcels[2]);
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsAVertexOnOneSideOnly) {
  auto parcels = four_squares();
  parcels[0].shape.outer.insert(parcels[0].shape.outer.begin() + 2, Point{10, 5});
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsAParcelOutside) {
  auto parcels = four_squares();
  parcels.push_back({ParcelId{4}, {{{30, 0}, {40, 0}, {40, 10}}, {}}});
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsAParcelThatLeavesTheBlock) {
  auto parcels = four_squares();
  parcels[0].shape.outer[0] = {-1, 0};
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsAShiftedOutline) {
  const Point shift{4 * kGridStep_m, 0};
  auto parcels = four_squares();
  for (Parcel& parcel : parcels) {
    for (Point& p : parcel.shape.outer) p = p + shift;
  }
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsAnOutlineFurtherOffThanTheTolerance) {
  auto parcels = four_squares();
  parcels[0].shape.outer[1].y += 3 * kGridStep_m;
  parcels[1].shape.outer[0].y += 3 * kGridStep_m;
  EXPECT_FALSE(is_coverage(parcels));
}

TEST(FindCoverageDefect, ReportsACourtyardThatWasFilled) {
  Polygon contour = kSquare;
  contour.holes.push_back({{8, 8}, {8, 12}, {12, 12}, {12, 8}});
  EXPECT_FALSE(is_coverage(four_squares(), contour));
}

TEST(FindCoverageDefect, ReportsACourtyardThatIsMissingInTheBlock) {
  const Polygon ring{kSquare.outer, {{{8, 8}, {8, 12}, {12, 12}, {12, 8}}}};
  EXPECT_TRUE(is_coverage({{ParcelId{0}, ring}}, ring));
  EXPECT_FALSE(is_coverage({{ParcelId{0}, ring}}, kSquare));
}

TEST(FindCoverageDefect, ReportsAnInvalidParcelWithItsNumber) {
  auto parcels = four_squares();
  std::swap(parcels[2].shape.outer[1], parcels[2].shape.outer[2]);
  const auto defect = find_coverage_defect(kSquare, parcels, kContourTolerance_m);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->code, FailureCode::kNotSimple);
  EXPECT_NE(defect->message.find("parcel 2"), std::string::npos) << defect->message;
}

TEST(FindCoverageDefect, ReportsNothingAtAll) {
  EXPECT_TRUE(find_coverage_defect(kSquare, {}, kContourTolerance_m));
}

/// One way of breaking a coverage; false where the parcels drawn do not allow it.
using Break = std::function<bool(std::vector<Parcel>&, Rng&)>;

TEST(FindCoverageDefect, ReportsEveryRandomBreakageOfRealSubdivisions) {
  const auto any = [](std::vector<Parcel>& parcels, Rng& rng) -> Ring& {
    return parcels[rng.index(parcels.size())].shape.outer;
  };
  const Break breaks[] = {
      [](std::vector<Parcel>& parcels, Rng& rng) {  // a gap
        parcels.erase(parcels.begin() + static_cast<std::ptrdiff_t>(rng.index(parcels.size())));
        return true;
      },
      [](std::vector<Parcel>& parcels, Rng& rng) {  // twice
        parcels.push_back(parcels[rng.index(parcels.size())]);
        return true;
      },
      [&](std::vector<Parcel>& parcels, Rng& rng) {  // a corner moved on one side only
        Ring& ring = any(parcels, rng);
        Point& p = ring[rng.index(ring.size())];
        p = p + Point{4 * kGridStep_m, 3 * kGridStep_m};
        return true;
      },
      [&](std::vector<Parcel>& parcels, Rng& rng) {  // a corner left out on one side
        Ring& ring = any(parcels, rng);
        const std::size_t i = rng.index(ring.size());
        const Segment chord{ring[(i + ring.size() - 1) % ring.size()], ring[(i + 1) % ring.size()]};
        // A vertex of the outline that hardly bends it may go.
        if (ring.size() < 4 || distance(chord, ring[i]) < 2.0 * kContourTolerance_m) return false;
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
        return true;
      }};
  Rng rng = testing::property_rng("FindCoverageDefect.Broken");
  const AnyBlockSubdivider subdivider = block_subdividers().make("obb");
  int broken = 0;
  for (Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(60))) {
    const blocks::Block block = blocks::block_from_contour(BlockId{}, std::move(polygon));
    const auto parcels = subdivider.subdivide(block, rng);
    ASSERT_TRUE(parcels);
    if (parcels->size() < 3) continue;
    for (const Break& breaks_it : breaks) {
      std::vector<Parcel> copy = *parcels;
      if (!breaks_it(copy, rng)) continue;
      ++broken;
      EXPECT_TRUE(find_coverage_defect(block.contour, copy, kContourTolerance_m));
    }
  }
  EXPECT_GT(broken, testing::iterations(60) * 2);
}

}  // namespace
}  // namespace plat::parcels
