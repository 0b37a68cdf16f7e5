#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tiles/reconfiguration_support.h"
#include "tiles/settling.h"
#include "tiles/tile_replacement_internal.h"

namespace plat::tiles {
namespace {

using namespace plat::testing;  // NOLINT: the support of this test

ReconfigurationOptions replacing() {
  ReconfigurationOptions options = small_city_options();
  options.similarity = "affine_vertex";
  options.reach_m.reset();
  options.replacement = ReplacementOptions{
      .deformation_threshold = 0.05, .gap_threshold_m = 1.0, .candidates = 5, .max_rounds = 4};
  return options;
}

/// A city pulled out of shape: corners pinned, a tile in the middle moved.
Expected<Reconfiguration> pulled(const ReconfigurationOptions& options) {
  const TileLayout layout = with_pinned_corners(made_layout({}));
  return move_tiles(layout, {{layout.tiles[40].id}}, Affine::translation({6, -7}), options);
}

TEST(Replacement, AcceptedReplacementsLowerTheTotalError) {
  auto without = replacing();
  without.replacement.reset();
  const auto plain = pulled(without);
  const auto replaced = pulled(replacing());
  ASSERT_TRUE(plain && replaced);
  EXPECT_GT(replaced->report.replacements, 0U);
  EXPECT_GT(replaced->report.replacements_refused, 0U);
  EXPECT_LT(replaced->report.objective, plain->report.objective);
  EXPECT_NEAR(objective_of(replaced->layout, replacing().solver), replaced->report.objective,
              1e-6 * replaced->report.objective);
  EXPECT_EQ(defect_of(replaced->layout), "");
  EXPECT_FALSE(replaced->report.appeared.empty());
  EXPECT_FALSE(replaced->report.vanished.empty());
}

TEST(Replacement, EveryJointIsStillCounted) {
  auto without = replacing();
  without.replacement.reset();
  const auto plain = pulled(without);
  ASSERT_TRUE(plain);
  const auto replaced = replace_deformed_tiles(plain->layout, *replacing().replacement, without);
  ASSERT_TRUE(replaced) << replaced.error().message;
  ASSERT_GT(replaced->report.replacements, 0U);
  ASSERT_EQ(replaced->report.appeared.size(), replaced->report.vanished.size());
  EXPECT_GE(graph_of(replaced->layout).joints.size(), graph_of(plain->layout).joints.size());
  EXPECT_LT(objective_of(replaced->layout, without.solver),
            objective_of(plain->layout, without.solver));
}

TEST(Replacement, ReplacingTilesAreOfTheSameZone) {
  const TileLayout before = with_pinned_corners(made_layout({}));
  auto options = replacing();
  options.replacement->max_rounds = 1;
  const auto replaced = pulled(options);
  ASSERT_TRUE(replaced);
  ASSERT_FALSE(replaced->report.appeared.empty());
  const auto count = [](const TileLayout& layout, const std::vector<TileId>& ids) {
    std::map<std::string, std::size_t> out;
    for (const TileId id : ids) ++out[tile_of(layout, id).zone];
    return out;
  };
  ASSERT_EQ(replaced->report.appeared.size(), replaced->report.vanished.size());
  EXPECT_EQ(count(replaced->layout, replaced->report.appeared),
            count(before, replaced->report.vanished));
}

/// Pairs that overlap, the first alone where a tile is turned inside out.
std::set<std::pair<TileId, std::optional<TileId>>> defects_of(const TileLayout& layout) {
  std::set<std::pair<TileId, std::optional<TileId>>> out;
  for (const TileDefect& defect : find_tile_defects(layout)) {
    const TileId tile = layout.tiles[defect.tile].id;
    if (!defect.other) {
      out.emplace(tile, std::nullopt);
      continue;
    }
    const TileId other = layout.tiles[*defect.other].id;
    out.emplace(std::min(tile, other), std::max(tile, other));
  }
  return out;
}

TEST(Replacement, NoOverlapIsTradedForAnother) {
  int overlapping = 0;
  int replaced = 0;
  for (std::uint64_t seed = 6; seed <= 9; ++seed) {
    TileLayout layout =
        with_pinned_corners(made_layout({.blocks_x = 2, .blocks_y = 2, .seed = seed}));
    auto options = replacing();
    detail::Targets held = detail::held_tiles(layout, {}, {}, std::nullopt);
    held.insert_or_assign(13, Affine::translation({-10, 26}));
    held.insert_or_assign(15, Affine::translation({-20, 0}));
    auto start = detail::solved(layout, held, options.solver);
    ASSERT_TRUE(start);
    const auto before = defects_of(settled(start->layout));
    if (before.empty()) continue;
    ++overlapping;
    ReconfigurationReport report;
    const auto after =
        detail::with_replacements(layout, *start, held, *options.replacement, options, report);
    if (report.replacements > 0) ++replaced;
    EXPECT_TRUE(std::ranges::includes(before, defects_of(after.layout))) << "seed " << seed;
  }
  EXPECT_GT(overlapping, 1);
  EXPECT_GT(replaced, 1);
}

TEST(Replacement, WhatCannotBeLaidThereIsCountedApart) {
  const auto box = [](double x, double y, double width, double height) {
    return Ring{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  };
  std::vector<TilePiece> pieces;
  for (Ring ring : {box(0, 0, 20, 40), box(20, 0, 40, 40), box(60, 0, 20, 40), box(80, 0, 20, 40),
                    box(30, 10, 20, 20)})
    pieces.push_back({"", "", 0, {std::move(ring), {}}});
  Ring hole = box(30, 10, 20, 20);
  std::ranges::reverse(hole);
  pieces[1].shape.holes.push_back(hole);
  TileLayout layout = construct_layout(pieces).layout;
  ASSERT_EQ(layout.tiles.size(), 5U);
  layout.tiles[0].is_pinned = true;
  // The third tile and the second, which surrounds the fifth, cannot give way together.
  const auto result =
      move_tiles(layout, {{layout.tiles[3].id}}, Affine::translation({14, 0}), replacing());
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_GT(result->report.replacements_without_place, 0U);
}

/// Blocks of three square lots, and one whose middle lot is pulled to twice its width.
Expected<Reconfiguration> pulled_apart(int unions) {
  std::vector<TilePiece> pieces;
  for (std::uint32_t block = 0; block < 3; ++block) {
    for (int i = 0; i < 3; ++i) {
      const double x = 20.0 * i;
      const double y = 500.0 * block;  // no street between blocks
      pieces.push_back({"",
                        i == 1 ? "park" : "residential",
                        block,
                        {{{x, y}, {x + 20, y}, {x + 20, y + 20}, {x, y + 20}}, {}}});
      if (block > 0) pieces.back().zone = "park";
    }
  }
  TileLayout layout = construct_layout(pieces).layout;
  for (Tile& tile : layout.tiles) tile.is_pinned = tile.block > 0;
  layout.tiles[0].is_pinned = true;
  auto options = replacing();
  options.replacement->unions = unions;
  return move_tiles(layout, {{layout.tiles[2].id}}, Affine::translation({20, 0}), options);
}

TEST(Replacement, TwoTilesTakeThePlaceOfOneThatIsMuchTooLarge) {
  const auto without = pulled_apart(0);
  const auto with = pulled_apart(3);
  ASSERT_TRUE(without && with);
  EXPECT_EQ(without->report.replacements, 0U);
  EXPECT_EQ(with->report.replacements, 1U);
  EXPECT_EQ(with->report.vanished, std::vector{TileId{1}});
  ASSERT_EQ(with->report.appeared.size(), 2U);
  for (const TileId id : with->report.appeared) {
    EXPECT_EQ(tile_of(with->layout, id).zone, "park");
    EXPECT_EQ(tile_of(with->layout, id).block, 0U);
    EXPECT_NEAR(area_m2(land_of(with->layout, id)), 400.0, 1.0);
  }
  EXPECT_LT(with->report.objective, 0.1 * without->report.objective);
  EXPECT_EQ(defect_of(with->layout), "");
  EXPECT_EQ(coverage_defect_of(with->layout), "");
}

TEST(Replacement, NothingOverTheThresholdsNothingReplaced) {
  const TileLayout layout = made_layout({});
  auto options = replacing();
  const auto same = replace_deformed_tiles(layout, {}, options);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->report.replacements, 0U);
  EXPECT_EQ(same->report.replacements_refused, 0U);
  EXPECT_EQ(same->layout, layout);
}

TEST(Replacement, PinnedTilesAreNotReplaced) {
  auto options = replacing();
  options.replacement->deformation_threshold = 0.0;
  options.replacement->gap_threshold_m = 0.0;
  const TileLayout before = with_pinned_corners(made_layout({}));
  const auto replaced = pulled(options);
  ASSERT_TRUE(replaced) << replaced.error().message;
  for (const Tile& tile : before.tiles) {
    if (tile.is_pinned || tile.id == before.tiles[40].id) {
      EXPECT_TRUE(find_tile(replaced->layout, tile.id)) << tile.id.value;
    }
  }
}

TEST(Replacement, SameInputSameBytes) {
  const auto a = pulled(replacing());
  const auto b = pulled(replacing());
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->layout, b->layout);
  EXPECT_EQ(a->report.replacements_refused, b->report.replacements_refused);
}

}  // namespace
}  // namespace plat::tiles
