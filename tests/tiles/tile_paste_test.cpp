#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/property.h"
#include "tiles/reconfiguration_support.h"

namespace plat::tiles {
namespace {

using namespace plat::testing;  // NOLINT: the support of this test

/// An observed city is consistent to a step of the grid; solving again moves it by no more.
constexpr double kObserved_m = 0.005;

ReconfigurationOptions paste_options() {
  ReconfigurationOptions options = small_city_options();
  options.similarity = "affine_vertex";
  return options;
}

Affine from_to(const TileLayout& layout, TileId from, TileId to) {
  return Affine::translation(middle_of(layout, to) - middle_of(layout, from));
}

/// Tiles across streets from a tile, each as often as it is linked.
std::multiset<TileId> across(const TileLayout& layout, TileId id) {
  std::multiset<TileId> out;
  for (const StreetLink& link : layout.links) {
    if (layout.tiles[link.a].id == id) out.insert(layout.tiles[link.b].id);
    if (layout.tiles[link.b].id == id) out.insert(layout.tiles[link.a].id);
  }
  return out;
}

std::set<TileId> neighbours(const TileLayout& layout, TileId id) {
  std::set<std::uint32_t> own;
  for (const Corner& c : tile_of(layout, id).rings[0]) own.insert(c.vertex);
  std::set<TileId> out;
  for (const Tile& tile : layout.tiles) {
    const auto common = std::ranges::count_if(
        tile.rings[0], [&](const Corner& c) { return own.contains(c.vertex); });
    if (tile.id != id && common >= 2) out.insert(tile.id);
  }
  return out;
}

/// Every tile of `a` stands in `b` where it stands in `a`, ids of pasted tiles aside.
void expect_same_places(const TileLayout& a, const TileLayout& b, double tolerance_m) {
  ASSERT_EQ(a.tiles.size(), b.tiles.size());
  for (const Tile& tile : a.tiles) {
    const Point middle = centroid(shape_of(a, tile));
    double nearest = 1e9;
    for (const Tile& other : b.tiles)
      nearest = std::min(nearest, distance(centroid(shape_of(b, other)), middle));
    EXPECT_LT(nearest, tolerance_m) << "tile " << tile.id.value;
  }
}

TEST(PasteTiles, ACopyPastedOnItselfChangesNothing) {
  const TileLayout layout = made_layout({});
  for (std::size_t i = 0; i < layout.tiles.size(); i += 7) {
    const TileId id = layout.tiles[i].id;
    const auto pasted =
        paste_tiles(layout, copy_tiles(layout, {{id}}).value(), {}, paste_options());
    ASSERT_TRUE(pasted) << pasted.error().message;
    EXPECT_EQ(pasted->report.vanished, std::vector{id});
    ASSERT_EQ(pasted->report.appeared.size(), 1U);
    const TileId copy = pasted->report.appeared.front();
    EXPECT_EQ(tile_of(pasted->layout, copy).placement, Affine{});
    EXPECT_EQ(across(pasted->layout, copy), across(layout, id));
    EXPECT_EQ(neighbours(pasted->layout, copy), neighbours(layout, id));
    EXPECT_EQ(pasted->layout.links.size(), layout.links.size());
    EXPECT_EQ(pasted->layout.vertices.size(), layout.vertices.size());
    EXPECT_LT(pasted->report.objective, 1e-3);
    expect_same_places(layout, pasted->layout, kObserved_m);
  }
}

TEST(PasteTiles, APastedTileInheritsWhatTheReplacedWasJoinedTo) {
  const TileLayout layout = made_layout({});
  const TileId source = layout.tiles[0].id;
  const TileId target = layout.tiles[41].id;
  const auto group = copy_tiles(layout, {{source}}).value();
  const auto pasted = paste_tiles(layout, group, from_to(layout, source, target), paste_options());
  ASSERT_TRUE(pasted) << pasted.error().message;
  EXPECT_EQ(pasted->report.vanished, std::vector{target});
  const TileId copy = pasted->report.appeared.front();
  EXPECT_EQ(neighbours(pasted->layout, copy), neighbours(layout, target));
  EXPECT_EQ(across(pasted->layout, copy), across(layout, target));
  EXPECT_EQ(tile_of(pasted->layout, copy).source_id, layout.tiles[0].source_id);
  EXPECT_EQ(tile_of(pasted->layout, copy).zone, layout.tiles[0].zone);
  EXPECT_EQ(tile_of(pasted->layout, copy).block, tile_of(layout, target).block);
  EXPECT_EQ(defect_of(pasted->layout), "");
  EXPECT_EQ(parts_of(pasted->layout), 1U);
}

TEST(PasteTiles, HeldTilesKeepTheirShapeAndOthersMakeRoom) {
  const TileLayout layout = made_layout({});
  const TileId source = layout.tiles[0].id;
  const auto group = copy_tiles(layout, {{source}}).value();
  const Affine to = from_to(layout, source, layout.tiles[41].id);
  auto options = paste_options();
  const auto held = paste_tiles(layout, group, to, options);
  options.pasted = PastedTiles::kFree;
  const auto free = paste_tiles(layout, group, to, options);
  ASSERT_TRUE(held && free);
  const Affine rigid = tile_of(held->layout, held->report.appeared.front()).placement;
  EXPECT_NEAR(rigid.determinant(), 1.0, 1e-9);
  EXPECT_NEAR(squared_length({rigid.xx, rigid.yx}), 1.0, 1e-9);
  EXPECT_GT(held->report.moved.size(), 5U);
  EXPECT_LT(free->report.objective, held->report.objective);
}

TEST(PasteTiles, AGroupTakesThePlaceOfAUnion) {
  const TileLayout layout = made_layout({});
  const std::vector<TileId> source{layout.tiles[0].id, layout.tiles[1].id, layout.tiles[4].id};
  const auto group = copy_tiles(layout, source).value();
  const auto pasted = paste_tiles(
      layout, group, from_to(layout, layout.tiles[1].id, layout.tiles[37].id), paste_options());
  ASSERT_TRUE(pasted) << pasted.error().message;
  EXPECT_EQ(pasted->report.appeared.size(), 3U);
  EXPECT_GE(pasted->report.vanished.size(), 2U);
  EXPECT_EQ(defect_of(pasted->layout), "");
  const TileId first = pasted->report.appeared[0];
  EXPECT_TRUE(neighbours(pasted->layout, first).contains(pasted->report.appeared[1]));
}

TEST(PasteTiles, PastingBackRestoresTheErrors) {
  const TileLayout layout = made_layout({});
  const TileId source = layout.tiles[0].id;
  const TileId target = layout.tiles[41].id;
  const auto group = copy_tiles(layout, {{source}}).value();
  const auto kept = copy_tiles(layout, {{target}}).value();
  auto options = paste_options();
  options.pasted = PastedTiles::kFree;
  const auto there = paste_tiles(layout, group, from_to(layout, source, target), options);
  ASSERT_TRUE(there) << there.error().message;
  EXPECT_GT(there->report.objective, 0.1);
  const auto back = paste_tiles(there->layout, kept, {}, options);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->layout.vertices.size(), layout.vertices.size());
  EXPECT_LT(back->report.objective, 0.01 * there->report.objective);
  expect_same_places(layout, back->layout, 0.05);
}

TEST(PasteTiles, NothingIsPastedWhereNoTilesAre) {
  const TileLayout layout = made_layout({});
  const auto group = copy_tiles(layout, {{layout.tiles[0].id}}).value();
  const auto outside = paste_tiles(layout, group, Affine::translation({-500, 0}), paste_options());
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().code, FailureCode::kNoPlace);
  EXPECT_NE(outside.error().message.find("0 % of what is pasted"), std::string::npos);
  // Over the city's border: a third of it still lies on the westernmost tile.
  const auto border = paste_tiles(layout, group, Affine::translation({-14, 0}), paste_options());
  ASSERT_FALSE(border);
  EXPECT_EQ(border.error().code, FailureCode::kNoPlace);
  EXPECT_FALSE(paste_tiles(layout, {}, {}, paste_options()));
  EXPECT_FALSE(paste_tiles(layout, group, {.xx = -1}, paste_options()));
  auto unknown = paste_options();
  unknown.similarity = "likeness";
  EXPECT_THROW((void)paste_tiles(layout, group, {}, unknown), InputError);
}

