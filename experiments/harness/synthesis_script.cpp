#include "harness/synthesis_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/working_grid.h"
#include "harness/json_file.h"
#include "harness/script_json_internal.h"
#include "parcels/block_subdivider.h"
#include "streets/street_grower.h"

namespace plat::harness {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180.0;
/// Coordinates of projected CRSs are below this, metres.
constexpr double kMaxCoordinate_m = 1e8;

Point point_of(const ScriptJson& json, double limit_m) {
  const char* const shape = "must be [x, y] in metres, or {\"offset\": [east, north]}";
  if (!json.is_list()) json.refuse(shape);
  const std::vector<ScriptJson> parts = json.list();
  if (parts.size() != 2) json.refuse(shape);
  return {parts[0].number(-limit_m, limit_m), parts[1].number(-limit_m, limit_m)};
}

ScriptPlace place_of(const ScriptJson& json) {
  if (json.is_list()) return {point_of(json, kMaxCoordinate_m), false};
  json.expect_only({"offset"});
  return {point_of(json.needed("offset", "[east, north] in metres"), kGridExtent_m), true};
}

/// The corners of [x from, y from, x to, y to].
std::vector<ScriptPlace> window_of(const ScriptJson& json, bool is_offset) {
  const std::vector<ScriptJson> parts = json.list();
  if (parts.size() != 4) json.refuse("must be [x min, y min, x max, y max] in metres");
  std::vector<double> sides;
  for (const ScriptJson& part : parts)
    sides.push_back(part.number(-kMaxCoordinate_m, kMaxCoordinate_m));
  if (!(sides[0] < sides[2] && sides[1] < sides[3])) json.refuse("is empty: min must be below max");
  return {{{sides[0], sides[1]}, is_offset},
          {{sides[2], sides[1]}, is_offset},
          {{sides[2], sides[3]}, is_offset},
          {{sides[0], sides[3]}, is_offset}};
}

geodata::LayerSource layer_of(const ScriptJson& json) {
  return geodata::parse_layer_source(json.text());
}

/// {"window": [...]}, {"offset_window": [...]}, {"polygon": [...]} or {"layer": "FILE:layer"}.
ScriptRegion region_of(const ScriptJson& json) {
  json.expect_only({"window", "offset_window", "polygon", "layer"});
  ScriptRegion out{json.path(), {}, std::nullopt};
  std::size_t given = 0;
  if (const auto window = json.find("window")) {
    out.ring = window_of(*window, false);
    ++given;
  }
  if (const auto window = json.find("offset_window")) {
    out.ring = window_of(*window, true);
    ++given;
  }
  if (const auto polygon = json.find("polygon")) {
    for (const ScriptJson& place : polygon->list()) out.ring.push_back(place_of(place));
    if (out.ring.size() < 3) polygon->refuse("must have three points or more");
    ++given;
  }
  if (const auto layer = json.find("layer")) {
    out.layer = layer_of(*layer);
    ++given;
  }
  if (given != 1) json.refuse("must have one of window, offset_window, polygon, layer");
  return out;
}

/// Options of the operations and of exemplars, each by name in `json` if it is there.
template <class Options>
Options options_of(const ScriptJson& json, std::string_view key) {
  const auto given = json.find(key);
  if (!given) return {};
  return from_option_map<Options>(given->where(), given->options());
}

streets::ExemplarOptions exemplar_options_of(const ScriptJson& json) {
  streets::ExemplarOptions out;
  out.chains = options_of<streets::ChainOptions>(json, "chains");
  out.hierarchy = options_of<streets::HierarchyOptions>(json, "hierarchy");
  if (const auto radius = json.find("parcel_radius_m"))
    out.parcel_radius_m = radius->number(1.0, 1000.0);
  return out;
}

streets::StreetFields fields_of(const ScriptJson& json) {
  json.expect_only(
      {"name", "class", "width", "lanes", "level", "structure", "class_prefix", "default_class"});
  streets::StreetFields out;
  const auto read = [&](std::string_view key, std::string& member) {
    if (const auto value = json.find(key)) member = value->text();
  };
  read("name", out.name);
  read("class", out.street_class);
  read("width", out.width);
  read("lanes", out.lanes);
  read("level", out.level);
  read("structure", out.structure);
  read("class_prefix", out.class_prefix);
  read("default_class", out.default_class);
  return out;
}

ScriptSource source_of(const ScriptJson& json) {
  ScriptSource out;
  out.path = json.path();
  if (const auto data = json.find("data")) out.dataset = data->text();
  if (const auto streets = json.find("streets")) out.streets = layer_of(*streets);
  if (const auto points = json.find("points")) out.points = layer_of(*points);
  if (const auto parcels = json.find("parcels")) {
    if (!out.streets) parcels->refuse("goes with \"streets\"");
    out.parcels = layer_of(*parcels);
  }
  if (const auto fields = json.find("fields")) {
    if (!out.streets) fields->refuse("goes with \"streets\"");
    out.fields = fields_of(*fields);
  }
  if (const auto region = json.find("region")) out.region = region_of(*region);
  out.exemplar = exemplar_options_of(json);
  return out;
}

ScriptExample example_of(const ScriptJson& json) {
  json.expect_only({"name", "data", "streets", "parcels", "points", "fields", "region", "chains",
                    "hierarchy", "parcel_radius_m"});
  ScriptExample out{json.needed("name", "operations use it").text(), source_of(json)};
  const ScriptSource& source = out.source;
  if (source.dataset.has_value() + source.streets.has_value() + source.points.has_value() != 1)
    json.refuse("must have one of data, streets, points");
  return out;
}

ScriptSource city_of(const ScriptJson& json) {
  json.expect_only(
      {"data", "streets", "parcels", "fields", "region", "chains", "hierarchy", "parcel_radius_m"});
  ScriptSource out = source_of(json);
  if (out.dataset.has_value() + out.streets.has_value() != 1)
    json.refuse("must have one of data, streets");
  return out;
}

/// Reads operations, whose copies name the script's examples.
class OperationReader {
 public:
  explicit OperationReader(const std::vector<ScriptExample>& examples) : examples_(examples) {}

