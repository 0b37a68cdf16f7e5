#include "streets/street_import.h"

#include <gtest/gtest.h>

#include "core/failure.h"

namespace plat::streets {
namespace {

geodata::Layer osm_layer() {
  geodata::Layer layer;
  layer.name = "lines";
  layer.kind = geodata::GeometryKind::kLine;
  layer.fields = {{"highway", geodata::FieldType::kText},
                  {"other_tags", geodata::FieldType::kText}};
  geodata::Feature feature;
  feature.lines = {{{0, 0}, {50, 0}}};
  feature.attributes = {std::string("residential"),
                        std::string("\"width\"=>\"7.5\",\"lanes\"=>\"2\"")};
  layer.features.push_back(feature);
  return layer;
}

TEST(StreetImport, ANamedFieldThatIsATagIsReadFromTheTags) {
  const RawStreets raw = import_streets(osm_layer(), {.street_class = "highway", .width = "width"});
  ASSERT_EQ(raw.streets.size(), 1u);
  EXPECT_EQ(raw.streets[0].attributes.street_class, "residential");
  EXPECT_EQ(raw.streets[0].attributes.given_width_m, 7.5);
  EXPECT_EQ(raw.streets[0].attributes.lanes, 2.0);
}

TEST(StreetImport, ANamedFieldThatIsNowhereIsRefused) {
  geodata::Layer layer = osm_layer();
  layer.fields[1].name = "notes";
  EXPECT_THROW(import_streets(layer, {.width = "width"}), InputError);
}

}  // namespace
}  // namespace plat::streets