TEST(PasteTiles, TilesAndVacantLandStayACoverage) {
  const TileLayout layout = made_layout({});
  ASSERT_EQ(coverage_defect_of(layout), "");
  int pasted = 0;
  for (std::size_t i = 0; i + 3 < layout.tiles.size(); i += 9) {
    const std::vector<TileId> source{layout.tiles[i].id, layout.tiles[i + 1].id};
    const auto group = copy_tiles(layout, source).value();
    // A middle piece of the row is taken away, its land stays; the group comes beside it.
    const auto cut =
        cut_tiles(layout, {{layout.tiles[38].id}}, VacatedLand::kVacant, paste_options());
    ASSERT_TRUE(cut);
    EXPECT_EQ(coverage_defect_of(cut->layout), "");
    const auto result = paste_tiles(
        cut->layout, group, from_to(layout, source[0], layout.tiles[39].id), paste_options());
    if (!result) continue;
    ++pasted;
    EXPECT_EQ(coverage_defect_of(result->layout), "") << "tile " << i;
    EXPECT_NE(result->layout.tiles.size(), 0U);
  }
  EXPECT_GE(pasted, 4);
}

TEST(PasteTiles, PinnedTilesAreNotReplaced) {
  TileLayout layout = made_layout({});
  const TileId source = layout.tiles[0].id;
  const TileId target = layout.tiles[41].id;
  const auto group = copy_tiles(layout, {{source}}).value();
  const Affine to = from_to(layout, source, target);
  layout.tiles[41].is_pinned = true;
  const auto refused = paste_tiles(layout, group, to, paste_options());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, FailureCode::kNoPlace);
  EXPECT_NE(refused.error().message.find("not pinned"), std::string::npos);

  // Where a part of the piece lies on others, those give way and the pinned one stays.
  const auto beside =
      paste_tiles(layout, group, Affine::translation({-8, 0}) * to, paste_options());
  ASSERT_TRUE(beside) << beside.error().message;
  ASSERT_TRUE(find_tile(beside->layout, target));
  EXPECT_EQ(tile_of(beside->layout, target).placement, tile_of(layout, target).placement);
  EXPECT_EQ(beside->report.vanished, std::vector{layout.tiles[40].id});
}

