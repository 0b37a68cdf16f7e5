#include "tiles/layout_construction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/working_grid.h"
#include "parcels/block_subdivider.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"
#include "tiles/layout_defects.h"
#include "tiles/settling.h"
#include "tiles/tile_graph.h"

namespace plat::tiles {
namespace {

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

TilePiece piece(std::string id, Polygon shape, std::uint32_t block = 0) {
  return {std::move(id), "", block, std::move(shape)};
}

/// Directed edges of a tile, by vertices.
std::set<std::pair<std::uint32_t, std::uint32_t>> edges_of(const Tile& tile) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& ring : tile.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges.emplace(ring[i].vertex, ring[(i + 1) % ring.size()].vertex);
  }
  return edges;
}

std::size_t shared_edges(const Tile& a, const Tile& b) {
  std::size_t count = 0;
  const auto of_b = edges_of(b);
  for (const auto& [from, to] : edges_of(a)) count += of_b.contains({to, from}) ? 1 : 0;
  return count;
}

std::size_t joint_count(const TileLayout& layout, const Tile& a, const Tile& b) {
  std::set<std::uint32_t> of_a;
  std::size_t count = 0;
  for (const auto& ring : a.rings) {
    for (const Corner& corner : ring) of_a.insert(corner.vertex);
  }
  for (const auto& ring : b.rings) {
    for (const Corner& corner : ring)
      count += of_a.contains(corner.vertex) && layout.vertices[corner.vertex].is_joint ? 1 : 0;
  }
  return count;
}

TEST(LayoutConstruction, PiecesThatMatchStandExactlyAsObserved) {
  const std::vector<TilePiece> pieces{piece("a", rectangle(0, 0, 20, 30)),
                                      piece("b", rectangle(20, 0, 45, 30))};
  const LayoutConstruction made = construct_layout(pieces);
  ASSERT_TRUE(made.failures.empty());
  ASSERT_EQ(made.layout.tiles.size(), 2U);
  for (std::size_t t = 0; t < 2; ++t)
    EXPECT_EQ(shape_of(made.layout, made.layout.tiles[t]), pieces[t].shape);
  EXPECT_EQ(shared_edges(made.layout.tiles[0], made.layout.tiles[1]), 1U);
  EXPECT_EQ(find_layout_defect(made.layout), std::nullopt);
}

TEST(LayoutConstruction, NearVerticesBecomeOneHalfWay) {
  const LayoutConstruction made = construct_layout(std::vector{
      piece("a", rectangle(0, 0, 20, 30)), piece("b", rectangle(20.5, 0.25, 45, 30.25))});
  ASSERT_EQ(made.layout.tiles.size(), 2U);
  EXPECT_EQ(made.layout.vertices.size(), 6U);
  EXPECT_EQ(shared_edges(made.layout.tiles[0], made.layout.tiles[1]), 1U);
  EXPECT_EQ(shape_of(made.layout, made.layout.tiles[0]).outer,
            (Ring{{0.25, 0.125}, {20.25, 0.125}, {20.25, 30.125}, {0.25, 30.125}}));
  EXPECT_EQ(rest_shape_of(made.layout.tiles[1]), rectangle(20.5, 0.25, 45, 30.25));
}

TEST(LayoutConstruction, AVertexNearAnEdgeIsPutIntoIt) {
  // a is the long side of b and c, whose common corner stands 0.25 m off it.
  const LayoutConstruction made =
      construct_layout(std::vector{piece("a", rectangle(0, 0, 40, 20)),
                                   piece("b", {{{0, 20}, {18, 20.25}, {18, 40}, {0, 40}}, {}}),
                                   piece("c", {{{18, 20.25}, {40, 20}, {40, 40}, {18, 40}}, {}})});
  ASSERT_TRUE(made.failures.empty());
  const auto& tiles = made.layout.tiles;
  EXPECT_EQ(tiles[0].rings[0].size(), 5U);
  EXPECT_EQ(shared_edges(tiles[0], tiles[1]), 1U);
  EXPECT_EQ(shared_edges(tiles[0], tiles[2]), 1U);
  EXPECT_EQ(shared_edges(tiles[1], tiles[2]), 1U);
  EXPECT_EQ(rest_shape_of(tiles[0]).outer, (Ring{{0, 0}, {40, 0}, {40, 20}, {18, 20}, {0, 20}}));
}