  [[nodiscard]] ScriptOperation read(const ScriptJson& json) const {
    ScriptOperation out;
    out.path = json.path();
    out.name = json.needed("do", "place, join, blend or expand")
                   .choice({"place", "join", "blend", "expand"});
    if (out.name == "place") {
      out.what = read_place(json);
    } else if (out.name == "join") {
      out.what = read_join(json);
    } else if (out.name == "blend") {
      out.what = read_blend(json);
    } else {
      out.what = read_expand(json);
    }
    if (out.name == "expand") {
      out.region = region_of(json.needed("region", "where the city grows"));
    } else if (const auto region = json.find("region")) {
      out.region = region_of(*region);
    }
    return out;
  }

 private:
  [[nodiscard]] JoinOperation read_place(const ScriptJson& json) const {
    json.expect_only({"do", "example", "at", "rotate_deg", "scale", "mirror", "region", "spacing"});
    return {{copy_of(json)}, options_of<synthesis::Spacing>(json, "spacing")};
  }

  [[nodiscard]] JoinOperation read_join(const ScriptJson& json) const {
    json.expect_only({"do", "examples", "region", "spacing"});
    JoinOperation out{{}, options_of<synthesis::Spacing>(json, "spacing")};
    const ScriptJson examples = json.needed("examples", "a list of copies");
    for (const ScriptJson& each : examples.list()) out.copies.push_back(copy_alone(each));
    if (out.copies.size() < 2) examples.refuse("must be two copies or more");
    return out;
  }

  [[nodiscard]] BlendOperation read_blend(const ScriptJson& json) const {
    json.expect_only({"do", "examples", "weight", "region", "options", "spacing", "quadtree"});
    const ScriptJson list = json.needed("examples", "a list of two copies");
    const std::vector<ScriptJson> examples = list.list();
    if (examples.size() != 2) list.refuse("must be two copies");
    BlendOperation out{copy_alone(examples[0]), copy_alone(examples[1]), AcrossOverlap{},
                       options_of<synthesis::BlendOptions>(json, "options")};
    out.options.spacing = options_of<synthesis::Spacing>(json, "spacing");
    out.options.quadtree = options_of<synthesis::QuadtreeOptions>(json, "quadtree");
    const auto weight = json.find("weight");
    if (!weight) return out;
    if (weight->is_number()) {
      out.weight = weight->number(0.0, 1.0);
    } else if (weight->is_text()) {
      static_cast<void>(weight->choice({"across"}));
    } else {
      weight->expect_only({"from", "to"});
      const ScriptRamp ramp{place_of(weight->needed("from", "where the first style is")),
                            place_of(weight->needed("to", "where the second style is"))};
      if (ramp.from.value == ramp.to.value && ramp.from.is_offset == ramp.to.is_offset)
        weight->refuse("from and to are one place");
      out.weight = ramp;
    }
    return out;
  }

