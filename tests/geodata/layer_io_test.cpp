#include "geodata/layer_io.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/failure.h"
#include "core/working_grid.h"
#include "geodata/scratch_folder.h"

namespace plat::geodata {
namespace {

using ::plat::testing::bytes_of;
using ::plat::testing::ScratchFolder;
using ::testing::HasSubstr;

constexpr std::string_view kUtm10 =
    R"w(PROJCRS["WGS 84 / UTM zone 10N",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",)w"
    R"w(ELLIPSOID["WGS 84",6378137,298.257223563,LENGTHUNIT["metre",1]]],)w"
    R"w(PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]],ID["EPSG",4326]],)w"
    R"w(CONVERSION["UTM zone 10N",METHOD["Transverse Mercator",ID["EPSG",9807]],)w"
    R"w(PARAMETER["Latitude of natural origin",0,ANGLEUNIT["degree",0.0174532925199433]],)w"
    R"w(PARAMETER["Longitude of natural origin",-123,ANGLEUNIT["degree",0.0174532925199433]],)w"
    R"w(PARAMETER["Scale factor at natural origin",0.9996,SCALEUNIT["unity",1]],)w"
    R"w(PARAMETER["False easting",500000,LENGTHUNIT["metre",1]],)w"
    R"w(PARAMETER["False northing",0,LENGTHUNIT["metre",1]]],CS[Cartesian,2],)w"
    R"w(AXIS["(E)",east,ORDER[1],LENGTHUNIT["metre",1]],)w"
    R"w(AXIS["(N)",north,ORDER[2],LENGTHUNIT["metre",1]],ID["EPSG",32610]])w";

const Polygon kSquare{{{0, 0}, {30, 0}, {30, 20}, {0, 20}}, {}};
const Polygon kHoled{{{100, 0}, {150, 0}, {150, 50}, {100, 50}},
                     {{{110, 10}, {110, 20}, {120, 20}, {120, 10}}}};

/// Two layers with every kind of field, an absent value, a multi-polygon and a feature without
/// parts.
std::vector<Layer> sample() {
  const LocalFrame frame{std::string(kUtm10), {548000.0, 4180000.0}};
  Layer parcels{
      "parcels",
      GeometryKind::kPolygon,
      frame,
      {{"count", FieldType::kInteger}, {"area", FieldType::kReal}, {"name", FieldType::kText}},
      {}};
  const double x = from_grid(123457);  // a point of the working grid
  parcels.features.push_back({"3", {kSquare}, {}, {}, {std::int64_t{7}, 1.5, "Haight \"A\""}});
  parcels.features.push_back(
      {"5", {kHoled, {{{x, x}, {x + 1, x}, {x, x + 1}}, {}}}, {}, {}, {std::monostate{}, 2.5, ""}});
  parcels.features.push_back(
      {"9", {}, {}, {}, {std::int64_t{1}, std::monostate{}, std::monostate{}}});
  Layer streets{"streets", GeometryKind::kLine, frame, {}, {}};
  streets.features.push_back({"1", {}, {{{0, 0}, {100.25, 3.5}}}, {}, {}});
  return {parcels, streets};
}

std::string error_of(const std::string& source, const ReadOptions& options = {}) {
  try {
    read_layer(parse_layer_source(source), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string geojson(const std::string& features) {
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}
const std::string kPointFeature =
    R"({"type":"Feature","properties":{"a":1},"geometry":{"type":"Point","coordinates":[4.5,52]}})";

/// A CSV has no CRS of its own: a virtual layer gives it one.
std::string with_crs(const ScratchFolder& folder, const std::string& csv) {
  return folder.write("a.vrt", "<OGRVRTDataSource><OGRVRTLayer name='a'><SrcDataSource>" +
                                   folder.write("a.csv", csv) +
                                   "</SrcDataSource><LayerSRS>EPSG:4326</LayerSRS>"
                                   "</OGRVRTLayer></OGRVRTDataSource>");
}

TEST(LayerSource, LastColonSeparatesTheLayer) {
  EXPECT_EQ(parse_layer_source("a.gpkg"), (LayerSource{"a.gpkg", std::nullopt}));
  EXPECT_EQ(parse_layer_source("a.gpkg:streets"), (LayerSource{"a.gpkg", "streets"}));
  EXPECT_EQ(parse_layer_source("/vsicurl/https://x/a.gpkg"),
            (LayerSource{"/vsicurl/https://x/a.gpkg", std::nullopt}));
  EXPECT_EQ(to_string(parse_layer_source("a.gpkg:streets")), "a.gpkg:streets");
}

TEST(LayerSource, AnExistingFileWithAColonWins) {
  const ScratchFolder folder;
  const std::string path = folder.write("a:b.geojson", geojson(kPointFeature));
  EXPECT_EQ(parse_layer_source(path), (LayerSource{path, std::nullopt}));
  EXPECT_EQ(parse_layer_source(path + ":a"), (LayerSource{path, "a"}));
}

TEST(WriteLayers, GeoPackageReadsBackTheSame) {
  const ScratchFolder folder;
  const std::vector<Layer> layers = sample();
  write_layers(folder.file("a.gpkg"), layers);
  for (const Layer& written : layers) {
    const Layer read = read_layer({folder.file("a.gpkg"), written.name}, {.frame = written.frame});
    EXPECT_EQ(read.kind, written.kind);
    EXPECT_EQ(read.frame, written.frame);
    ASSERT_EQ(read.features.size(), written.features.size());
    for (std::size_t i = 0; i < read.features.size(); ++i) {
      EXPECT_EQ(read.features[i].id, written.features[i].id);
      EXPECT_EQ(read.features[i].polygons, written.features[i].polygons);
      EXPECT_EQ(read.features[i].lines, written.features[i].lines);
      EXPECT_EQ(read.features[i].attributes, written.features[i].attributes);
    }
    ASSERT_EQ(read.fields.size(), written.fields.size());
    for (std::size_t i = 0; i < read.fields.size(); ++i) {
      EXPECT_EQ(read.fields[i].name, written.fields[i].name);
      EXPECT_EQ(read.fields[i].type, written.fields[i].type);
    }
  }
}

TEST(WriteLayers, ChoosesTheFrameOfAProjectedFileFromItsCentre) {
  const ScratchFolder folder;
  write_layers(folder.file("a.gpkg"), sample());
  const Layer read = read_layer({folder.file("a.gpkg"), "streets"});
  EXPECT_THAT(read.frame.crs_wkt, HasSubstr("UTM zone 10N"));
  EXPECT_EQ(read.frame.origin, (Point{548000.0, 4180000.0}));
}

TEST(WriteLayers, CrsIsKnownByItsCode) {
  const ScratchFolder folder;
  write_layers(folder.file("a.gpkg"), sample());
  EXPECT_THAT(bytes_of(folder.file("a.gpkg")), HasSubstr("32610"));
  const std::vector<LayerInfo> layers = list_layers(folder.file("a.gpkg"));
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_EQ(layers[0].crs_name, "WGS 84 / UTM zone 10N");
  EXPECT_EQ(layers[0].kind, GeometryKind::kPolygon);
  EXPECT_EQ(layers[0].feature_count, 3);
  EXPECT_EQ(layers[1].kind, GeometryKind::kLine);
}

TEST(WriteLayers, SameLayersGiveTheSameBytes) {
  const ScratchFolder folder;
  write_layers(folder.file("a.gpkg"), sample());
  write_layers(folder.file("b.gpkg"), sample());
  write_layers(folder.file("b.gpkg"), sample());  // also over an old file
  EXPECT_EQ(bytes_of(folder.file("a.gpkg")), bytes_of(folder.file("b.gpkg")));
  EXPECT_GT(bytes_of(folder.file("a.gpkg")).size(), 1000U);
}

TEST(WriteLayers, GeoJsonIsLongitudeAndLatitude) {
  const ScratchFolder folder;
  const std::vector<Layer> layers{sample()[0]};
  write_layers(folder.file("a.geojson"), layers);
  const std::string text = bytes_of(folder.file("a.geojson"));
  EXPECT_THAT(text, HasSubstr("-122.45"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("\"crs\"")));
  const Layer read =
      read_layer({folder.file("a.geojson"), std::nullopt}, {.frame = layers[0].frame});
  ASSERT_EQ(read.features.size(), 3U);
  EXPECT_EQ(read.features[0].id, "3");
  const Ring& ring = read.features[0].polygons.at(0).outer;
  ASSERT_EQ(ring.size(), 4U);
  for (const Point p : kSquare.outer) {
    double nearest = 1e9;
    for (const Point q : ring) nearest = std::min(nearest, distance(p, q));
    EXPECT_LT(nearest, 0.001);
  }
  EXPECT_NEAR(area_m2(read.features[1].polygons.at(0)), area_m2(kHoled), 0.05);
}

TEST(WriteLayers, RefusesWhatItCannotWrite) {
  const ScratchFolder folder;
  EXPECT_THROW(write_layers(folder.file("a.shp"), sample()), InputError);
  EXPECT_THROW(write_layers(folder.file("a.geojson"), sample()), InputError);
  EXPECT_THROW(write_layers(folder.file("none/a.gpkg"), sample()), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(std::filesystem::path(folder.file("a")).parent_path()));
}

TEST(WriteLayers, AFailedWriteLeavesTheOldFile) {
  const ScratchFolder folder;
  write_layers(folder.file("a.gpkg"), sample());
  const std::string before = bytes_of(folder.file("a.gpkg"));
  std::vector<Layer> twice = sample();
  twice[1].name = twice[0].name;
  EXPECT_THROW(write_layers(folder.file("a.gpkg"), twice), InputError);
  EXPECT_EQ(bytes_of(folder.file("a.gpkg")), before);
}

TEST(ReadLayer, DegreesGoToTheUtmZoneOfTheirCentre) {
  const ScratchFolder folder;
  const Layer read = read_layer({folder.write("a.geojson", geojson(kPointFeature)), std::nullopt});
  EXPECT_THAT(read.frame.crs_wkt, HasSubstr("UTM zone 31N"));
  EXPECT_EQ(std::fmod(read.frame.origin.x, 1000.0), 0.0);
  EXPECT_LT(length(read.features[0].points.at(0)), 1000.0);
  EXPECT_EQ(read.features[0].attributes.at(0), Attribute(std::int64_t{1}));
}

TEST(ReadLayer, TakesTheFieldsAskedForInTheirOrder) {
  const ScratchFolder folder;
  write_layers(folder.file("a.gpkg"), sample());
  const Layer read = read_layer({folder.file("a.gpkg"), "parcels"}, {.fields = {"name", "count"}});
  ASSERT_EQ(read.fields.size(), 2U);
  EXPECT_EQ(read.features[0].attributes, (std::vector<Attribute>{"Haight \"A\"", std::int64_t{7}}));
}

TEST(ReadLayer, FiltersByACondition) {
  const ScratchFolder folder;
  write_layers(folder.file("a.gpkg"), sample());
  const std::string source = folder.file("a.gpkg") + ":parcels";
  EXPECT_EQ(read_layer(parse_layer_source(source), {.where = "area > 2"}).features.size(), 1U);
  EXPECT_THAT(error_of(source, {.where = "area > 99"}), HasSubstr("no feature meets"));
  EXPECT_THAT(error_of(source, {.where = "aera > 2"}), HasSubstr("bad condition"));
}

TEST(ReadLayer, AFeatureOfAnotherKindIsKeptWithoutParts) {
  const ScratchFolder folder;
  const std::string line =
      R"({"type":"Feature","properties":{"a":2},"geometry":{"type":"LineString","coordinates":[[4.5,52],[4.6,52]]}})";
  const std::string path = folder.write("a.geojson", geojson(kPointFeature + "," + line));
  const Layer read = read_layer({path, std::nullopt}, {.kind = GeometryKind::kLine});
  ASSERT_EQ(read.features.size(), 2U);
  EXPECT_TRUE(read.features[0].lines.empty());
  EXPECT_TRUE(read.features[0].points.empty());
  EXPECT_EQ(read.features[1].lines.size(), 1U);
}

TEST(ReadLayer, CollectionsAndCurvesAreTakenApart) {
  const ScratchFolder folder;
  const std::string path = with_crs(
      folder,
      "WKT,n\n"
      "\"CURVEPOLYGON (CIRCULARSTRING (4.5 52,4.501 52.001,4.502 52,4.501 51.999,4.5 52))\",1\n"
      "\"GEOMETRYCOLLECTION Z (POINT Z (4.5 52 7),POLYGON Z ((4.5 52 1,4.501 52 1,4.501 "
      "52.001 1,4.5 52 1)))\",2\n");
  const Layer read = read_layer({path}, {.kind = GeometryKind::kPolygon});
  ASSERT_EQ(read.features.size(), 2U);
  EXPECT_GT(read.features[0].polygons.at(0).outer.size(), 50U);
  EXPECT_GT(signed_area_m2(read.features[0].polygons.at(0).outer), 0.0);
  EXPECT_EQ(read.features[1].polygons.at(0).outer.size(), 3U);
}

TEST(ReadLayer, WhatIsNotFiniteBecomesNaNAndTheFeatureStays) {
  const ScratchFolder folder;
  const std::string path = with_crs(
      folder, "WKT,n\n\"LINESTRING (4.5 52,4.6 52)\",1\n\"LINESTRING (1e999 52,4.6 52)\",2\n");
  const Layer read = read_layer({path});
  ASSERT_EQ(read.features.size(), 2U);
  EXPECT_TRUE(std::isnan(read.features[1].lines.at(0).at(0).x));
  EXPECT_EQ(read.features[0].lines.at(0).at(1), read.features[1].lines.at(0).at(1));
}

TEST(WriteLayers, AFeatureThatIsNotFiniteIsWrittenWithoutGeometry) {
  const ScratchFolder folder;
  std::vector<Layer> layers{sample()[1]};
  layers[0].features.push_back(
      {"2", {}, {{{std::numeric_limits<double>::quiet_NaN(), 0}, {1, 1}}}, {}, {}});
  write_layers(folder.file("a.gpkg"), layers);
  const Layer read = read_layer({folder.file("a.gpkg")});
  ASSERT_EQ(read.features.size(), 2U);
  EXPECT_EQ(read.features[1].id, "2");
  EXPECT_TRUE(read.features[1].lines.empty());
}

TEST(ReadLayer, SaysWhatIsWrongWithTheInputInOneLine) {
  const ScratchFolder folder;
  write_layers(folder.file("a.gpkg"), sample());
  const std::string gpkg = folder.file("a.gpkg");
  const std::string text = folder.write("a.txt", "not geodata");
  const std::string empty = folder.write("empty.geojson", geojson(""));
  const std::string no_crs = folder.write("n.csv", "WKT,n\n\"POINT (4.5 52)\",1\n");
  const std::string broken = folder.write("b.geojson", geojson(kPointFeature).substr(0, 60));
  const std::vector<std::pair<std::string, std::string>> cases{
      {error_of(folder.file("none.gpkg")), "no such file"},
      {error_of(text), "not a vector file"},
      {error_of(broken), "b.geojson"},
      {error_of(gpkg), "several layers (parcels, streets)"},
      {error_of(gpkg + ":parcel"), "did you mean \"parcels\"?"},
      {error_of(gpkg + ":parcel"), "there are: parcels, streets"},
      {error_of(gpkg + ":streets", {.kind = GeometryKind::kPolygon}), "wrong geometry type"},
      {error_of(gpkg + ":parcels", {.fields = {"nam"}}), "did you mean \"name\"?"},
      {error_of(empty), "the layer is empty"},
      {error_of(no_crs), "ogr2ogr -a_srs"},
  };
  for (const auto& [message, part] : cases) {
    EXPECT_THAT(message, HasSubstr(part));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace plat::geodata
