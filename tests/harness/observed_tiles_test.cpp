#include "harness/observed_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include "support/data_folder.h"
#include "tiles/layout_defects.h"
#include "tiles/settling.h"
#include "tiles/tile_graph.h"

namespace plat::harness {
namespace {

/// The share of tiles in the largest part that joints and links hold together.
double connected_share(const tiles::TileLayout& layout) {
  std::vector<std::uint32_t> part(layout.tiles.size());
  std::iota(part.begin(), part.end(), 0U);
  const auto root = [&](std::uint32_t t) {
    while (part[t] != t) t = part[t] = part[part[t]];
    return t;
  };
  for (const tiles::Joint& joint : tiles::graph_of(layout).joints)
    part[root(joint.a)] = root(joint.b);
  std::map<std::uint32_t, double> size;
  for (std::uint32_t t = 0; t < part.size(); ++t) size[root(t)] += 1.0;
  double largest = 0.0;
  for (const auto& [r, n] : size) largest = std::max(largest, n);
  return largest / static_cast<double>(part.size());
}

void expect_good(const ObservedTiles& place, std::size_t tiles_min, double connected_min) {
  const tiles::TileLayout& layout = place.tiles.layout;
  EXPECT_GE(layout.tiles.size(), tiles_min);
  const auto defect = tiles::find_layout_defect(layout);
  EXPECT_EQ(defect, std::nullopt) << defect->message;
  EXPECT_GE(connected_share(layout), connected_min);
  // Placed where they were, tiles settle to what was observed, up to the matching.
  EXPECT_EQ(tiles::settled(layout), layout);
  std::size_t exact = 0;
  for (const double bent : tiles::closing_residuals_m(layout)) {
    EXPECT_LE(bent, tiles::ConstructionOptions{}.matching_m);
    exact += bent < 1e-3 ? 1 : 0;
  }
  EXPECT_GT(exact, layout.tiles.size() * 8 / 10);
}

TEST(ObservedTiles, OfCambridge) {
  PLAT_REAL_DATA_OR_SKIP(path, "cambridge_ma/cambridge_ma.gpkg");
  const ObservedTiles place = load_tiles(geodata::dataset("cambridge_ma"));
  expect_good(place, 13050, 0.999);
  // Every piece is a tile or a row; the other rows are parcels that blocks refused.
  EXPECT_LE(place.pieces.size(), place.tiles.layout.tiles.size() + place.tiles.failures.size());
  EXPECT_LT(place.tiles.failures.size(), 30U);
  const auto parks = std::ranges::count(place.tiles.layout.tiles, "park", &tiles::Tile::zone);
  EXPECT_GT(parks, 100);
}

TEST(ObservedTiles, OfSanRomanHaveTheUseOfTheirBuildings) {
  PLAT_REAL_DATA_OR_SKIP(path, "san_roman_es/san_roman_es.gpkg");
  const ObservedTiles place = load_tiles(geodata::dataset("san_roman_es"));
  expect_good(place, 3750, 0.99);  // 3732 without finer matching
  std::map<std::string, int> zones;
  for (const tiles::Tile& tile : place.tiles.layout.tiles) ++zones[tile.zone];
  EXPECT_GT(zones["residential"], 1900);
  EXPECT_GT(zones["industrial"], 80);
  EXPECT_EQ(zones.count("park"), 0U);
}

TEST(ObservedTiles, OfPrague) {
  PLAT_REAL_DATA_OR_SKIP(path, "prague_bubenec_cz/prague_bubenec_cz.gpkg");
  expect_good(load_tiles(geodata::dataset("prague_bubenec_cz")), 400, 1.0);
}

TEST(ObservedTiles, OfCampoGrandeAreBlocks) {
  PLAT_REAL_DATA_OR_SKIP(path, "campo_grande_br/campo-grande.osm.gz");
  const ObservedTiles place = load_tiles(geodata::dataset("campo_grande_br"), {.count = 1000});
  expect_good(place, 990, 0.95);  // 963 of 1000 when written
  EXPECT_EQ(counts_of(place.tiles.layout, place.network).boundaries, 0U);
}

TEST(ObservedTiles, NearestPiecesKeepTheirOrder) {
  std::vector<tiles::TilePiece> pieces;
  for (int i = 0; i < 5; ++i) {
    const double x = 10.0 * i;
    pieces.push_back({std::to_string(i), "", 0, {{{x, 0}, {x + 9, 0}, {x + 9, 9}, {x, 9}}, {}}});
  }
  const auto near = nearest_pieces(pieces, {30, 4}, 2);
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0].source_id, "2");
  EXPECT_EQ(near[1].source_id, "3");
}

}  // namespace
}  // namespace plat::harness
