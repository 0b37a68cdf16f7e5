#include "harness/reconfigure_script.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "harness/json_file.h"
#include "harness/script_json_internal.h"
#include "similarity/shape_similarity.h"

namespace plat::harness {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180.0;
/// Coordinates of projected CRSs are below this, metres.
constexpr double kMaxCoordinate_m = 1e8;
/// Farther than any city reaches, metres.
constexpr double kMaxShift_m = 1e5;

Point pair_of(const ScriptJson& json, std::string_view shape, double limit_m) {
  if (!json.is_list()) json.refuse(shape);
  const std::vector<ScriptJson> parts = json.list();
  if (parts.size() != 2) json.refuse(shape);
  return {parts[0].number(-limit_m, limit_m), parts[1].number(-limit_m, limit_m)};
}

Point place_of(const ScriptJson& json) {
  return pair_of(json, "must be [x, y] in metres of the city's CRS", kMaxCoordinate_m);
}

Ring window_of(const ScriptJson& json) {
  const std::vector<ScriptJson> parts = json.list();
  if (parts.size() != 4) json.refuse("must be [x min, y min, x max, y max] in metres");
  std::array<double, 4> side{};
  for (std::size_t i = 0; i < 4; ++i)
    side[i] = parts[i].number(-kMaxCoordinate_m, kMaxCoordinate_m);
  if (!(side[0] < side[2] && side[1] < side[3])) json.refuse("is empty: min must be below max");
  return {{side[0], side[1]}, {side[2], side[1]}, {side[2], side[3]}, {side[0], side[3]}};
}

Ring polygon_of(const ScriptJson& json) {
  Ring out;
  for (const ScriptJson& place : json.list()) out.push_back(place_of(place));
  if (out.size() < 3) json.refuse("must have three points or more");
  return out;
}

ScriptCircle circle_of(const ScriptJson& json) {
  json.expect_only({"center", "radius_m"});
  return {place_of(json.needed("center", "[x, y]")),
          json.needed("radius_m", "metres").number(0.0, kMaxShift_m)};
}

ScriptTiles selection_of(const ScriptJson& operation) {
  const ScriptJson json = operation.needed("tiles", "which tiles");
  json.expect_only(
      {"ids", "source_ids", "at", "points", "window", "polygon", "circle", "zone", "all"});
  ScriptTiles out;
  out.path = json.path();
  std::size_t given = 0;
  const auto read = [&](std::string_view key, auto take) {
    const auto value = json.find(key);
    if (!value) return;
    take(*value);
    ++given;
  };
  read("ids", [&](const ScriptJson& ids) {
    for (const ScriptJson& id : ids.list()) {
      const auto value = id.whole(0, std::numeric_limits<std::uint32_t>::max());
      out.ids.push_back({static_cast<std::uint32_t>(value)});
    }
    if (out.ids.empty()) ids.refuse("must name a tile");
  });
  read("source_ids", [&](const ScriptJson& ids) {
    for (const ScriptJson& id : ids.list()) out.source_ids.push_back(id.text());
    if (out.source_ids.empty()) ids.refuse("must name a tile");
  });
  read("at", [&](const ScriptJson& at) { out.points.push_back(place_of(at)); });
  read("points", [&](const ScriptJson& points) {
    if (!out.points.empty()) points.refuse("goes without \"at\"");
    for (const ScriptJson& each : points.list()) out.points.push_back(place_of(each));
    if (out.points.empty()) points.refuse("must hold a point");
  });
  read("window", [&](const ScriptJson& window) { out.area = window_of(window); });
  read("polygon", [&](const ScriptJson& polygon) {
    if (out.area) polygon.refuse("goes without \"window\"");
    out.area = polygon_of(polygon);
  });
  read("circle", [&](const ScriptJson& circle) { out.circle = circle_of(circle); });
  read("zone", [&](const ScriptJson& zone) { out.zone = zone.text(); });
  read("all", [&](const ScriptJson& all) {
    if (!all.is_true_or_false()) all.refuse("must be true; leave it out to name tiles");
  });
  if (given == 0)
    json.refuse(
        "must have one or more of ids, source_ids, at, points, window, polygon, circle, zone, all");
  return out;
}

/// The keys of a motion are read where the operation has any.
ScriptMotion motion_of(const ScriptJson& json) {
  ScriptMotion out;
  std::size_t given = 0;
  if (const auto by = json.find("by")) {
    out.by = pair_of(*by, "must be [east, north] in metres", kMaxShift_m);
    ++given;
  }
  if (const auto to = json.find("to")) {
    if (given != 0) to->refuse("goes without \"by\"");
    out.to = place_of(*to);
    ++given;
  }
  if (const auto angle = json.find("angle_deg")) {
    out.angle_rad = kRadPerDegree * angle->number(-360.0, 360.0);
    ++given;
  }
  if (const auto about = json.find("about")) {
    if (!json.find("angle_deg")) about->refuse("goes with \"angle_deg\"");
    out.about = place_of(*about);
  }
  if (given == 0) json.refuse("must say where to: by, to or angle_deg");
  return out;
}

/// The field's member of the script, where it is there, wins over the value in the options.
template <class Options>
void read_fields(const ScriptJson& json, Options& out) {
  OptionMap map = to_option_map(out);
  for (auto& [key, value] : map) {
    const auto given = json.find(key);
    if (!given) continue;
    if (given->is_number()) {
      value =
          given->number(-std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
    } else {
      value = given->text();
    }
  }
  out = json.naming([&] { return from_option_map<Options>("options", map); });
}

template <class Options>
void add_names(std::vector<std::string_view>& names) {
  std::apply([&](const auto&... field) { (names.push_back(field.name), ...); }, Options::fields());
}

bool is_none(const ScriptJson& json) { return json.is_text() && json.text() == kAbsent; }

void read_replacement(const ScriptJson& json, std::optional<tiles::ReplacementOptions>& out) {
  if (is_none(json)) {
    out.reset();
    return;
  }
  std::vector<std::string_view> keys;
  add_names<tiles::ReplacementOptions>(keys);
  json.expect_only(keys);
  if (!out) out.emplace();
  read_fields(json, *out);
}

/// What is given in `json` wins over what is there.
void read_options(const ScriptJson& json, tiles::ReconfigurationOptions& out) {
  std::vector<std::string_view> keys;
  add_names<tiles::SolverOptions>(keys);
  add_names<tiles::ReconfigurationOptions>(keys);
  keys.insert(keys.end(), {"similarity", "similarity_options", "replacement"});
  json.expect_only(keys);
  read_fields(json, out.solver);
  tiles::ReconfigurationOptions fields = out;
  read_fields(json, fields);
  out.reach_m = fields.reach_m;
  out.pasted = fields.pasted;
  const bool is_compared = json.find("similarity") || json.find("similarity_options");
  if (const auto name = json.find("similarity")) {
    out.similarity = name->text();
    out.similarity_options.clear();
  }
  if (const auto options = json.find("similarity_options"))
    out.similarity_options = options->options();
  if (is_compared) {
    json.naming([&] {
      static_cast<void>(
          similarity::shape_similarities().make(out.similarity, out.similarity_options));
    });
  }
  if (const auto replacement = json.find("replacement"))
    read_replacement(*replacement, out.replacement);
}

tiles::VacatedLand land_of(const ScriptJson& json) {
  const auto land = json.find("land");
  if (!land) return tiles::VacatedLand::kVacant;
  return land->choice({"vacant", "closed"}) == "closed" ? tiles::VacatedLand::kClosed
                                                        : tiles::VacatedLand::kVacant;
}

/// Reads the steps in order, knowing what was copied before.
class StepReader {
 public:
  explicit StepReader(const tiles::ReconfigurationOptions& defaults) : defaults_(defaults) {}

  ReconfigureStep read(const ScriptJson& json) {
    ReconfigureStep step;
    step.path = json.path();
    step.name = json.needed("do", "the name of an operation")
                    .choice({"move", "copy", "cut", "paste", "replace", "pin", "unpin", "relax",
                             "undo", "redo"});
    step.options = defaults_;
    if (const auto options = json.find("options")) read_options(*options, step.options);
    if (step.name == "move") {
      json.expect_only({"do", "options", "tiles", "by", "to", "angle_deg", "about"});
      step.what = MoveStep{selection_of(json), motion_of(json)};
    } else if (step.name == "copy") {
      json.expect_only({"do", "tiles", "as"});
      const std::string name = json.needed("as", "a name for paste").text();
      step.what = CopyStep{selection_of(json), name};
      groups_.insert(name);
    } else if (step.name == "cut") {
      json.expect_only({"do", "options", "tiles", "as", "land"});
      CutStep cut{selection_of(json), std::nullopt, land_of(json)};
      if (const auto name = json.find("as")) groups_.insert(*(cut.name = name->text()));
      step.what = std::move(cut);
    } else if (step.name == "paste") {
      json.expect_only({"do", "options", "group", "by", "to", "angle_deg", "about"});
      const ScriptJson group = json.needed("group", "the name that copy or cut gave");
      if (!groups_.contains(group.text()))
        group.refuse(fmt::format("no operation before copies or cuts \"{}\"", group.text()));
      step.what = PasteStep{group.text(), motion_of(json)};
    } else if (step.name == "replace") {
      json.expect_only({"do", "options"});
      step.what = ReplaceStep{step.options.replacement.value_or(tiles::ReplacementOptions{})};
    } else {
      read_plain(json, step);
    }
    return step;
  }

 private:
  static void read_plain(const ScriptJson& json, ReconfigureStep& step) {
    if (step.name == "pin" || step.name == "unpin") {
      json.expect_only({"do", "tiles"});
      if (step.name == "pin") {
        step.what = PinStep{selection_of(json)};
      } else {
        step.what = UnpinStep{selection_of(json)};
      }
    } else if (step.name == "relax") {
      json.expect_only({"do", "options"});
      step.what = RelaxStep{};
    } else {
      json.expect_only({"do"});
      if (step.name == "undo") {
        step.what = UndoStep{};
      } else {
        step.what = RedoStep{};
      }
    }
  }

  const tiles::ReconfigurationOptions& defaults_;
  std::set<std::string> groups_;
};

}  // namespace

ReconfigureScript parse_reconfigure_script(const nlohmann::json& value, const std::string& source) {
  const ScriptJson json(value, source);
  json.expect_only({"description", "defaults", "operations"});
  if (const auto description = json.find("description")) static_cast<void>(description->text());
  tiles::ReconfigurationOptions defaults;
  if (const auto given = json.find("defaults")) read_options(*given, defaults);
  ReconfigureScript script{source, {}};
  StepReader reader(defaults);
  for (const ScriptJson& each : json.needed("operations", "a list of what to do").list())
    script.steps.push_back(reader.read(each));
  return script;
}

ReconfigureScript read_reconfigure_script(const std::string& file) {
  return parse_reconfigure_script(read_json(file), file);
}

}  // namespace plat::harness
