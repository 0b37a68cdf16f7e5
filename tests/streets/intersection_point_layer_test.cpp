#include "streets/intersection_point_layer.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "core/failure.h"
#include "core/working_grid.h"
#include "geodata/layer_io.h"

namespace plat::streets {
namespace {

using geodata::Layer;

geodata::LocalFrame utm_frame() {
  // Origin in Bohemia, in UTM zone 33 north.
  return {
      R"wkt(PROJCRS["WGS 84 / UTM zone 33N",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",)wkt"
      R"wkt(ELLIPSOID["WGS 84",6378137,298.257223563,LENGTHUNIT["metre",1]]],)wkt"
      R"wkt(PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]],ID["EPSG",4326]],)wkt"
      R"wkt(CONVERSION["UTM zone 33N",METHOD["Transverse Mercator",ID["EPSG",9807]],)wkt"
      R"wkt(PARAMETER["Latitude of natural origin",0,ANGLEUNIT["degree",0.0174532925199433]],)wkt"
      R"wkt(PARAMETER["Longitude of natural origin",15,ANGLEUNIT["degree",0.0174532925199433]],)wkt"
      R"wkt(PARAMETER["Scale factor at natural origin",0.9996,SCALEUNIT["unity",1]],)wkt"
      R"wkt(PARAMETER["False easting",500000,LENGTHUNIT["metre",1]],)wkt"
      R"wkt(PARAMETER["False northing",0,LENGTHUNIT["metre",1]]],CS[Cartesian,2],)wkt"
      R"wkt(AXIS["(E)",east,ORDER[1],LENGTHUNIT["metre",1]],)wkt"
      R"wkt(AXIS["(N)",north,ORDER[2],LENGTHUNIT["metre",1]],ID["EPSG",32633]])wkt",
      {458000.0, 5550000.0}};
}

IntersectionPoint some_point() {
  IntersectionPoint point;
  point.place = {12.5, -7.25};
  point.a = {0, 1.25, 80.0, 100.0, 0.1, 0.01, 22.0, 2};
  point.b = PassingStreet{1, 1.0, 60.0, 90.0, 0.0, 0.0, 12.0, 1};
  point.parcel_area_m2 = 450.0;
  return point;
}

/// The column of a layer, to be overwritten.
geodata::Attribute& value(Layer& layer, std::string_view field) {
  for (std::size_t i = 0; i < layer.fields.size(); ++i) {
    if (layer.fields[i].name == field) return layer.features.at(0).attributes[i];
  }
  throw LogicError("no such field in the test's layer");
}

/// What reading the layer says, or "" where it is read.
std::string refusal(const Layer& layer) {
  try {
    intersection_points_of(layer, "edited.gpkg");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of(std::string_view field, geodata::Attribute attribute) {
  Layer layer = intersection_point_layer(std::vector{some_point()}, {});
  value(layer, field) = std::move(attribute);
  return refusal(layer);
}

double positive(int mantissa, int exponent) {
  return std::ldexp(std::abs(static_cast<double>(mantissa)) / 3.0, exponent);
}

rc::Gen<PassingStreet> any_street() {
  const auto real = rc::gen::map(
      rc::gen::pair(rc::gen::arbitrary<int>(), rc::gen::inRange(-60, 20)),
      [](const std::pair<int, int>& parts) { return positive(parts.first, parts.second); });
  return rc::gen::map(rc::gen::tuple(rc::gen::inRange(0, 12), real, real, real, real, real, real,
                                     rc::gen::inRange(1, 3)),
                      [](const auto& t) {
                        return PassingStreet{std::get<0>(t),
                                             1.0 + std::get<1>(t),
                                             std::get<2>(t),
                                             std::get<3>(t),
                                             std::fmod(std::get<4>(t), std::numbers::pi),
                                             std::get<5>(t),
                                             std::get<6>(t),
                                             std::get<7>(t)};
                      });
}

rc::Gen<IntersectionPoint> any_point() {
  return rc::gen::map(
      rc::gen::tuple(rc::gen::inRange(-20'000'000, 20'000'000),
                     rc::gen::inRange(-20'000'000, 20'000'000), any_street(),
                     rc::gen::maybe(any_street()), rc::gen::maybe(rc::gen::arbitrary<int>())),
      [](const auto& t) {
        IntersectionPoint point{
            {from_grid(std::get<0>(t)), from_grid(std::get<1>(t))}, std::get<2>(t), {}, {}};
        if (std::get<3>(t)) point.b = *std::get<3>(t);
        if (point.b && point.a.hierarchy > point.b->hierarchy) std::swap(point.a, *point.b);
        if (std::get<4>(t)) point.parcel_area_m2 = positive(*std::get<4>(t), -10);
        return point;
      });
}

RC_GTEST_PROP(IntersectionPointLayer, RoundTripThroughAFileLosesNothing, ()) {
  const auto points =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<IntersectionPoint>>(any_point()));
  const auto path = std::filesystem::path(::testing::TempDir()) / "intersection_points.gpkg";
  const geodata::LocalFrame frame = utm_frame();
  geodata::write_layers(path.string(), std::vector{intersection_point_layer(points, frame)});
  const ReadPoints read = read_intersection_points({path.string()}, frame);
  std::filesystem::remove(path);
  RC_CLASSIFY(points.size() > 10);
  RC_ASSERT(read.frame == frame);
  RC_ASSERT(read.points == points);
}

TEST(IntersectionPointLayer, HasAColumnPerAttributeWithItsUnit) {
  const Layer layer = intersection_point_layer(std::vector{some_point()}, {});
  std::vector<std::string> names;
  for (const auto& field : layer.fields) names.push_back(field.name);
  for (const char* wanted :
       {"a_hierarchy", "a_tortuosity", "a_distance_mean_m", "a_distance_variance_m2",
        "a_angle_mean_rad", "a_angle_variance_rad2", "a_width_m", "a_connections", "b_hierarchy",
        "b_connections", "parcel_area_m2"})
    EXPECT_EQ(std::count(names.begin(), names.end(), wanted), 1) << wanted;
}

TEST(IntersectionPointLayer, PointOfOneStreetLeavesTheOthersColumnsEmpty) {
  IntersectionPoint point = some_point();
  point.b.reset();
  point.parcel_area_m2.reset();
  Layer layer = intersection_point_layer(std::vector{point}, {});
  EXPECT_TRUE(std::holds_alternative<std::monostate>(value(layer, "b_width_m")));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(value(layer, "parcel_area_m2")));
  EXPECT_EQ(intersection_points_of(layer, "f").at(0), point);
}

TEST(IntersectionPointLayer, LevelsEditedOutOfOrderExchangeTheStreets) {
  Layer layer = intersection_point_layer(std::vector{some_point()}, {});
  value(layer, "a_hierarchy") = std::int64_t{3};
  const IntersectionPoint point = intersection_points_of(layer, "f").at(0);
  EXPECT_EQ(point.a.hierarchy, 1);
  EXPECT_EQ(point.a.width_m, 12.0);
  EXPECT_EQ(point.b->hierarchy, 3);
  EXPECT_EQ(point.b->width_m, 22.0);
}

TEST(IntersectionPointLayer, WholeNumbersOfARealColumnAreRead) {
  Layer layer = intersection_point_layer(std::vector{some_point()}, {});
  value(layer, "a_hierarchy") = 1.0;
  value(layer, "a_width_m") = std::int64_t{30};
  EXPECT_EQ(intersection_points_of(layer, "f").at(0).a.width_m, 30.0);
}

TEST(IntersectionPointLayer, ColumnsOfOthersAreIgnored) {
  Layer layer = intersection_point_layer(std::vector{some_point()}, {});
  layer.fields.push_back({"remark", geodata::FieldType::kText});
  auto& attributes = layer.features[0].attributes;
  attributes.emplace_back(std::string("new"));
  std::rotate(layer.fields.rbegin(), layer.fields.rbegin() + 1, layer.fields.rend());
  std::rotate(attributes.rbegin(), attributes.rbegin() + 1, attributes.rend());
  EXPECT_EQ(intersection_points_of(layer, "f").at(0), some_point());
}

TEST(IntersectionPointLayer, PlacesAreSnapped) {
  Layer layer = intersection_point_layer(std::vector{some_point()}, {});
  layer.features[0].points[0] = {0.1, 0.2};
  EXPECT_TRUE(is_on_grid(intersection_points_of(layer, "f").at(0).place));
}

TEST(IntersectionPointLayer, RefusalNamesFileFeatureFieldValueAndRange) {
  EXPECT_EQ(refusal_of("a_tortuosity", 0.5),
            "edited.gpkg:points: feature 1: a_tortuosity = 0.5, allowed 1 or more");
  EXPECT_EQ(refusal_of("b_connections", std::int64_t{3}),
            "edited.gpkg:points: feature 1: b_connections = 3, allowed 1..2");
}

TEST(IntersectionPointLayer, ValuesOutOfRangeAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<std::string, geodata::Attribute>> wrong{
      {"a_hierarchy", {}},
      {"a_hierarchy", std::int64_t{-1}},
      {"a_hierarchy", std::int64_t{1'000'000}},
      {"a_hierarchy", 0.5},
      {"a_hierarchy", std::string("main")},
      {"b_hierarchy", {}},
      {"b_hierarchy", std::int64_t{-2}},
      {"a_tortuosity", nan},
      {"b_tortuosity", infinity},
      {"b_tortuosity", {}},
      {"a_distance_mean_m", -1.0},
      {"a_distance_variance_m2", -1.0},
      {"b_distance_variance_m2", nan},
      {"a_angle_mean_rad", 4.0},
      {"b_angle_mean_rad", -0.1},
      {"b_angle_variance_rad2", -1e-9},
      {"a_width_m", -3.0},
      {"a_connections", std::int64_t{0}},
      {"parcel_area_m2", -5.0},
      {"parcel_area_m2", nan},
  };
  for (const auto& [field, attribute] : wrong) {
    const std::string said = refusal_of(field, attribute);
    EXPECT_NE(said.find("edited.gpkg:points: feature 1: " + field), std::string::npos)
        << field << ": \"" << said << '"';
  }
}

TEST(IntersectionPointLayer, MissingColumnIsRefused) {
  const Layer whole = intersection_point_layer(std::vector{some_point()}, {});
  for (std::size_t i = 0; i < whole.fields.size(); ++i) {
    Layer layer = whole;
    const std::string name = layer.fields[i].name;
    layer.fields.erase(layer.fields.begin() + static_cast<std::ptrdiff_t>(i));
    auto& attributes = layer.features[0].attributes;
    attributes.erase(attributes.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_NE(refusal(layer).find("no field \"" + name + "\""), std::string::npos) << name;
  }
}

TEST(IntersectionPointLayer, FeatureThatIsNotOnePointIsRefused) {
  Layer layer = intersection_point_layer(std::vector{some_point()}, {});
  layer.features[0].points.clear();
  EXPECT_NE(refusal(layer).find("feature 1: must be one point"), std::string::npos);
  layer.features[0].points = {{0, 0}, {1, 1}};
  EXPECT_NE(refusal(layer).find("must be one point"), std::string::npos);
  layer.features[0].points = {{std::numeric_limits<double>::quiet_NaN(), 0}};
  EXPECT_NE(refusal(layer).find("lies at"), std::string::npos);
  layer.kind = geodata::GeometryKind::kLine;
  EXPECT_NE(refusal(layer).find("not points"), std::string::npos);
}

}  // namespace
}  // namespace plat::streets
