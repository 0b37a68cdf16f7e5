#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/property.h"
#include "tiles/reconfiguration_support.h"

namespace plat::tiles {
namespace {

using namespace plat::testing;  // NOLINT: the support of this test

double land_m2(const TileLayout& layout) {
  double out = 0.0;
  for (const Tile& tile : layout.tiles) out += area_m2(shape_of(layout, tile));
  return out;
}

TEST(CopyTiles, AGroupHasItsTilesWithWhatTheyShare) {
  TileLayout layout = made_layout({});
  layout.tiles[1].is_pinned = true;
  const std::vector<TileId> ids{layout.tiles[0].id, layout.tiles[1].id, layout.tiles[9].id};
  const auto group = copy_tiles(layout, ids);
  ASSERT_TRUE(group);
  ASSERT_EQ(group->tiles.tiles.size(), 3U);
  EXPECT_EQ(defect_of(group->tiles), "");
  for (std::size_t k = 0; k < 3; ++k) {
    const Tile& copy = group->tiles.tiles[k];
    EXPECT_EQ(shape_of(group->tiles, copy), land_of(layout, ids[k]));
    EXPECT_EQ(rest_shape_of(copy), rest_shape_of(tile_of(layout, ids[k])));
    EXPECT_FALSE(copy.is_pinned);
  }
  std::set<std::uint32_t> first;
  for (const Corner& c : group->tiles.tiles[0].rings[0]) first.insert(c.vertex);
  EXPECT_EQ(std::ranges::count_if(group->tiles.tiles[1].rings[0],
                                  [&](const Corner& c) { return first.contains(c.vertex); }),
            2);
  EXPECT_FALSE(group->property_edges.empty());
  EXPECT_FALSE(copy_tiles(layout, {{TileId{9999}}}));
}

TEST(CutTiles, VacantLandStaysInPlace) {
  const TileLayout layout = made_layout({});
  const TileId id = layout.tiles[40].id;
  const auto cut = cut_tiles(layout, {{id}}, VacatedLand::kVacant, small_city_options());
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->report.vanished, std::vector{id});
  ASSERT_EQ(cut->report.appeared.size(), 1U);
  const Tile& land = tile_of(cut->layout, cut->report.appeared.front());
  EXPECT_EQ(land.zone, kVacantZone);
  EXPECT_EQ(land.source_id, "");
  EXPECT_EQ(shape_of(cut->layout, land), land_of(layout, id));
  EXPECT_EQ(cut->layout.vertices, layout.vertices);
  EXPECT_EQ(cut->layout.links, layout.links);
}

TEST(CutTiles, NeighboursDrawTogetherOverClosedLand) {
  const TileLayout layout = made_layout({});
  const TileId id = layout.tiles[38].id;
  const TileId west = layout.tiles[37].id;
  const TileId east = layout.tiles[39].id;
  const auto cut = cut_tiles(layout, {{id}}, VacatedLand::kClosed, small_city_options());
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_EQ(cut->report.vanished, std::vector{id});
  EXPECT_EQ(defect_of(cut->layout), "");
  EXPECT_LT(land_m2(cut->layout), land_m2(layout) - 0.5 * area_m2(land_of(layout, id)));
  std::set<std::uint32_t> left;
  for (const Corner& c : tile_of(cut->layout, west).rings[0]) left.insert(c.vertex);
  EXPECT_EQ(std::ranges::count_if(tile_of(cut->layout, east).rings[0],
                                  [&](const Corner& c) { return left.contains(c.vertex); }),
            2);
}

TEST(CutTiles, WhatLayAcrossAClosedBlockIsLinked) {
  const TileLayout layout = made_layout({});
  std::vector<TileId> block;
  std::set<TileId> beside;
  for (const Tile& tile : layout.tiles) {
    if (tile.block == 4) block.push_back(tile.id);
    if (tile.block == 1 || tile.block == 7) beside.insert(tile.id);
  }
  auto options = small_city_options();
  options.reach_m.reset();
  options.solver.keep_size = 0.5;
  const auto cut = cut_tiles(layout, block, VacatedLand::kClosed, options);
  ASSERT_TRUE(cut || cut.error().code == FailureCode::kTilesOverlap) << cut.error().message;
  options.solver.keep_size = 0.0;
  const auto yielding = cut_tiles(layout, block, VacatedLand::kClosed, options);
  ASSERT_TRUE(yielding) << yielding.error().message;
  EXPECT_EQ(parts_of(yielding->layout), 1U);
  const auto across = std::ranges::count_if(yielding->layout.links, [&](const StreetLink& link) {
    const std::uint32_t a = yielding->layout.tiles[link.a].block;
    const std::uint32_t b = yielding->layout.tiles[link.b].block;
    return std::min(a, b) == 1 && std::max(a, b) == 7;
  });
  EXPECT_GT(across, 0);
}

TEST(CutTiles, ClosingLandKeepsTheCityConnected) {
  Rng rng = property_rng("ClosingLandKeepsTheCityConnected");
  int done = 0;
  int refused = 0;
  for (int i = 0; i < iterations(40); ++i) {
    const TileLayout layout = made_layout({.parcels_south = 2 + static_cast<int>(rng.index(4)),
                                           .parcels_north = 2 + static_cast<int>(rng.index(4)),
                                           .seed = rng()});
    const std::size_t tile = rng.index(layout.tiles.size());
    const auto cut =
        cut_tiles(layout, {{layout.tiles[tile].id}}, VacatedLand::kClosed, small_city_options());
    if (!cut) {
      ++refused;
      continue;
    }
    ++done;
    EXPECT_EQ(defect_of(cut->layout), "");
    EXPECT_EQ(coverage_defect_of(cut->layout), "");
    EXPECT_EQ(parts_of(cut->layout), 1U);
    EXPECT_EQ(cut->layout.tiles.size() + 1, layout.tiles.size());
  }
  EXPECT_GT(done, 2 * refused);
}

TEST(CutTiles, ASurroundedTileLeavesItsLandToTheOneAround) {
  std::vector<TilePiece> pieces(2);
  pieces[0].shape = {{{0, 0}, {40, 0}, {40, 40}, {0, 40}},
                     {{{10, 10}, {10, 30}, {30, 30}, {30, 10}}}};
  pieces[1].shape = {{{10, 10}, {30, 10}, {30, 30}, {10, 30}}, {}};
  const TileLayout layout = construct_layout(pieces).layout;
  ASSERT_EQ(layout.tiles.size(), 2U);
  const auto cut =
      cut_tiles(layout, {{layout.tiles[1].id}}, VacatedLand::kClosed, small_city_options());
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_EQ(land_m2(cut->layout), 1600.0);
  const auto around =
      cut_tiles(layout, {{layout.tiles[0].id}}, VacatedLand::kClosed, small_city_options());
  ASSERT_FALSE(around);
  EXPECT_EQ(around.error().code, FailureCode::kNoPlace);
}

}  // namespace
}  // namespace plat::tiles
