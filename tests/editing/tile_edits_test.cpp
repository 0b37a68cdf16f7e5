// Edits of tiles through the city document, and the streets that go along.
#include <gtest/gtest.h>

#include "editing/city_support.h"
#include "editing/tiled_city.h"
#include "tiles/layout_defects.h"

namespace plat::editing {
namespace {

using testing::bytes_of;
using testing::street_near;
using testing::tiled_grid_city;
using tiles::TileId;

const tiles::Tile& tile_of(const City& city, std::uint32_t id) {
  return city.tiles()->tiles[*tiles::find_tile(*city.tiles(), {id})];
}

Point center_of(const City& city, std::uint32_t id) {
  return centroid(tiles::shape_of(*city.tiles(), tile_of(city, id)));
}

/// The tiles of a block of tiled_grid_city(), by its number.
std::vector<TileId> block_tiles(std::uint32_t block) {
  return {{4 * block}, {4 * block + 1}, {4 * block + 2}, {4 * block + 3}};
}

/// A city whose tiles stay where edits do not name them.
Editor pinned_city() {
  Editor editor(tiled_grid_city(4, 4));
  std::vector<TileId> all;
  for (const tiles::Tile& tile : editor.city().tiles()->tiles) all.push_back(tile.id);
  EXPECT_TRUE(editor.apply(PinTiles{all}));
  return Editor(editor.city());
}

TEST(TileEdits, BlocksOfACityOfTilesHaveNoParcels) {
  Editor editor(tiled_grid_city(4, 4));
  EXPECT_EQ(editor.city().blocks().size(), 9U);
  const NodeId node = testing::node_near(editor.city(), {100, 80});
  ASSERT_TRUE(editor.apply(MoveNode{node, {104, 83}}));
  ASSERT_TRUE(editor.apply(SetBlockStyle{{}, {"obb", {}}}));
  editor.city().blocks().for_each([](BlockId, const CityBlock& block) {
    EXPECT_TRUE(block.parcels.empty());
    EXPECT_FALSE(block.failure);
  });
}

TEST(TileEdits, StreetEditsLeaveTilesAsTheyAre) {
  Editor editor(tiled_grid_city(4, 4));
  const auto before = editor.city().tiles();
  ASSERT_TRUE(editor.apply(MoveNode{testing::node_near(editor.city(), {100, 80}), {104, 83}}));
  ASSERT_TRUE(editor.apply(AddStreet{{50, 0}, {50, 80}}));
  EXPECT_EQ(editor.city().tiles(), before);
}

TEST(TileEdits, MovedTilesTakeTheStreetsAroundThemAlong) {
  Editor editor = pinned_city();
  const StreetId west = street_near(editor.city(), {100, 120});
  const auto report = editor.apply(MoveTiles{block_tiles(4), Affine::translation({5.0, 0.0}), {}});
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_TRUE(report->tiles);
  EXPECT_NEAR(center_of(editor.city(), 16).x, 100.0 + 6.0 + 22.0 + 5.0, 0.01);
  EXPECT_GT(report->nodes_moved, 0U);
  EXPECT_FALSE(report->changed.empty());
  // The street west of the block keeps its place between two fronts.
  const CityStreet& street = editor.city().streets().at(west);
  const double x = midpoint(street.line.front(), street.line.back()).x;
  EXPECT_GT(x, 100.5);
  EXPECT_LT(x, 105.0);
  testing::expect_as_from_scratch(editor.city());
}

TEST(TileEdits, FrontsThatPartMakeTheirStreetWider) {
  Editor editor = pinned_city();
  const StreetId west = street_near(editor.city(), {100, 120});
  const StreetId east = street_near(editor.city(), {200, 120});
  const StreetId far = street_near(editor.city(), {300, 40});
  const auto report = editor.apply(MoveTiles{block_tiles(4), Affine::translation({2.0, 0.0}), {}});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_NEAR(editor.city().streets().at(west).width_m, 14.0, 0.01);
  EXPECT_NEAR(editor.city().streets().at(east).width_m, 10.0, 0.01);
  EXPECT_EQ(editor.city().streets().at(far).width_m, 12.0);
  EXPECT_EQ(report->streets_resized, 2U);
}

TEST(TileEdits, ControlPointsOfCurvesGoAlong) {
  Editor editor(tiled_grid_city(4, 4));
  const StreetId street = street_near(editor.city(), {150, 80});
  const Curve curve{{130, 83}, {170, 83}};
  ASSERT_TRUE(editor.apply(BendStreet{street, curve}));
  std::vector<TileId> all;
  for (const tiles::Tile& tile : editor.city().tiles()->tiles) all.push_back(tile.id);
  const Affine turn = Affine::rotation(0.2, {150, 120});
  ASSERT_TRUE(editor.apply(MoveTiles{all, turn, {}}));
  const auto& moved = editor.city().streets().at(street).curve;
  ASSERT_TRUE(moved);
  EXPECT_LT(distance(moved->first, turn(curve.first)), 0.01);
  EXPECT_LT(distance(moved->second, turn(curve.second)), 0.01);
}

TEST(TileEdits, FrontsThatStandInTheirStreetAreCounted) {
  Editor editor = pinned_city();
  const StreetId east = street_near(editor.city(), {200, 120});
  const auto wide = editor.apply(MoveTiles{block_tiles(4), Affine::translation({11.0, 0.0}), {}});
  ASSERT_TRUE(wide) << wide.error().message;
  EXPECT_EQ(wide->streets_too_narrow, 0U);
  const auto narrow = editor.apply(MoveTiles{block_tiles(4), Affine::translation({0.8, 0.0}), {}});
  ASSERT_TRUE(narrow) << narrow.error().message;
  EXPECT_EQ(narrow->streets_resized, 2U);
  EXPECT_EQ(narrow->streets_too_narrow, 1U);
  EXPECT_EQ(editor.city().streets().at(east).width_m, kMinStreetWidth_m);
}

TEST(TileEdits, FreedTilesMakeRoomAgain) {
  Editor editor = pinned_city();
  ASSERT_TRUE(editor.apply(MoveTiles{{{16}}, Affine::translation({0.5, 0.5}), {}}));
  EXPECT_EQ(tile_of(editor.city(), 17).placement, Affine{});
  const auto report = editor.apply(PinTiles{block_tiles(4), Pinning::kFree});
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->tiles);
  ASSERT_TRUE(editor.apply(MoveTiles{{{16}}, Affine::translation({0.5, 0.5}), {}}));
  EXPECT_NE(tile_of(editor.city(), 17).placement, Affine{});
}

/// Does one edit of each kind after the other; the bytes before and after each.
std::vector<std::string> states_of_all_edits(Editor& editor) {
  const auto group = std::make_shared<const tiles::TileGroup>(
      *tiles::copy_tiles(*editor.city().tiles(), std::vector<TileId>{{1}}));
  const std::vector<Edit> edits{
      MoveTiles{{{5}}, Affine::translation({2.0, 1.0}), {}},
      CutTiles{{{9}}, tiles::VacatedLand::kVacant, {}},
      PinTiles{{{12}}},
      PasteTiles{group, Affine::rotation(0.1, {78, 23}) * Affine::translation({100.0, 80.0}), {}},
      CutTiles{{{28}}, tiles::VacatedLand::kClosed, {}},
      ReplaceTiles{{.deformation_threshold = 0.001, .candidates = 1, .max_rounds = 1}, {}},
      PinTiles{{{12}}, Pinning::kFree},
      RelaxTiles{}};
  std::vector<std::string> states{bytes_of(editor.city())};
  for (const Edit& edit : edits) {
    const auto report = editor.apply(edit);
    EXPECT_TRUE(report) << edit_name(edit) << ": " << report.error().message;
    states.push_back(bytes_of(editor.city()));
    EXPECT_NE(states.back(), states[states.size() - 2]) << edit_name(edit);
  }
  return states;
}

TEST(TileEdits, UndoAndRedoRestoreTheSameBytes) {
  Editor editor(tiled_grid_city(4, 4));
  const std::vector<std::string> states = states_of_all_edits(editor);
  ASSERT_EQ(editor.undo_count() + 1, states.size());
  for (std::size_t i = states.size() - 1; i > 0; --i) {
    editor.undo();
    EXPECT_EQ(bytes_of(editor.city()), states[i - 1]) << "edit " << i;
  }
  for (std::size_t i = 1; i < states.size(); ++i) {
    editor.redo();
    EXPECT_EQ(bytes_of(editor.city()), states[i]) << "edit " << i;
  }
}

TEST(TileEdits, IdsOfWhatWasUndoneAreGivenAgain) {
  Editor editor(tiled_grid_city(4, 4));
  const auto appeared = [&](std::uint32_t cut) {
    const auto report = editor.apply(CutTiles{{{cut}}, tiles::VacatedLand::kVacant, {}});
    return report.value().tiles.value().appeared;
  };
  const std::vector<TileId> first = appeared(9);
  editor.undo();
  EXPECT_EQ(appeared(5), first);
  EXPECT_NE(appeared(9), first);
}

TEST(TileEdits, AnEditThatFailsChangesNothing) {
  Editor editor = pinned_city();
  const std::string before = bytes_of(editor.city());
  const auto refused = [&](const Edit& edit, FailureCode code) {
    const auto report = editor.apply(edit);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, code) << report.error().message;
    EXPECT_EQ(bytes_of(editor.city()), before);
  };
  refused(MoveTiles{{{999}}, Affine::translation({1, 0}), {}}, FailureCode::kUnknownEntity);
  refused(PinTiles{{{0}, {999}}}, FailureCode::kUnknownEntity);
  refused(PinTiles{{{0}, {999}}, Pinning::kFree}, FailureCode::kUnknownEntity);
  refused(PinTiles{}, FailureCode::kUnknownEntity);
  refused(MoveTiles{{{0}}, Affine::translation({150, 0}), {}}, FailureCode::kTilesOverlap);
  EXPECT_EQ(editor.undo_count(), 0U);
}

