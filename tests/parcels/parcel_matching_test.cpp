#include "parcels/parcel_matching.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "parcels/block_subdivider.h"
#include "parcels/overlap.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::parcels {
namespace {

/// A block with its parcels, owned, and labels 0 .. n-1.
struct Divided {
  Ring contour;
  std::vector<std::uint32_t> labels;
  std::vector<Parcel> parcels;

  [[nodiscard]] MatchedBlock labelled() const { return {contour, labels, parcels}; }
  [[nodiscard]] MatchedBlock plain() const { return {contour, {}, parcels}; }
};

Divided divided(const Polygon& contour, std::uint64_t seed) {
  Rng rng(seed);
  Divided out;
  out.contour = contour.outer;
  for (std::uint32_t i = 0; i < out.contour.size(); ++i) out.labels.push_back(i);
  out.parcels =
      *block_subdividers().make("obb").subdivide(blocks::block_from_contour({}, contour), rng);
  return out;
}

std::vector<Divided> many(const std::string& name, int count) {
  Rng rng = testing::property_rng(name);
  std::vector<Divided> out;
  for (const Polygon& polygon : testing::synthetic_blocks(rng, count)) {
    if (polygon.holes.empty()) out.push_back(divided(polygon, 1));
  }
  return out;
}

template <class Map>
Divided mapped(const Divided& block, Map map) {
  Divided out = block;
  for (Point& p : out.contour) p = map(p);
  for (Parcel& parcel : out.parcels) {
    for (Point& p : parcel.shape.outer) p = map(p);
    for (Ring& hole : parcel.shape.holes) {
      for (Point& p : hole) p = map(p);
    }
  }
  return out;
}

/// The share of parcels that match themselves, by relative distances.
double share_of_itself(const MatchedBlock& before, const MatchedBlock& after) {
  const auto matches = match_parcels(ParcelMatching::kRelativeDistances, before, after);
  std::size_t same = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) same += matches[i]->predecessor == i ? 1 : 0;
  return static_cast<double>(same) / static_cast<double>(matches.size());
}

TEST(ParcelMatching, NothingChangedMatchesEveryParcelWithItself) {
  std::size_t parcels = 0;
  for (const Divided& block : many("Matching.Identity", 60)) {
    parcels += block.parcels.size();
    for (const auto matching :
         {ParcelMatching::kRelativeDistances, ParcelMatching::kNearestCentroid,
          ParcelMatching::kLargestOverlap}) {
      for (const auto& [before, after] : {std::pair(block.labelled(), block.labelled()),
                                          std::pair(block.plain(), block.plain())}) {
        const auto matches = match_parcels(matching, before, after);
        ASSERT_EQ(matches.size(), block.parcels.size());
        for (std::size_t i = 0; i < matches.size(); ++i) {
          ASSERT_TRUE(matches[i]) << matching_name(matching);
          EXPECT_EQ(matches[i]->predecessor, i) << matching_name(matching);
        }
      }
    }
  }
  EXPECT_GT(parcels, 500U);
}

TEST(ParcelMatching, RelativeDistancesDoNotSeeASimilarity) {
  Rng rng = testing::property_rng("Matching.Similarity");
  for (const Divided& block : many("Matching.Similarity", 60)) {
    const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
    const double factor = std::exp(rng.uniform(-2.0, 2.0));
    const Point shift{rng.uniform(-5e3, 5e3), rng.uniform(-5e3, 5e3)};
    const Divided moved = mapped(block, [&](Point p) {
      return shift + factor * (std::cos(angle) * p + std::sin(angle) * perpendicular(p));
    });
    EXPECT_EQ(share_of_itself(block.labelled(), moved.labelled()), 1.0);
  }
}

TEST(ParcelMatching, WithoutLabelsAShapeWithoutSymmetryIsFoundInAnyTurn) {
  const Divided block = divided({{{0, 0}, {120, 10}, {150, 70}, {40, 110}, {-10, 60}}, {}}, 1);
  for (const double angle : {0.3, 1.9, 3.1, 4.5}) {
    Divided moved = mapped(block, [&](Point p) {
      return Point{500, 20} + 1.5 * (std::cos(angle) * p + std::sin(angle) * perpendicular(p));
    });
    std::rotate(moved.contour.begin(), moved.contour.begin() + 2, moved.contour.end());
    EXPECT_EQ(share_of_itself(block.plain(), moved.plain()), 1.0) << angle;
  }
}

TEST(ParcelMatching, SmallMovesOfOneCornerKeepEveryMatch) {
  const Divided block = divided({{{0, 0}, {160, 0}, {160, 90}, {0, 90}}, {}}, 1);
  Divided moved = block;
  moved.contour[2] = {161, 91};
  EXPECT_EQ(share_of_itself(block.labelled(), moved.labelled()), 1.0);
}

TEST(ParcelMatching, AStraightJunctionIsIgnored) {
  const Divided block = divided({{{0, 0}, {160, 0}, {160, 90}, {0, 90}}, {}}, 1);
  Divided split = block;
  split.contour.insert(split.contour.begin() + 1, {70, 1.0 / 1024.0});
  split.labels = {0, 0, 1, 2, 3};
  const auto corners = corresponding_corners(block.labelled(), split.labelled());
  ASSERT_EQ(corners.size(), 4U);
  for (const auto& [before, after] : corners) EXPECT_EQ(before, after);
  EXPECT_EQ(corresponding_corners(block.plain(), split.plain()), corners);
}

