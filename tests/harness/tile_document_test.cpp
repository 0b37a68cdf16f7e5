#include "harness/tile_document.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/rng.h"
#include "geodata/layer_io.h"
#include "harness/city_file.h"
#include "harness/tile_imagery.h"
#include "support/utm_frame.h"
#include "tiles/reconfiguration.h"

namespace plat::harness {
namespace {

using tiles::TileLayout;

/// Two tiles that share an edge and one across a street, with every field set to what rounding
/// would change.
TileLayout layout() {
  TileLayout out;
  const auto add = [&](Point p, bool is_joint) { out.vertices.push_back({p, is_joint}); };
  for (const double x : {0.0, 20.0, 40.0, 52.0, 80.0}) {
    add({x, 0.0}, x != 0.0);
    add({x, 30.0009765625}, true);
  }
  const auto tile = [&](std::uint32_t id, std::uint32_t block, std::uint32_t first) {
    tiles::Tile made;
    made.id = {id};
    made.source_id = "lot \"7\"; é";
    made.zone = id == 3 ? "" : "housing";
    made.block = block;
    made.placement = {1.0 / 3.0, 1e-17, -0.1, 0.7, {1e5 / 7.0, -2.0 / 3.0}};
    made.is_pinned = id == 5;
    auto& ring = made.rings.emplace_back();
    for (const std::uint32_t v : {first, first + 2, first + 3, first + 1})
      ring.push_back({v, out.vertices[v].at + Point{0.1 / 3.0, -1e-9}});
    out.tiles.push_back(std::move(made));
  };
  tile(5, 0, 0);
  tile(3, 0, 2);
  tile(9, 1, 6);
  out.links.push_back({1, {45.1, 1.0 / 3.0}, 2, {46.2, 7.0 / 9.0}, 12.0 / 7.0});
  out.next_id = 12;
  return out;
}

class TileDocument : public ::testing::Test {
 protected:
  TileDocument()
      : file_((std::filesystem::temp_directory_path() /
               ("plat_tile_document_" + std::to_string(::getpid()) + ".gpkg"))
                  .string()) {}
  ~TileDocument() override { std::filesystem::remove(file_); }

