#include "harness/synthesis_script.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "core/failure.h"

namespace plat::harness {
namespace {

using nlohmann::json;

/// A script with every key, to be read and, spoilt, to be refused.
json whole_script() {
  return json::parse(R"({
    "description": "all of it",
    "seed": 7,
    "examples": [
      {"name": "grid", "streets": "a.gpkg:roads", "parcels": "a.gpkg:parcels",
       "fields": {"class": "kind"}, "region": {"window": [0, 0, 500, 400]},
       "chains": {"continuity": "direction", "max_turn_rad": 0.5},
       "hierarchy": {"main_share_01": 0.1}, "parcel_radius_m": 80},
      {"name": "old", "data": "cambridge_ma", "region": {"offset_window": [-300, -300, 300, 300]}},
      {"name": "kept", "points": "p.gpkg"}
    ],
    "city": {"streets": "city.gpkg:streets", "parcels": "city.gpkg:parcels"},
    "operations": [
      {"do": "place", "example": "grid", "at": [100, 200], "rotate_deg": 90, "scale": 1.5,
       "mirror": true, "spacing": {"spacing_min_m": 9}},
      {"do": "join", "examples": [{"example": "grid"}, {"example": "old", "at": {"offset": [600, 0]}}]},
      {"do": "blend", "examples": [{"example": "grid"}, {"example": "old"}],
       "weight": {"from": [0, 0], "to": [500, 0]}, "options": {"positions": "morphed"},
       "quadtree": {"min_points": 9}},
      {"do": "expand", "example": "kept", "region": {"polygon": [[0, 0], [900, 0], [0, 900]]},
       "options": {"reach_m": 50}}
    ],
    "boundary": {"layer": "b.gpkg:limits"},
    "obstacles": [{"layer": "w.gpkg:water"}, {"window": [5, 5, 9, 9]}],
    "grower": {"name": "relative_neighbourhood", "options": {}},
    "subdivider": {"name": "obb", "options": {"area_max_m2": 600}}
  })");
}

TEST(SynthesisScript, EveryKeyIsRead) {
  const SynthesisScript script = parse_synthesis_script(whole_script(), "s.json");
  EXPECT_EQ(script.seed, 7U);
  ASSERT_EQ(script.examples.size(), 3U);
  const ScriptSource& grid = script.examples[0].source;
  EXPECT_EQ(grid.streets->file, "a.gpkg");
  EXPECT_EQ(grid.parcels->layer, "parcels");
  EXPECT_EQ(grid.fields.street_class, "kind");
  EXPECT_EQ(grid.region->ring.size(), 4U);
  EXPECT_EQ(grid.exemplar.chains.continuity, streets::Continuity::kDirection);
  EXPECT_DOUBLE_EQ(grid.exemplar.hierarchy.main_share_01, 0.1);
  EXPECT_DOUBLE_EQ(grid.exemplar.parcel_radius_m, 80.0);
  EXPECT_EQ(script.examples[1].source.dataset, "cambridge_ma");
  EXPECT_TRUE(script.examples[1].source.region->ring[0].is_offset);
  EXPECT_TRUE(script.examples[2].source.points);
  EXPECT_TRUE(script.city);
  ASSERT_EQ(script.operations.size(), 4U);

  const auto& place = std::get<JoinOperation>(script.operations[0].what);
  ASSERT_EQ(place.copies.size(), 1U);
  EXPECT_EQ(place.copies[0].at->value, (Point{100, 200}));
  EXPECT_DOUBLE_EQ(place.copies[0].rotation_rad, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(place.copies[0].scale, 1.5);
  EXPECT_EQ(place.copies[0].mirroring, synthesis::Mirroring::kAcrossEast);
  EXPECT_DOUBLE_EQ(place.spacing.min_m, 9.0);
  const auto& join = std::get<JoinOperation>(script.operations[1].what);
  EXPECT_FALSE(join.copies[0].at);
  EXPECT_TRUE(join.copies[1].at->is_offset);
  EXPECT_EQ(join.copies[1].example, 1U);
  const auto& blend = std::get<BlendOperation>(script.operations[2].what);
  EXPECT_EQ(std::get<ScriptRamp>(blend.weight).to.value, (Point{500, 0}));
  EXPECT_EQ(blend.options.positions, synthesis::BlendPositions::kMorphed);
  EXPECT_EQ(blend.options.quadtree.min_points, 9);
  const auto& expand = std::get<ExpandOperation>(script.operations[3].what);
  EXPECT_DOUBLE_EQ(expand.options.reach_m, 50.0);
  EXPECT_EQ(script.operations[3].region->ring.size(), 3U);

  EXPECT_EQ(script.boundary->layer->layer, "limits");
  EXPECT_EQ(script.obstacles.size(), 2U);
  EXPECT_EQ(script.grower->name, "relative_neighbourhood");
  EXPECT_EQ(script.subdivider->options.at("area_max_m2"), OptionValue(600.0));
}

TEST(SynthesisScript, AWeightIsANumberARampOrAcrossTheOverlap) {
  json script = whole_script();
  const auto weight_of = [](const json& with) {
    return std::get<BlendOperation>(parse_synthesis_script(with, "s.json").operations[2].what)
        .weight;
  };
  script["operations"][2]["weight"] = 0.25;
  EXPECT_DOUBLE_EQ(std::get<double>(weight_of(script)), 0.25);
  script["operations"][2]["weight"] = "across";
  EXPECT_TRUE(std::holds_alternative<AcrossOverlap>(weight_of(script)));
  script["operations"][2].erase("weight");
  EXPECT_TRUE(std::holds_alternative<AcrossOverlap>(weight_of(script)));
}

TEST(SynthesisScript, WhatIsLeftOutHasItsDefault) {
  const SynthesisScript script =
      parse_synthesis_script(json::parse(R"({"examples": [{"name": "a", "points": "p.gpkg"}],
                      "operations": [{"do": "place", "example": "a"}]})"),
                             "s.json");
  EXPECT_EQ(script.seed, 1U);
  EXPECT_FALSE(script.city || script.boundary || script.grower || script.subdivider);
  const ScriptCopy& copy = std::get<JoinOperation>(script.operations[0].what).copies[0];
  EXPECT_FALSE(copy.at);
  EXPECT_DOUBLE_EQ(copy.scale, 1.0);
}

struct Spoilt {
  const char* pointer;  ///< what is put elsewhere, as a JSON pointer
  const char* value;    ///< JSON; empty: taken away
  const char* message;  ///< what the refusal begins with, behind "s.json: "
};

class SpoiltScript : public ::testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltScript, IsRefusedWithThePathInTheScript) {
  const Spoilt& spoilt = GetParam();
  json script = whole_script();
  const json::json_pointer pointer(spoilt.pointer);
  if (*spoilt.value == '\0') {
    script.at(pointer.parent_pointer()).erase(pointer.back());
  } else {
    script[pointer] = json::parse(spoilt.value);
  }
  try {
    static_cast<void>(parse_synthesis_script(script, "s.json"));
    FAIL() << "not refused: " << spoilt.message;
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(std::string("s.json: ") + spoilt.message))
        << error.what() << "\nexpected: " << spoilt.message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Keys, SpoiltScript,
    ::testing::Values(
        Spoilt{"/operation", "[]", "unknown key \"operation\", did you mean \"operations\"?"},
        Spoilt{"/description", "3", "description: must be a text"},
        Spoilt{"/seed", "-1", "seed: -1, allowed 0.."},
        Spoilt{"/seed", "1.5", "seed: must be a whole number"},
        Spoilt{"/examples", "", "examples: is missing"},
        Spoilt{"/examples", "[]", "examples: must be one or more"},
        Spoilt{"/examples/0/name", "", "examples[0].name: is missing"},
        Spoilt{"/examples/1/name", "\"grid\"", "examples[1].name: \"grid\" comes twice"},
        Spoilt{"/examples/1/data", "", "examples[1]: must have one of data, streets, points"},
        Spoilt{"/examples/0/points", "\"p.gpkg\"",
               "examples[0]: must have one of data, streets, points"},
        Spoilt{"/examples/1/parcels", "\"p.gpkg\"", "examples[1].parcels: goes with \"streets\""},
        Spoilt{"/examples/1/fields", "{}", "examples[1].fields: goes with \"streets\""},
        Spoilt{"/examples/0/fields/klass", "\"x\"",
               "examples[0].fields: unknown key \"klass\", did you mean \"class\"?"},
        Spoilt{"/examples/0/region/window", "[0, 0, 0, 400]",
               "examples[0].region.window: is empty"},
        Spoilt{"/examples/0/region/window", "[0, 0, 400]", "examples[0].region.window: must be ["},
        Spoilt{"/examples/0/region/layer", "\"x.gpkg\"", "examples[0].region: must have one of"},
        Spoilt{"/examples/0/chains/max_turn_rad", "9", "examples[0].chains: max_turn_rad"},
        Spoilt{"/examples/0/hierarchy/share", "1", "examples[0].hierarchy: "},
        Spoilt{"/examples/0/parcel_radius_m", "0",
               "examples[0].parcel_radius_m: 0, allowed 1..1000"},
        Spoilt{"/city/data", "\"cambridge_ma\"", "city: must have one of data, streets"},
        Spoilt{"/city/points", "\"p.gpkg\"", "city: unknown key \"points\""},
        Spoilt{"/city", "", "operations[3]: needs a \"city\""},
        Spoilt{"/operations", "", "operations: is missing"},
        Spoilt{"/operations", "[]", "operations: must be one or more"},
        Spoilt{"/operations/1/do", "\"joint\"", "operations[1].do: no \"joint\", did you mean"},
        Spoilt{"/operations/1/do", "", "operations[1].do: is missing"},
        Spoilt{"/operations/0/example", "\"gird\"",
               "operations[0].example: no example \"gird\", did you mean \"grid\"?"},
        Spoilt{"/operations/0/at", "[1]", "operations[0].at: must be [x, y]"},
        Spoilt{"/operations/0/at", "[1, \"a\"]", "operations[0].at[1]: must be a number"},
        Spoilt{"/operations/0/at", "{\"by\": [1, 2]}", "operations[0].at: unknown key \"by\""},
        Spoilt{"/operations/0/rotate_deg", "400", "operations[0].rotate_deg: 400, allowed"},
        Spoilt{"/operations/0/scale", "0", "operations[0].scale: 0, allowed 0.1..10"},
        Spoilt{"/operations/0/mirror", "1", "operations[0].mirror: must be true or false"},
        Spoilt{"/operations/0/spacing/min", "1", "operations[0].spacing: "},
        Spoilt{"/operations/0/weight", "1", "operations[0]: unknown key \"weight\""},
        Spoilt{"/operations/1/examples", "[{\"example\": \"grid\"}]",
               "operations[1].examples: must be two copies or more"},
        Spoilt{"/operations/2/examples", "[]", "operations[2].examples: must be two copies"},
        Spoilt{"/operations/2/weight", "1.5", "operations[2].weight: 1.5, allowed 0..1"},
        Spoilt{"/operations/2/weight", "\"acros\"", "operations[2].weight: no \"acros\""},
        Spoilt{"/operations/2/weight/to", "[0, 0]", "operations[2].weight: from and to are one"},
        Spoilt{"/operations/2/weight/to", "", "operations[2].weight.to: is missing"},
        Spoilt{"/operations/2/options/positions", "\"x\"", "operations[2].options: positions"},
        Spoilt{"/operations/2/quadtree/min_points", "0", "operations[2].quadtree: min_points"},
        Spoilt{"/operations/3/region", "", "operations[3].region: is missing"},
        Spoilt{"/operations/3/region/polygon", "[[0, 0], [1, 1]]",
               "operations[3].region.polygon: must have three points"},
        Spoilt{"/boundary/layer", "3", "boundary.layer: must be a text"},
        Spoilt{"/obstacles", "{}", "obstacles: must be a list"},
        Spoilt{"/obstacles/1", "{}", "obstacles[1]: must have one of window"},
        Spoilt{"/grower/name", "\"walk\"", "grower.name: unknown strategy \"walk\""},
        Spoilt{"/grower/name", "", "grower.name: is missing"},
        Spoilt{"/grower/option", "{}", "grower: unknown key \"option\""},
        Spoilt{"/subdivider/options/area", "3", "subdivider.options: "},
        Spoilt{"/subdivider/options/area_max_m2", "[]",
               "subdivider.options.area_max_m2: must be a number or a text"}));

TEST(SynthesisScript, AFileThatIsNoJsonIsRefused) {
  EXPECT_THROW(static_cast<void>(read_synthesis_script("/nowhere/s.json")), InputError);
  EXPECT_THROW(static_cast<void>(parse_synthesis_script(json::array(), "s.json")), InputError);
}

}  // namespace
}  // namespace plat::harness
