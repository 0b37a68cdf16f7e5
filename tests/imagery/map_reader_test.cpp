#include "imagery/map_reader.h"

#include <gmock/gmock.h>

#include <vector>

#include "core/failure.h"
#include "geodata/scratch_folder.h"

namespace plat::imagery {
namespace {

using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;
using ::testing::HasSubstr;
using testing::ScratchFolder;

constexpr const char* kCrs =
    R"w(PROJCRS["WGS 84 / UTM zone 33N",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",)w"
    R"w(ELLIPSOID["WGS 84",6378137,298.257223563,LENGTHUNIT["metre",1]]],)w"
    R"w(PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]],ID["EPSG",4326]],)w"
    R"w(CONVERSION["UTM zone 33N",METHOD["Transverse Mercator",ID["EPSG",9807]],)w"
    R"w(PARAMETER["Latitude of natural origin",0,ANGLEUNIT["degree",0.0174532925199433]],)w"
    R"w(PARAMETER["Longitude of natural origin",15,ANGLEUNIT["degree",0.0174532925199433]],)w"
    R"w(PARAMETER["Scale factor at natural origin",0.9996,SCALEUNIT["unity",1]],)w"
    R"w(PARAMETER["False easting",500000,LENGTHUNIT["metre",1]],)w"
    R"w(PARAMETER["False northing",0,LENGTHUNIT["metre",1]]],CS[Cartesian,2],)w"
    R"w(AXIS["(E)",east,ORDER[1],LENGTHUNIT["metre",1]],)w"
    R"w(AXIS["(N)",north,ORDER[2],LENGTHUNIT["metre",1]],ID["EPSG",32633]])w";

Layer polygons(const std::string& name, std::vector<geodata::FieldSchema> fields,
               std::vector<std::vector<geodata::Attribute>> rows) {
  Layer layer{name, GeometryKind::kPolygon, {kCrs, {458000, 5550000}}, std::move(fields), {}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double x = 20.0 * static_cast<double>(i);
    Feature feature;
    feature.id = std::to_string(i + 1);
    feature.polygons.push_back({{{x, 0}, {x + 10, 0}, {x + 10, 10}, {x, 10}}, {}});
    feature.attributes = rows[i];
    layer.features.push_back(feature);
  }
  return layer;
}

TEST(ReadMap, TakesHeightsFromTheFieldThenFromStoreysThenAssumesThem) {
  const ScratchFolder folder;
  const std::string city = folder.file("city.gpkg");
  geodata::write_layers(
      city, std::vector{polygons("buildings",
                                 {{"height", FieldType::kReal}, {"floors", FieldType::kInteger}},
                                 {{17.5, std::int64_t{2}},
                                  {std::monostate{}, std::int64_t{4}},
                                  {0.0, std::monostate{}}})});
  const MapLayers map = read_map(map_sources_in(city));
  ASSERT_EQ(map.footprints.size(), 3U);
  EXPECT_EQ(map.footprints[0].height_m, 17.5);
  EXPECT_EQ(map.footprints[0].height_source, HeightSource::kAttribute);
  EXPECT_EQ(map.footprints[1].height_m, 12.0);
  EXPECT_EQ(map.footprints[1].height_source, HeightSource::kStoreys);
  EXPECT_EQ(map.footprints[2].height_source, HeightSource::kAssumed);
}

TEST(ReadMap, FindsTheLayersOfACity) {
  const ScratchFolder folder;
  const std::string city = folder.file("city.gpkg");
  geodata::write_layers(city,
                        std::vector{polygons("parcels", {}, {{}, {}}), polygons("water", {}, {{}}),
                                    polygons("notes", {}, {{}})});
  const MapSources sources = map_sources_in(city);
  EXPECT_TRUE(sources.parcels && sources.water);
  EXPECT_FALSE(sources.streets || sources.footprints || sources.open_space);
  const MapLayers map = read_map(sources);
  EXPECT_EQ(map.parcels.size(), 2U);
  EXPECT_EQ(map.water.size(), 1U);
}

TEST(ReadMap, RefusesWhatHasNothingToRender) {
  const ScratchFolder folder;
  const std::string city = folder.file("city.gpkg");
  geodata::write_layers(city, std::vector{polygons("notes", {}, {{}})});
  try {
    (void)map_sources_in(city);
    FAIL() << "no layer of a map";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no layer named streets, parcels or footprints"));
  }
  EXPECT_THROW((void)read_map({}), InputError);
  MapSources sources;
  sources.footprints = {city, "notes"};
  sources.height_field = "hight";
  EXPECT_THROW((void)read_map(sources), InputError);
}

}  // namespace
}  // namespace plat::imagery