  [[nodiscard]] ExpandOperation read_expand(const ScriptJson& json) const {
    json.expect_only(
        {"do", "example", "at", "rotate_deg", "scale", "mirror", "region", "options", "spacing"});
    ExpandOperation out{copy_of(json), options_of<synthesis::ExpansionOptions>(json, "options")};
    out.options.spacing = options_of<synthesis::Spacing>(json, "spacing");
    return out;
  }

  [[nodiscard]] ScriptCopy copy_alone(const ScriptJson& json) const {
    json.expect_only({"example", "at", "rotate_deg", "scale", "mirror"});
    return copy_of(json);
  }

  [[nodiscard]] ScriptCopy copy_of(const ScriptJson& json) const {
    ScriptCopy out;
    out.path = json.path();
    out.example = example_named(json.needed("example", "the name of an example"));
    if (const auto at = json.find("at")) out.at = place_of(*at);
    if (const auto angle = json.find("rotate_deg"))
      out.rotation_rad = kRadPerDegree * angle->number(-360.0, 360.0);
    if (const auto scale = json.find("scale")) out.scale = scale->number(0.1, 10.0);
    if (const auto mirror = json.find("mirror"); mirror && mirror->is_true_or_false())
      out.mirroring = synthesis::Mirroring::kAcrossEast;
    return out;
  }

  [[nodiscard]] std::size_t example_named(const ScriptJson& json) const {
    const std::string name = json.text();
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < examples_.size(); ++i) {
      if (examples_[i].name == name) return i;
      known.push_back(examples_[i].name);
    }
    json.refuse(fmt::format("no example \"{}\"{}", name, did_you_mean(name, known)));
  }

  const std::vector<ScriptExample>& examples_;
};

/// A strategy of a menu; name and options are tried here.
template <class Menu>
StrategyChoice strategy_of(const ScriptJson& json, const Menu& menu) {
  json.expect_only({"name", "options"});
  const ScriptJson name = json.needed("name", "plat list strategies has the names");
  StrategyChoice out{name.text(), {}};
  name.naming([&] { static_cast<void>(menu.make(out.name)); });
  if (const auto options = json.find("options")) {
    out.options = options->options();
    options->naming([&] { static_cast<void>(menu.make(out.name, out.options)); });
  }
  return out;
}

void read_examples(const ScriptJson& json, SynthesisScript& script) {
  for (const ScriptJson& each : json.list()) {
    script.examples.push_back(example_of(each));
    for (std::size_t i = 0; i + 1 < script.examples.size(); ++i) {
      if (script.examples[i].name == script.examples.back().name)
        each.refuse_member("name", fmt::format("\"{}\" comes twice", script.examples[i].name));
    }
  }
  if (script.examples.empty()) json.refuse("must be one or more");
}

void read_operations(const ScriptJson& json, SynthesisScript& script) {
  const OperationReader reader(script.examples);
  for (const ScriptJson& each : json.list()) {
    script.operations.push_back(reader.read(each));
    if (script.operations.back().name == "expand" && !script.city)
      each.refuse("needs a \"city\" to expand; place or join lay out points without one");
  }
  if (script.operations.empty()) json.refuse("must be one or more");
}

}  // namespace

SynthesisScript parse_synthesis_script(const nlohmann::json& value, const std::string& source) {
  const ScriptJson json(value, source);
  json.expect_only({"description", "seed", "examples", "city", "operations", "boundary",
                    "obstacles", "grower", "subdivider"});
  SynthesisScript script;
  script.source = source;
  if (const auto description = json.find("description")) static_cast<void>(description->text());
  if (const auto seed = json.find("seed")) {
    script.seed =
        static_cast<std::uint64_t>(seed->whole(0, std::numeric_limits<std::int64_t>::max()));
  }
  read_examples(json.needed("examples", "a list of where points come from"), script);
  if (const auto city = json.find("city")) script.city = city_of(*city);
  read_operations(json.needed("operations", "a list of what to do"), script);
  if (const auto boundary = json.find("boundary")) script.boundary = region_of(*boundary);
  if (const auto obstacles = json.find("obstacles")) {
    for (const ScriptJson& each : obstacles->list()) script.obstacles.push_back(region_of(each));
  }
  if (const auto grower = json.find("grower"))
    script.grower = strategy_of(*grower, streets::street_growers());
  if (const auto subdivider = json.find("subdivider"))
    script.subdivider = strategy_of(*subdivider, parcels::block_subdividers());
  return script;
}

SynthesisScript read_synthesis_script(const std::string& file) {
  return parse_synthesis_script(read_json(file), file);
}

}  // namespace plat::harness
