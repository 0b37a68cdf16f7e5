#include "similarity/shape_neighbourhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "similarity/made_tiles.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using testing::cell;
using testing::iterations;
using testing::made_tiles;
using testing::property_rng;

constexpr EdgeLabel kS = EdgeLabel::kStreet;
constexpr EdgeLabel kP = EdgeLabel::kProperty;
constexpr EdgeLabel kU = EdgeLabel::kUnknown;

Expected<LabelledShape> union_of_all(const std::vector<LabelledShape>& shapes) {
  std::vector<const LabelledShape*> pointers;
  for (const LabelledShape& shape : shapes) pointers.push_back(&shape);
  return union_of(pointers);
}

LabelledShape shape_of(Ring ring, std::vector<EdgeLabel> edges = {}, std::string zone = "") {
  return {{std::move(ring), {}}, std::move(edges), std::move(zone)};
}

TEST(ShapeNeighbourhood, HasThoseWithACommonEdge) {
  //  2 3
  //  0 1
  const ShapeNeighbourhood four({cell(0, 0), cell(1, 0), cell(0, 1), cell(1, 1)});
  const auto of = [&](std::uint32_t i) {
    return std::vector<std::uint32_t>(four.neighbours(i).begin(), four.neighbours(i).end());
  };
  EXPECT_EQ(of(0), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(of(3), (std::vector<std::uint32_t>{1, 2}));
  const ShapeNeighbourhood apart({cell(0, 0), cell(2, 0)});
  EXPECT_TRUE(apart.neighbours(0).empty());
}

TEST(UnionOf, CarriesLabelsAlong) {
  //  (0,10)--(10,10)--(20,10)    street below the left, above the right lot
  const auto merged =
      union_of_all({shape_of({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {kS, kP, kP, kU}),
                    shape_of({{10, 0}, {20, 0}, {20, 10}, {10, 10}}, {kP, kU, kS, kP})});
  ASSERT_TRUE(merged);
  EXPECT_EQ(merged->polygon.outer, (Ring{{0, 0}, {10, 0}, {20, 0}, {20, 10}, {10, 10}, {0, 10}}));
  EXPECT_EQ(merged->edges, (std::vector<EdgeLabel>{kS, kP, kU, kS, kP, kU}));
}

TEST(UnionOf, OfShapesOfWhichSomeHaveNoLabels) {
  const auto merged =
      union_of_all({cell(0, 0), shape_of(cell(1, 0).polygon.outer, {kS, kS, kS, kS})});
  ASSERT_TRUE(merged);
  EXPECT_EQ(merged->edges, (std::vector<EdgeLabel>{kU, kS, kS, kS, kU, kU}));
  EXPECT_TRUE(union_of_all({cell(0, 0), cell(1, 0)})->edges.empty());
}

TEST(UnionOf, HasTheZoneOfTheLargestArea) {
  const Ring wide{{10, 0}, {40, 0}, {40, 10}, {10, 10}};
  const auto zone = [&](std::string small, std::string large) {
    return union_of_all({shape_of(cell(0, 0).polygon.outer, {}, std::move(small)),
                         shape_of(wide, {}, std::move(large))})
        ->zone;
  };
  EXPECT_EQ(zone("park", "house"), "house");
  EXPECT_EQ(zone("park", ""), "park");
  EXPECT_EQ(zone("", ""), "");
}

TEST(UnionOf, AroundACourtyardHasAHoleUntilItIsFilled) {
  std::vector<LabelledShape> ring;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      if (x != 1 || y != 1) ring.push_back(cell(x, y));
    }
  }
  const auto open = union_of_all(ring);
  ASSERT_TRUE(open);
  ASSERT_EQ(open->polygon.holes.size(), 1U);
  EXPECT_DOUBLE_EQ(area_m2(open->polygon), 800.0);
  const auto filled = union_of_all({*open, cell(1, 1)});
  ASSERT_TRUE(filled);
  EXPECT_TRUE(filled->polygon.holes.empty());
  EXPECT_DOUBLE_EQ(area_m2(filled->polygon), 900.0);
}

TEST(UnionOf, RefusesWhatIsNotSimple) {
  EXPECT_EQ(union_of_all({cell(0, 0), cell(1, 1)}).error().code, FailureCode::kNotSimple);
  EXPECT_EQ(union_of_all({cell(0, 0), cell(2, 0)}).error().code, FailureCode::kNotSimple);
  EXPECT_EQ(union_of_all({cell(0, 0), cell(0, 0)}).error().code, FailureCode::kTilesOverlap);
  EXPECT_EQ(union_of_all({}).error().code, FailureCode::kNotSimple);
  // A cell, and a lot that begins at its right edge and comes back into it.
  const LabelledShape back =
      shape_of({{10, 0}, {20, 0}, {20, 20}, {5, 20}, {5, 5}, {15, 5}, {10, 10}});
  EXPECT_EQ(union_of_all({cell(0, 0), back}).error().code, FailureCode::kTilesOverlap);
}

TEST(UnionOf, HasTheSumOfAreasAndTheLabelsOfItsOutline) {
  Rng rng = property_rng("union_of_random_tiles");
  int simple = 0;
  int with_hole = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const std::vector<LabelledShape> tiles = made_tiles(rng, 5, 4);
    const ShapeNeighbourhood around(tiles);
    std::set<std::uint32_t> grown{static_cast<std::uint32_t>(rng.index(tiles.size()))};
    const std::size_t wanted = 3 + rng.index(16);
    while (grown.size() < wanted) {
      auto from = grown.begin();
      std::advance(from, static_cast<std::ptrdiff_t>(rng.index(grown.size())));
      const auto others = around.neighbours(*from);
      grown.insert(others[rng.index(others.size())]);
    }
    std::vector<const LabelledShape*> chosen;
    double sum_m2 = 0.0;
    std::map<std::pair<Point, Point>, EdgeLabel> label_of;
    for (const std::uint32_t t : grown) {
      chosen.push_back(&tiles[t]);
      sum_m2 += area_m2(tiles[t].polygon);
      const Ring& ring = tiles[t].polygon.outer;
      for (std::size_t k = 0; k < ring.size(); ++k)
        label_of[{ring[k], ring[(k + 1) % ring.size()]}] = tiles[t].edges[k];
    }
    const auto merged = union_of(chosen);
    if (!merged) {
      EXPECT_EQ(merged.error().code, FailureCode::kNotSimple);
      continue;
    }
    ++simple;
    with_hole += merged->polygon.holes.empty() ? 0 : 1;
    EXPECT_NEAR(area_m2(merged->polygon), sum_m2, 1e-9 * sum_m2);
    const Ring& ring = merged->polygon.outer;
    ASSERT_EQ(merged->edges.size(), ring.size());
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const auto known = label_of.find({ring[k], ring[(k + 1) % ring.size()]});
      ASSERT_TRUE(known != label_of.end());
      EXPECT_EQ(merged->edges[k], known->second);
    }
    std::ranges::reverse(chosen);
    EXPECT_EQ(union_of(chosen)->polygon, merged->polygon);
  }
  EXPECT_GT(simple, 100);
  EXPECT_GE(with_hole, 3);
}

}  // namespace
}  // namespace plat::similarity