TEST(LayoutConstruction, SeveralVerticesAreInAnEdgeInTheOrderOfItsWay) {
  const LayoutConstruction made = construct_layout(
      std::vector{piece("a", rectangle(0, 0, 40, 20)), piece("b", rectangle(0, 20, 12, 40)),
                  piece("c", rectangle(12, 20, 24, 40)), piece("d", rectangle(24, 20, 40, 40))});
  ASSERT_TRUE(made.failures.empty());
  EXPECT_EQ(shape_of(made.layout, made.layout.tiles[0]).outer,
            (Ring{{0, 0}, {40, 0}, {40, 20}, {24, 20}, {12, 20}, {0, 20}}));
}

TEST(LayoutConstruction, VerticesAreNotChainedBeyondTheTolerance) {
  // Corners in a row, half a metre apart: a and b become one, c is a metre from a.
  const LayoutConstruction made = construct_layout(
      std::vector{piece("a", rectangle(0, 0, 20, 20)), piece("b", rectangle(20.5, 20, 40, 40)),
                  piece("c", {{{21, 0}, {40, 0}, {40, 19.5}, {21, 20}}, {}})});
  ASSERT_TRUE(made.failures.empty());
  EXPECT_EQ(made.layout.vertices.size(), 10U);
}

TEST(LayoutConstruction, PiecesOfDifferentBlocksShareNothing) {
  const LayoutConstruction made = construct_layout(
      std::vector{piece("a", rectangle(0, 0, 20, 30), 0), piece("b", rectangle(20, 0, 45, 30), 1)});
  EXPECT_EQ(made.layout.vertices.size(), 8U);
}

TEST(LayoutConstruction, APieceInAHoleSharesItsRing) {
  Polygon around = rectangle(0, 0, 60, 60);
  around.holes.push_back({{20, 20}, {20, 40}, {40, 40}, {40, 20}});
  const LayoutConstruction made =
      construct_layout(std::vector{piece("a", around), piece("b", rectangle(20, 20, 40, 40))});
  ASSERT_TRUE(made.failures.empty());
  EXPECT_EQ(shared_edges(made.layout.tiles[0], made.layout.tiles[1]), 4U);
  EXPECT_EQ(joint_count(made.layout, made.layout.tiles[0], made.layout.tiles[1]), 4U);
}

TEST(JointSelection, ATileInAHoleKeepsTwoJointsHoweverSmall) {
  Polygon around = rectangle(0, 0, 60, 60);
  around.holes.push_back({{20, 20}, {20, 23}, {23, 23}, {23, 20}});
  ConstructionOptions options;
  options.collinear_m = 5.0;
  const TileLayout layout =
      construct_layout(std::vector{piece("a", around), piece("b", rectangle(20, 20, 23, 23))}, {},
                       options)
          .layout;
  EXPECT_EQ(joint_count(layout, layout.tiles[0], layout.tiles[1]), 2U);
}

TEST(LayoutConstruction, TilesThatMeetInAPointShareIt) {
  const LayoutConstruction made = construct_layout(
      std::vector{piece("a", rectangle(0, 0, 20, 20)), piece("b", rectangle(20, 20, 40, 40))});
  ASSERT_TRUE(made.failures.empty());
  EXPECT_EQ(made.layout.vertices.size(), 7U);
  EXPECT_EQ(joint_count(made.layout, made.layout.tiles[0], made.layout.tiles[1]), 1U);
}

TEST(LayoutConstruction, WhatCannotBeATileIsAFailureRow) {
  Polygon touching = rectangle(0, 100, 60, 160);
  touching.holes.push_back({{0, 130}, {20, 140}, {20, 120}});
  const LayoutConstruction made = construct_layout(std::vector{
      piece("bow tie", {{{200, 0}, {220, 20}, {220, 0}, {200, 20}}, {}}),
      piece("line", {{{300, 0}, {320, 0}, {340, 0}}, {}}), piece("touching hole", touching),
      piece("good", rectangle(0, 0, 20, 30)), piece("again", rectangle(0, 0, 20, 30)),
      piece("sliver", rectangle(20, 0, 20.5, 30)), piece("over", rectangle(5, 5, 12, 12))});
  ASSERT_EQ(made.layout.tiles.size(), 1U);
  EXPECT_EQ(made.layout.tiles[0].source_id, "good");
  std::map<std::string, FailureCode> codes;
  for (const TileFailure& row : made.failures) codes[row.source_id] = row.failure.code;
  EXPECT_EQ(codes, (std::map<std::string, FailureCode>{{"bow tie", FailureCode::kNotSimple},
                                                       {"line", FailureCode::kEmptyGeometry},
                                                       {"touching hole", FailureCode::kBadHole},
                                                       {"again", FailureCode::kTilesOverlap},
                                                       {"sliver", FailureCode::kTooSmall},
                                                       {"over", FailureCode::kTilesOverlap}}));
}

