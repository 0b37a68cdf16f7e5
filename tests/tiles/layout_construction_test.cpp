#include "tiles/layout_construction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/working_grid.h"
#include "parcels/block_subdivider.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"
#include "tiles/layout_defects.h"
#include "tiles/settling.h"

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
            (Ring{{0, 0}, {20.25, 0.125}, {20.25, 30.125}, {0, 30}}));
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

}  // namespace
}  // namespace plat::tiles
