#include "streets/street_width.h"

#include <gtest/gtest.h>

#include "core/failure.h"
#include "streets/network_cleaning.h"
#include "streets/street_classes.h"
#include "streets/street_import.h"

namespace plat::streets {
namespace {

Street only_street(StreetAttributes attributes, std::vector<Polygon> land = {},
                   WidthOptions options = {}) {
  StreetNetwork network =
      build_network(std::vector<RawStreet>{{"s", {{0, 0}, {100, 0}}, std::move(attributes)}})
          .network;
  assign_widths(network, land, options);
  return network.streets.at(0);
}

Polygon box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

TEST(AssignWidths, TakesTheWidthField) {
  StreetAttributes a;
  a.given_width_m = 9.5;
  a.lanes = 4.0;
  const Street street = only_street(a, {box(0, 5, 100, 40), box(0, -40, 100, -5)});
  EXPECT_EQ(street.width_m, 9.5);
  EXPECT_EQ(street.width_source, WidthSource::kAttribute);
}

TEST(AssignWidths, ElseCountsLanesAndPavements) {
  StreetAttributes a;
  a.lanes = 2.0;
  const Street street = only_street(a, {}, {.lane_width_m = 3.0, .pavement_m = 2.0});
  EXPECT_EQ(street.width_m, 10.0);
  EXPECT_EQ(street.width_source, WidthSource::kLanes);
}

TEST(AssignWidths, ElseMeasuresTheGapBetweenParcels) {
  StreetAttributes a;
  a.street_class = "residential";
  // The centreline is off the middle: 6 m to the left, 8 m to the right.
  const Street street = only_street(a, {box(0, 6, 100, 40), box(0, -40, 100, -8)});
  EXPECT_DOUBLE_EQ(street.width_m, 14.0);
  EXPECT_EQ(street.width_source, WidthSource::kGap);
}

TEST(AssignWidths, GapIsTheMedianSoThatASideStreetDoesNotCount) {
  const Street street = only_street(
      {}, {box(0, 6, 40, 40), box(60, 6, 100, 40), box(0, 60, 100, 90), box(0, -40, 100, -6)});
  EXPECT_DOUBLE_EQ(street.width_m, 12.0);
}

TEST(AssignWidths, StreetThatRunsThroughAParcelIsNotMeasured) {
  StreetAttributes a;
  a.street_class = "residential";
  EXPECT_EQ(only_street(a, {box(-10, -30, 110, 30)}).width_source, WidthSource::kClass);
}

TEST(AssignWidths, StreetWithLandOnOneSideIsNotMeasured) {
  StreetAttributes a;
  a.street_class = "residential";
  EXPECT_EQ(only_street(a, {box(0, 6, 100, 40)}).width_source, WidthSource::kClass);
}

TEST(AssignWidths, ElseTakesTheClassTableAndLastADefault) {
  StreetAttributes a;
  a.street_class = "tertiary";
  EXPECT_EQ(only_street(a).width_source, WidthSource::kClass);
  a.street_class = "no such class";
  EXPECT_EQ(only_street(a).width_source, WidthSource::kAssumed);
  EXPECT_EQ(only_street(a).width_m, WidthOptions{}.default_width_m);
}

geodata::Layer layer_with(std::vector<std::string> fields, std::vector<std::string> values) {
  geodata::Layer layer;
  layer.name = "roads";
  layer.kind = geodata::GeometryKind::kLine;
  geodata::Feature feature;
  feature.id = "17";
  feature.lines.push_back({{0, 0}, {10, 0}});
  for (std::size_t i = 0; i < fields.size(); ++i) {
    layer.fields.push_back({fields[i], geodata::FieldType::kText});
    feature.attributes.emplace_back(values[i]);
  }
  layer.features.push_back(std::move(feature));
  return layer;
}

TEST(ImportStreets, ReadsOpenStreetMapFields) {
  const RawStreets raw = import_streets(
      layer_with({"highway", "name", "lanes", "bridge"}, {"primary", "Rambla", "2;3", "yes"}));
  const StreetAttributes& a = raw.streets.at(0).attributes;
  EXPECT_EQ(a.street_class, "primary");
  EXPECT_EQ(a.name, "Rambla");
  EXPECT_EQ(a.lanes, 2.0);
  EXPECT_EQ(a.level, 1);
  EXPECT_EQ(a.structure, Structure::kBridge);
}

TEST(ImportStreets, ReadsOtherTags) {
  const RawStreets raw = import_streets(
      layer_with({"highway", "other_tags"},
                 {"primary", R"("lanes"=>"3","width"=>"12.5 m","tunnel"=>"yes","layer"=>"-2")"}));
  const StreetAttributes& a = raw.streets.at(0).attributes;
  EXPECT_EQ(a.lanes, 3.0);
  EXPECT_EQ(a.given_width_m, 12.5);
  EXPECT_EQ(a.level, -2);
  EXPECT_EQ(a.structure, Structure::kTunnel);
}

TEST(ImportStreets, ValueThatCannotBeAWidthIsARow) {
  const RawStreets raw = import_streets(layer_with({"width"}, {"0"}));
  EXPECT_FALSE(raw.streets.at(0).attributes.given_width_m.has_value());
  ASSERT_EQ(raw.repairs.size(), 1U);
  EXPECT_EQ(raw.repairs.front().feature_id, "17");
  EXPECT_EQ(raw.repairs.front().kind, RepairKind::kBadValue);
}

TEST(ImportStreets, MisspeltFieldIsRefusedWithTheNearestName) {
  StreetFields fields;
  fields.name = "nmae";
  EXPECT_THROW(import_streets(layer_with({"name"}, {"x"}), fields), InputError);
}

TEST(ImportStreets, OpenStreetMapLineWithoutHighwayIsLeftOutByARow) {
  const RawStreets raw = import_streets(layer_with({"highway", "waterway"}, {"", "river"}));
  EXPECT_TRUE(raw.streets.empty());
  ASSERT_EQ(raw.repairs.size(), 1U);
  EXPECT_EQ(raw.repairs.front().kind, RepairKind::kNotUsed);
}

TEST(ImportStreets, PolygonsAreRefused) {
  geodata::Layer layer = layer_with({}, {});
  layer.kind = geodata::GeometryKind::kPolygon;
  EXPECT_THROW(import_streets(layer), InputError);
}

TEST(BoundsBlocks, FootwaysDoNotUnlessAsked) {
  EXPECT_FALSE(bounds_blocks("footway", BoundingClasses::kStreets));
  EXPECT_TRUE(bounds_blocks("footway", BoundingClasses::kAll));
  EXPECT_TRUE(bounds_blocks("residential", BoundingClasses::kStreets));
  EXPECT_TRUE(bounds_blocks("", BoundingClasses::kStreets));
}

}  // namespace
}  // namespace plat::streets