  void write(const editing::City& city) const {
    geodata::write_layers(file_, city_layers(city, testing::utm_frame()));
  }
  /// What reading the file says against it; empty where it is a city.
  [[nodiscard]] std::string refusal() const {
    try {
      static_cast<void>(read_city(file_, {}));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] std::string refusal(const TileLayout& layout) const {
    write(editing::make_city_of_tiles({}, layout, {}));
    return refusal();
  }
  [[nodiscard]] std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::string file_;
};

TEST_F(TileDocument, IsReadBackToTheLastBit) {
  write(editing::make_city_of_tiles({}, layout(), {}));
  const PlacedCity again = read_city(file_, {});
  ASSERT_TRUE(again.city.tiles());
  EXPECT_EQ(*again.city.tiles(), layout());
  const std::string first = bytes();
  write(again.city);
  EXPECT_EQ(bytes(), first);
}

TEST_F(TileDocument, ACityWithoutTilesHasNone) {
  write(editing::make_city({}, {}));
  EXPECT_FALSE(read_city(file_, {}).city.tiles());
}

TEST_F(TileDocument, WhatIsNoLayoutIsRefusedWithLayerAndFeature) {
  const auto expect_refused = [&](const std::string& message, const auto& spoil) {
    TileLayout spoilt = layout();
    spoil(spoilt);
    EXPECT_NE(refusal(spoilt).find(message), std::string::npos) << message << "\n"
                                                                << refusal(spoilt);
  };
  expect_refused("tiles: feature 2: its tile id comes twice",
                 [](TileLayout& made) { made.tiles[1].id = made.tiles[0].id; });
  expect_refused("tiles: feature 3: tile must be below 9",
                 [](TileLayout& made) { made.next_id = 9; });
  expect_refused("tiles: feature 2: its placement has the determinant -0.2",
                 [](TileLayout& made) { made.tiles[1].placement.yy = -0.7; });
  expect_refused("tiles: feature 3: its placement has the determinant 0,",
                 [](TileLayout& made) { made.tiles[2].placement = {1.0, 2.0, 1.0, 2.0, {}}; });
  expect_refused("tiles: no tile, and 10 features in tile_vertices", [](TileLayout& made) {
    made.tiles.clear();
    made.links.clear();
  });
}

TEST_F(TileDocument, TilesWithoutAnOutlineAreRefused) {
  for (const std::string_view corners :
       {"[]", "[[]]", "[[[0, 0, 0]]]", "[[[0, 0, 0], [1, 0, 9]]]",
        "[[[0, 0, 0], [2, 9, 0], [3, 9, 9]], []]", "[[[0, 0, 0], [2, 9, 0], [10, 9, 9]]]"}) {
    std::vector<geodata::Layer> layers =
        city_layers(editing::make_city_of_tiles({}, layout(), {}), testing::utm_frame());
    const auto tiles = std::ranges::find(layers, "tiles", &geodata::Layer::name);
    tiles->features[1].attributes.back() = std::string(corners);
    geodata::write_layers(file_, layers);
    EXPECT_NE(refusal().find("tiles: feature 2: corners: "), std::string::npos) << corners;
  }
}

TEST_F(TileDocument, TilesThatAreNoLandAreRefusedByName) {
  TileLayout inside_out = layout();
  std::ranges::reverse(inside_out.tiles[1].rings[0]);
  EXPECT_NE(refusal(inside_out).find("tiles: tile 3 ("), std::string::npos);
  TileLayout overlapping = layout();
  overlapping.vertices[6].at.x = overlapping.vertices[7].at.x = 30.0;
  EXPECT_NE(refusal(overlapping).find(") overlaps tile 9 ("), std::string::npos);
  TileLayout shared = layout();
  shared.tiles[1].block = 1;
  EXPECT_NE(refusal(shared).find("tiles: vertex 2 is of blocks 0 and 1"), std::string::npos);
}

TEST_F(TileDocument, ACityWhoseTilesAreAllGoneIsReadBack) {
  TileLayout none;
  none.next_id = 12;
  write(editing::make_city_of_tiles({}, none, {}));
  const PlacedCity again = read_city(file_, {});
  ASSERT_TRUE(again.city.tiles());
  EXPECT_EQ(*again.city.tiles(), none);
}

/// Tiles of one row that share edges, 10 m wide; those from `first` on were observed `by` away.
TileLayout row(std::size_t count, std::size_t first, std::size_t last, Point by) {
  TileLayout out;
  for (std::size_t i = 0; i <= count; ++i) {
    out.vertices.push_back({{10.0 * static_cast<double>(i), 0.0}, true});
    out.vertices.push_back({{10.0 * static_cast<double>(i), 20.0}, true});
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Point shift = i >= first && i < last ? by : Point{};
    tiles::Tile tile;
    tile.id = {static_cast<std::uint32_t>(i)};
    tile.placement = Affine::translation(-shift);
    auto& ring = tile.rings.emplace_back();
    const auto v = static_cast<std::uint32_t>(2 * i);
    for (const std::uint32_t corner : {v, v + 2, v + 3, v + 1})
      ring.push_back({corner, out.vertices[corner].at + shift});
    out.tiles.push_back(std::move(tile));
  }
  out.next_id = static_cast<std::uint32_t>(count);
  return out;
}

TEST(TileImagery, KnowsTilesThatCameFromElsewhere) {
  EXPECT_EQ(tiles_from_elsewhere(row(5, 5, 5, {})), std::vector<bool>(5, false));
  const std::vector<bool> expected{false, false, false, true, true, false, false, false};
  EXPECT_EQ(tiles_from_elsewhere(row(8, 3, 5, {300.0, 100.0})), expected);
}

/// A row of three tiles, and one across a street that is linked to its first one.
TileLayout row_and_one(Point rest_in_row, Point rest_across) {
  TileLayout out = row(3, 3, 3, {});
  TileLayout one = row(1, 1, 1, {});
  for (tiles::LayoutVertex& vertex : one.vertices) {
    vertex.at = vertex.at + Point{0.0, 30.0};
    out.vertices.push_back(vertex);
  }
  tiles::Tile tile = one.tiles.front();
  tile.id = {3};
  tile.block = 1;
  for (tiles::Corner& corner : tile.rings[0])
    corner = {corner.vertex + 8, corner.rest + Point{0.0, 30.0}};
  out.tiles.push_back(std::move(tile));
  out.next_id = 4;
  out.links.push_back({0, rest_in_row, 3, rest_across, 10.0});
  return out;
}

TEST(TileImagery, LinksOfAClosedCutBringNothingFromElsewhere) {
  const TileLayout closed = row_and_one({5.0, 45.0}, {5.0, 25.0});
  EXPECT_EQ(tiles_from_elsewhere(closed), std::vector<bool>(4, false));
}

TEST(TileImagery, ATileThatShowsAnothersLandIsACopy) {
  TileLayout copied = row_and_one({5.0, 25.0}, {25.0, 25.0});
  tiles::Tile& copy = copied.tiles[3];
  copied.tiles[2].source_id = copy.source_id = "lot 2";
  copy.placement = Affine::translation({-20.0, 30.0});
  for (tiles::Corner& corner : copy.rings[0]) corner.rest = corner.rest + Point{20.0, -30.0};
  EXPECT_EQ(tiles_from_elsewhere(copied), (std::vector<bool>{false, false, false, true}));
}

TEST(TileImagery, TilesFromElsewhereDoNotPullTheGround) {
  const auto still = ground_at_rest(row(8, 3, 5, {300.0, 100.0}));
  EXPECT_EQ(still({40.0, 25.0}), Point(40.0, 25.0));
  // Where all have moved, the ground has.
  const auto moved = ground_at_rest(row(6, 0, 6, {3.0, 4.0}));
  EXPECT_LT(distance(moved({30.0, 25.0}), {33.0, 29.0}), 1e-9);
}

TEST(TileImagery, ATileShowsItsOwnPieceAndCutLandNone) {
  TileLayout made = row(3, 1, 2, {300.0, 100.0});
  made.tiles[2].zone = tiles::kVacantZone;
  const auto pieces = carried_tiles(made);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(std::get<Affine>(pieces[0].shows), Affine{});
  EXPECT_EQ(std::get<Affine>(pieces[1].shows), Affine::translation({300.0, 100.0}));
  EXPECT_TRUE(std::holds_alternative<geodata::Colour>(pieces[2].shows));
}

}  // namespace
}  // namespace plat::harness