TEST(TileEdits, StreetsThatWouldCrossRefuseTheEditWithThePlace) {
  Editor editor = pinned_city();
  // A dead end goes along with the block, the street before its end only in part.
  ASSERT_TRUE(editor.apply(AddStreet{{100.0, 120.0}, {199.2, 120.0}, 3.0, {}, "residential", 0.0}));
  const std::string before = bytes_of(editor.city());
  const auto report = editor.apply(MoveTiles{block_tiles(4), Affine::translation({11.0, 0.0}), {}});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, FailureCode::kStreetsCross);
  EXPECT_NE(report.error().message.find(" near ("), std::string::npos) << report.error().message;
  EXPECT_EQ(bytes_of(editor.city()), before);
}

TEST(TileEdits, ACityWithoutTilesHasNone) {
  Editor editor(testing::grid_city(3, 3));
  const auto report = editor.apply(RelaxTiles{});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, FailureCode::kUnknownEntity);
}

TEST(TileEdits, ACityOfTilesNeedsNoStreets) {
  Editor editor(make_city_of_tiles({}, testing::grid_tiles(3, 3), {}));
  EXPECT_EQ(editor.city().streets().size(), 0U);
  const auto report = editor.apply(MoveTiles{{{5}}, Affine::translation({2.0, 1.0}), {}});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->nodes_moved, 0U);
  EXPECT_FALSE(tiles::find_layout_defect(*editor.city().tiles()));
}

}  // namespace
}  // namespace plat::editing