TEST(LayoutConstruction, OrderIsThatOfThePieces) {
  const LayoutConstruction made = construct_layout(
      std::vector{piece("c", rectangle(0, 0, 9, 9), 5), piece("a", rectangle(20, 0, 29, 9), 2),
                  piece("b", rectangle(9, 0, 18, 9), 5)});
  ASSERT_EQ(made.layout.tiles.size(), 3U);
  for (std::uint32_t t = 0; t < 3; ++t) EXPECT_EQ(made.layout.tiles[t].id.value, t);
  EXPECT_EQ(made.layout.tiles[0].source_id, "c");
  EXPECT_EQ(made.layout.tiles[1].source_id, "a");
  EXPECT_EQ(made.layout.next_id, 3U);
}

/// Two tiles with a common boundary of twelve nearly collinear steps, of which one is a corner.
std::vector<TilePiece> wavy_pair(double corner_m) {
  Ring left{{0, 0}};
  Ring right;
  for (int i = 0; i <= 12; ++i) {
    const Point p{20.0 + (i == 6 ? corner_m : 0.125 * (i % 2)), 3.0 * i};
    left.push_back(p);
    right.push_back(p);
  }
  left.push_back({0, 36});
  std::ranges::reverse(right);
  right.push_back({40, 0});
  right.push_back({40, 36});
  return {piece("a", {left, {}}), piece("b", {right, {}})};
}

TEST(JointSelection, CollinearVerticesConstrainNothing) {
  const TileLayout layout = construct_layout(wavy_pair(0.125)).layout;
  ASSERT_EQ(shared_edges(layout.tiles[0], layout.tiles[1]), 11U);  // of 12, one exactly straight
  EXPECT_EQ(joint_count(layout, layout.tiles[0], layout.tiles[1]), 2U);
}

TEST(JointSelection, CornersOfACommonBoundaryConstrain) {
  const TileLayout layout = construct_layout(wavy_pair(3.0)).layout;
  EXPECT_EQ(joint_count(layout, layout.tiles[0], layout.tiles[1]), 5U);  // ends, corner, its feet
}

TEST(JointSelection, OfNearVerticesOneConstrains) {
  ConstructionOptions options;
  options.near_m = 4.5;
  const TileLayout layout = construct_layout(wavy_pair(3.0), {}, options).layout;
  EXPECT_EQ(joint_count(layout, layout.tiles[0], layout.tiles[1]), 3U);
}

TEST(JointSelection, TwoTilesKeepTwoJointsHoweverShortTheirBoundary) {
  const TileLayout layout = construct_layout(std::vector{piece("a", rectangle(0, 0, 20, 1.5)),
                                                         piece("b", rectangle(20, 0, 40, 1.5))})
                                .layout;
  EXPECT_EQ(joint_count(layout, layout.tiles[0], layout.tiles[1]), 2U);
}

TEST(TileGraph, AVertexOfNTilesIsAJointOfEachTwo) {
  const TileLayout layout =
      construct_layout(
          std::vector{piece("a", rectangle(0, 0, 20, 20)), piece("b", rectangle(20, 0, 40, 20)),
                      piece("c", rectangle(0, 20, 20, 40)), piece("d", rectangle(20, 20, 40, 40))})
          .layout;
  const TileGraph graph = graph_of(layout);
  EXPECT_EQ(graph.joints.size(), 6U + 4U);  // the middle, and four ends
  for (const Joint& joint : graph.joints) {
    EXPECT_EQ(joint.rest_a, joint.rest_b);
    EXPECT_EQ(joint.kind, JointKind::kProperty);
  }
  EXPECT_EQ(graph.tiles[0].centroid, (Point{10, 10}));
  EXPECT_NEAR(graph.tiles[0].radius_m, std::sqrt(200.0), 1e-9);
}

/// The ring without vertices as near to the one before as snap rounding leaves them beside cuts: a
/// survey has none, and noise would tie them into knots.
Ring without_short_edges(const Ring& ring) {
  constexpr double kShort_m = 0.5;
  Ring out;
  for (const Point p : ring) {
    if (out.empty() || distance(out.back(), p) >= kShort_m) out.push_back(p);
  }
  while (out.size() > 1 && distance(out.back(), out.front()) < kShort_m) out.pop_back();
  return out;
}

