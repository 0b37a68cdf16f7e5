#include <gtest/gtest.h>

#include <algorithm>

#include "geodata/layer_io.h"
#include "geodata/scratch_folder.h"
#include "support/data_folder.h"

namespace plat::geodata {
namespace {

std::ptrdiff_t count_set(const Layer& layer, std::size_t field) {
  return std::count_if(layer.features.begin(), layer.features.end(), [&](const Feature& f) {
    return std::holds_alternative<std::string>(f.attributes[field]);
  });
}

const ReadOptions kRoads{.frame = std::nullopt,
                         .fields = {"highway", "lanes", "bridge"},
                         .kind = GeometryKind::kLine,
                         .where = "highway IS NOT NULL"};

TEST(RealLayers, OsmPbfRoadsWithTagsBeyondTheColumns) {
  PLAT_REAL_DATA_OR_SKIP(path, "porto_alegre_br/poa_osm.pbf");
  const Layer roads = read_layer({path, "lines"}, kRoads);
  EXPECT_GT(roads.features.size(), 10000U);
  EXPECT_NE(roads.frame.crs_wkt.find("UTM zone 22S"), std::string::npos);
  EXPECT_EQ(count_set(roads, 0), std::ssize(roads.features));
  EXPECT_GT(count_set(roads, 1), 100);
  EXPECT_GT(count_set(roads, 2), 10);
}

TEST(RealLayers, CompressedOsmRoads) {
  PLAT_REAL_DATA_OR_SKIP(path, "campo_grande_br/campo-grande.osm.gz");
  const Layer roads = read_layer({path, "lines"}, kRoads);
  EXPECT_GT(roads.features.size(), 3500U);
  EXPECT_NE(roads.frame.crs_wkt.find("UTM zone 21S"), std::string::npos);
}

TEST(RealLayers, CambridgeKeepsItsStatePlane) {
  PLAT_REAL_DATA_OR_SKIP(path, "cambridge_ma/cambridge_ma.gpkg");
  const Layer parcels = read_layer({path, "parcels"}, {.kind = GeometryKind::kPolygon});
  EXPECT_EQ(parcels.features.size(), 13103U);
  EXPECT_NE(parcels.frame.crs_wkt.find("26986"), std::string::npos);
  for (const Feature& feature : parcels.features) {
    for (const Polygon& polygon : feature.polygons) ASSERT_GT(signed_area_m2(polygon.outer), 0.0);
  }
}

TEST(RealLayers, SurviveAWriteToTheLastBit) {
  PLAT_REAL_DATA_OR_SKIP(path, "san_francisco_us/san_francisco_us.gpkg");
  const testing::ScratchFolder folder;
  std::vector<Layer> layers{read_layer({path, "building"})};
  layers.push_back(
      read_layer({path, "road"}, {.frame = layers[0].frame, .kind = GeometryKind::kLine}));
  write_layers(folder.file("a.gpkg"), layers);
  for (const Layer& layer : layers) {
    const Layer again = read_layer({folder.file("a.gpkg"), layer.name}, {.frame = layer.frame});
    ASSERT_EQ(again.features.size(), layer.features.size());
    for (std::size_t i = 0; i < layer.features.size(); ++i) {
      ASSERT_EQ(again.features[i].polygons, layer.features[i].polygons);
      ASSERT_EQ(again.features[i].lines, layer.features[i].lines);
    }
  }
}

}  // namespace
}  // namespace plat::geodata
