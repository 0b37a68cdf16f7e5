#include "geodata/tile_merge.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <memory>

#include "core/failure.h"
#include "geodata/scratch_folder.h"

namespace plat::geodata {
namespace {

constexpr double kHalfWorld_m = 20037508.342789244;
constexpr int kZoom = 15;
constexpr int kColumn = 5237;
constexpr int kRow = 12666;

double tile_size_m() { return 2.0 * kHalfWorld_m / std::exp2(kZoom); }

/// Coordinates in tile units of 1/4096, from the tiles' common border and the row's upper edge.
std::string at(double right, double down) {
  const double unit = tile_size_m() / 4096.0;
  return fmt::format("{:.9f} {:.9f}", -kHalfWorld_m + (kColumn + 1) * tile_size_m() + right * unit,
                     kHalfWorld_m - kRow * tile_size_m() - down * unit);
}

std::string rectangle(double left, double right, double top, double bottom) {
  return fmt::format("POLYGON (({},{},{},{},{}))", at(left, top), at(right, top), at(right, bottom),
                     at(left, bottom), at(left, top));
}

/// Two neighbouring tiles as a tile server makes them, each with a buffer around its box.
std::vector<std::string> write_tiles(const testing::ScratchFolder& folder) {
  GDALAllRegister();
  const char* const options[] = {
      "FORMAT=DIRECTORY", "MINZOOM=15",       "MAXZOOM=15", "TILE_EXTENSION=mvt",
      "COMPRESS=NO",      "SIMPLIFICATION=0", nullptr};
  const std::string root = folder.file("tiles");
  GDALDatasetUniquePtr out(GetGDALDriverManager()->GetDriverByName("MVT")->Create(
      root.c_str(), 0, 0, 0, GDT_Unknown, const_cast<char**>(options)));
  OGRSpatialReference mercator;
  mercator.importFromEPSG(3857);
  const auto add = [&](const char* name, const std::vector<std::pair<std::string, int>>& rows) {
    OGRLayer* layer = out->CreateLayer(name, &mercator, wkbUnknown, nullptr);
    OGRFieldDefn height("height", OFTInteger);
    layer->CreateField(&height);
    for (const auto& [wkt, value] : rows) {
      OGRFeature row(layer->GetLayerDefn());
      OGRGeometry* geometry = nullptr;
      OGRGeometryFactory::createFromWkt(wkt.c_str(), &mercator, &geometry);
      row.SetGeometryDirectly(geometry);
      row.SetField("height", value);
      ASSERT_EQ(layer->CreateFeature(&row), OGRERR_NONE);
    }
  };
  add("building", {{rectangle(-100, 200, 1000, 1300), 8},   // cut by the border
                   {rectangle(-900, -600, 1000, 1300), 8},  // left
                   {rectangle(-300, 0, 2000, 2300), 5},     // on the border, and its neighbour
                   {rectangle(0, 300, 2000, 2300), 9}});    // of another height
  add("road", {{fmt::format("LINESTRING ({},{})", at(-800, 500), at(900, 700)), 1}});
  out.reset();
  std::vector<std::string> files;
  for (int i = 0; i < 2; ++i) {
    files.push_back(folder.file(fmt::format("{}-{}-{}.mvt", kZoom, kColumn + i, kRow)));
    std::filesystem::copy(fmt::format("{}/{}/{}/{}.mvt", root, kZoom, kColumn + i, kRow),
                          files.back());
  }
  return files;
}

TEST(TileMerge, APolygonCutByTheBorderIsWholeAgain) {
  const testing::ScratchFolder folder;
  const Layer merged = merge_tiles(write_tiles(folder), "building", GeometryKind::kPolygon);
  ASSERT_EQ(merged.features.size(), 4U);
  const double unit = tile_size_m() / 4096.0;
  int whole = 0;
  for (const Feature& feature : merged.features) {
    ASSERT_EQ(feature.polygons.size(), 1U);
    EXPECT_NEAR(area_m2(feature.polygons[0]), 300 * 300 * unit * unit, 2 * 600 * unit * unit);
    const Box box = box_of(feature.polygons[0]);
    const double border = -kHalfWorld_m + (kColumn + 1) * tile_size_m();
    whole += box.min.x < border - unit && box.max.x > border + unit ? 1 : 0;
  }
  EXPECT_EQ(whole, 1);
}

TEST(TileMerge, ALineCutByTheBorderIsOneLine) {
  const testing::ScratchFolder folder;
  const Layer merged = merge_tiles(write_tiles(folder), "road", GeometryKind::kLine);
  ASSERT_EQ(merged.features.size(), 1U);
  ASSERT_EQ(merged.features[0].lines.size(), 1U);
  const double unit = tile_size_m() / 4096.0;
  EXPECT_NEAR(length_m(merged.features[0].lines[0]), std::hypot(1700, 200) * unit, 3 * unit);
}

TEST(TileMerge, RefusesWrongNamesAndLayers) {
  EXPECT_EQ(parse_tile_name("a/15-5237-12665.mvt").row, 12665);
  EXPECT_THROW(parse_tile_name("a/15-5237.mvt"), InputError);
  EXPECT_THROW(parse_tile_name("15-5237-12665.pbf"), InputError);
  const testing::ScratchFolder folder;
  EXPECT_THROW(merge_tiles(write_tiles(folder), "water", GeometryKind::kPolygon), InputError);
}

}  // namespace
}  // namespace plat::geodata