/// Parcels of random blocks by a strategy, each vertex moved by at most `noise_m`.
std::vector<TilePiece> noisy_parcels(const std::string& strategy, Rng& rng, double noise_m) {
  std::vector<TilePiece> pieces;
  const auto blocks = testing::synthetic_blocks(rng, 6);
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    const auto block = blocks::block_from_contour({b}, blocks[b]);
    const auto divided = parcels::block_subdividers().make(strategy, {}).subdivide(block, rng);
    if (!divided) continue;
    for (const parcels::Parcel& parcel : *divided) {
      Polygon shape = parcel.shape;
      // Blocks stand 400 m apart, so that they are not in each other's way.
      const auto move = [&](Ring& ring) {
        if (noise_m > 0.0) ring = without_short_edges(ring);
        for (Point& p : ring) {
          p = p - blocks[b].outer.front() + Point{400.0 * b, 0.0} +
              Point{rng.uniform(-noise_m, noise_m), rng.uniform(-noise_m, noise_m)};
        }
      };
      move(shape.outer);
      for (Ring& hole : shape.holes) move(hole);
      pieces.push_back(piece(std::to_string(parcel.id.value), std::move(shape), b));
    }
  }
  return pieces;
}

class NoisyParcels : public ::testing::TestWithParam<std::string> {};

TEST_P(NoisyParcels, BecomeACoverage) {
  Rng rng = testing::property_rng("NoisyParcels." + GetParam());
  std::size_t tiles = 0;
  std::size_t given = 0;
  std::size_t neighbours = 0;
  for (int k = 0; k < testing::iterations(4); ++k) {
    constexpr double kNoise_m = 0.1;
    const std::vector<TilePiece> pieces = noisy_parcels(GetParam(), rng, kNoise_m);
    const LayoutConstruction made = construct_layout(pieces);
    const auto defect = find_layout_defect(made.layout);
    EXPECT_EQ(defect, std::nullopt) << defect->message;
    EXPECT_EQ(made.layout.tiles.size() + made.failures.size(), pieces.size());
    given += pieces.size();
    tiles += made.layout.tiles.size();
    const TileLayout again = settled(made.layout);
    EXPECT_EQ(again, made.layout);
    for (const double bent : closing_residuals_m(made.layout))
      EXPECT_LE(bent, ConstructionOptions{}.matching_m);
    for (std::size_t a = 0; a < made.layout.tiles.size(); ++a) {
      for (std::size_t b = a + 1; b < made.layout.tiles.size(); ++b) {
        const std::size_t edges = shared_edges(made.layout.tiles[a], made.layout.tiles[b]);
        if (edges == 0) continue;
        ++neighbours;
        EXPECT_GE(joint_count(made.layout, made.layout.tiles[a], made.layout.tiles[b]), 2U);
      }
    }
  }
  EXPECT_GT(tiles, given * 9 / 10);
  EXPECT_GT(neighbours, tiles);
}

TEST_P(NoisyParcels, WithoutNoiseStandExactlyAsTheyWere) {
  Rng rng = testing::property_rng("NoisyParcels.Exact." + GetParam());
  const std::vector<TilePiece> pieces = noisy_parcels(GetParam(), rng, 0.0);
  const LayoutConstruction made = construct_layout(pieces);
  std::size_t bent = 0;
  for (const double residual_m : closing_residuals_m(made.layout))
    bent += residual_m > kGridStep_m ? 1 : 0;
  // A strategy may leave vertices nearer to each other than they are matched.
  EXPECT_LE(bent, made.layout.tiles.size() / 20);
  EXPECT_GT(made.layout.tiles.size(), pieces.size() * 19 / 20);
}

TEST_P(NoisyParcels, DoNotDependOnTheThreadCount) {
  Rng rng = testing::property_rng("NoisyParcels.Jobs." + GetParam());
  const std::vector<TilePiece> pieces = noisy_parcels(GetParam(), rng, 0.15);
  EXPECT_EQ(construct_layout(pieces, {}, {}, {1}).layout,
            construct_layout(pieces, {}, {}, {4}).layout);
}

INSTANTIATE_TEST_SUITE_P(Strategies, NoisyParcels,
                         ::testing::Values("obb", "voronoi", "skeleton", "recursive"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace plat::tiles