TEST(ParcelMatching, ACornerThatComesOrGoesLeavesTheOthersPaired) {
  const Divided block = divided({{{0, 0}, {160, 0}, {160, 90}, {0, 90}}, {}}, 1);
  Divided cut = block;  // the corner between streets 1 and 2 is cut by street 9
  cut.contour = {{0, 0}, {160, 0}, {160, 60}, {130, 90}, {0, 90}};
  cut.labels = {0, 1, 9, 2, 3};
  const std::vector<std::pair<Point, Point>> expected{
      {{0, 0}, {0, 0}}, {{160, 0}, {160, 0}}, {{0, 90}, {0, 90}}};
  EXPECT_EQ(corresponding_corners(block.labelled(), cut.labelled()), expected);
}

TEST(ParcelMatching, TheNearestIsThatOfTheFormula) {
  for (const Divided& block : many("Matching.Oracle", 30)) {
    Rng rng(7);
    Divided after = mapped(
        block, [&](Point p) { return p + Point{rng.uniform(-6.0, 6.0), rng.uniform(-6.0, 6.0)}; });
    after.parcels.resize((after.parcels.size() + 1) / 2);
    const auto corners = corresponding_corners(block.labelled(), after.labelled());
    ASSERT_GE(corners.size(), 3U);
    const auto place = [&](const Parcel& parcel, bool is_new) {  // l_{i,k}
      std::vector<double> out;
      double sum = 0.0;
      for (const auto& [b, a] : corners) {
        out.push_back(distance(centroid(parcel.shape), is_new ? a : b));
        sum += out.back();
      }
      for (double& each : out) each /= sum;
      return out;
    };
    const auto matches =
        match_parcels(ParcelMatching::kRelativeDistances, block.labelled(), after.labelled());
    for (std::size_t i = 0; i < matches.size(); ++i) {
      double least = 1e300;
      for (const Parcel& old : block.parcels) {
        double d = 0.0;
        for (std::size_t k = 0; k < corners.size(); ++k)
          d += std::abs(place(after.parcels[i], true)[k] - place(old, false)[k]);
        least = std::min(least, d);
      }
      EXPECT_NEAR(matches[i]->distance, least, 1e-12);
    }
  }
}

TEST(ParcelMatching, OverlapFindsNothingWhereNothingOverlaps) {
  const Divided block = divided({{{0, 0}, {160, 0}, {160, 90}, {0, 90}}, {}}, 1);
  const Divided far = mapped(block, [](Point p) { return p + Point{1000, 0}; });
  for (const auto& match :
       match_parcels(ParcelMatching::kLargestOverlap, block.labelled(), far.labelled()))
    EXPECT_FALSE(match);
}

TEST(ParcelMatching, NamesAreReadBack) {
  for (const auto matching : {ParcelMatching::kRelativeDistances, ParcelMatching::kNearestCentroid,
                              ParcelMatching::kLargestOverlap})
    EXPECT_EQ(matching_named(matching_name(matching)), matching);
  EXPECT_FALSE(matching_named("nearest"));
}

Parcel square(double x, double y, double side) {
  return {ParcelId{}, {{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}}};
}

TEST(Overlap, IsTheCommonArea) {
  const std::vector<Parcel> first{square(0, 0, 10), square(20, 0, 10)};
  const std::vector<Parcel> second{square(5, 5, 10), square(22, 2, 4), square(50, 0, 3)};
  const std::vector<Overlap> expected{{0, 0, 25.0}, {1, 1, 16.0}};
  EXPECT_EQ(find_overlaps(first, second), expected);
}

TEST(Overlap, AHoleIsNoLand) {
  Parcel ring = square(0, 0, 30);
  ring.shape.holes.push_back({{10, 10}, {10, 20}, {20, 20}, {20, 10}});
  const std::vector<Parcel> strip{{ParcelId{}, {{{-5, 5}, {35, 5}, {35, 20}, {-5, 20}}, {}}}};
  EXPECT_EQ(find_overlaps(std::vector{ring}, strip).front().area_m2, 450.0 - 100.0);
  EXPECT_TRUE(find_overlaps(std::vector{ring}, std::vector{square(10, 10, 10)}).empty());
}

TEST(Overlap, OfTwoDivisionsOfABlockSumsToItsArea) {
  Rng rng = testing::property_rng("Overlap.Sum");
  for (const Polygon& polygon : testing::synthetic_blocks(rng, 30)) {
    const auto block = blocks::block_from_contour({}, polygon);
    Rng first(1);
    Rng second(2);
    const auto a = block_subdividers().make("obb").subdivide(block, first);
    const auto b = block_subdividers().make("voronoi").subdivide(block, second);
    double sum = 0.0;
    for (const Overlap& overlap : find_overlaps(*a, *b)) sum += overlap.area_m2;
    EXPECT_NEAR(sum, area_m2(polygon), 0.01 * perimeter_m(polygon));
  }
}

}  // namespace
}  // namespace plat::parcels
