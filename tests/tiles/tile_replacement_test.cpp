#include <gtest/gtest.h>

#include <algorithm>

#include "tiles/reconfiguration_support.h"

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
  if (replaced->report.appeared.size() == replaced->report.vanished.size()) {
    EXPECT_GE(graph_of(replaced->layout).joints.size(), graph_of(plain->layout).joints.size());
  }
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
  if (replaced->report.appeared.size() == replaced->report.vanished.size()) {
    EXPECT_EQ(count(replaced->layout, replaced->report.appeared),
              count(before, replaced->report.vanished));
  }
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