TEST(PasteTiles, ATurnedCityGivesTheTurnedResult) {
  const Affine turn = Affine::rotation(0.7, {100, 50});
  const TileLayout layout = with_pinned_corners(made_layout({}));
  TileLayout turned = made_layout({.turn = turn});
  for (std::size_t i = 0; i < turned.tiles.size(); ++i)
    turned.tiles[i].is_pinned = layout.tiles[i].is_pinned;
  auto options = paste_options();
  options.reach_m.reset();
  const TileId source = layout.tiles[2].id;
  const TileId target = layout.tiles[38].id;
  const auto a = paste_tiles(layout, copy_tiles(layout, {{source}}).value(),
                             from_to(layout, source, target), options);
  const auto b = paste_tiles(turned, copy_tiles(turned, {{source}}).value(),
                             from_to(turned, source, target), options);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->report.objective, b->report.objective, 0.02 * a->report.objective);
  for (const Tile& tile : a->layout.tiles)
    EXPECT_LT(distance(turn(middle_of(a->layout, tile.id)), middle_of(b->layout, tile.id)), 0.02);
}

TEST(PasteTiles, LinksWithinAGroupOfSeveralBlocksComeAlong) {
  const TileLayout layout = made_layout({});
  std::vector<TileId> group;
  std::uint32_t across_street = 0;
  for (const StreetLink& link : layout.links) {
    if (layout.tiles[link.a].block == 0 && layout.tiles[link.b].block == 1) {
      group = {layout.tiles[link.a].id, layout.tiles[link.b].id};
      ++across_street;
      break;
    }
  }
  ASSERT_EQ(across_street, 1U);
  const Affine to = Affine::translation({92.0, 72.0});  // a block further east and north
  const auto pasted = paste_tiles(layout, copy_tiles(layout, group).value(), to, paste_options());
  ASSERT_TRUE(pasted) << pasted.error().message;
  ASSERT_EQ(pasted->report.appeared.size(), 2U);
  EXPECT_TRUE(
      across(pasted->layout, pasted->report.appeared[0]).contains(pasted->report.appeared[1]));
}

TEST(PasteTiles, CornersOfItsOwnAreTheNeighboursTooUntilPastedBack) {
  const auto box = [](double x) {
    return Polygon{{{x, 0}, {x + 20, 0}, {x + 20, 30}, {x, 30}}, {}};
  };
  const TileLayout layout =
      construct_layout(std::vector<TilePiece>{
                           {"a", "", 0, box(0)}, {"b", "", 0, box(20)}, {"c", "", 0, box(40)}})
          .layout;
  const TileLayout bulging =
      construct_layout(std::vector<TilePiece>{
                           {"d", "", 0, {{{20, 0}, {40, 0}, {44, 15}, {40, 30}, {20, 30}}, {}}}})
          .layout;
  const auto group = copy_tiles(bulging, {{bulging.tiles[0].id}}).value();
  auto options = paste_options();
  options.similarity = "box";
  options.reach_m = 0.0;
  const auto pasted = paste_tiles(layout, group, {}, options);
  ASSERT_TRUE(pasted) << pasted.error().message;
  const TileId c = layout.tiles[2].id;
  EXPECT_EQ(tile_of(pasted->layout, c).rings[0].size(), 5U);
  const auto kept = copy_tiles(layout, {{layout.tiles[1].id}}).value();
  const auto back = paste_tiles(pasted->layout, kept, {}, options);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(tile_of(back->layout, c).rings[0].size(), 4U);
}

}  // namespace
}  // namespace plat::tiles
