#include "buildings/building_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/failure.h"
#include "core/options.h"

namespace plat::buildings {
namespace {

using nlohmann::json;

/// Reads the keys of one JSON object and refuses those that nobody asked for.
class Reader {
 public:
  Reader(const json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object.is_object()) refuse("must be an object");
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", where_, what));
  }

  const json* find(std::string_view key) {
    asked_.emplace(key);
    const auto at = object_.find(key);
    return at == object_.end() ? nullptr : &*at;
  }
  const json& needed(std::string_view key) {
    const json* value = find(key);
    if (value == nullptr) refuse(fmt::format("\"{}\" is missing", key));
    return *value;
  }
  const json& list(std::string_view key, std::size_t at_least) {
    const json& value = needed(key);
    if (!value.is_array() || value.size() < at_least)
      refuse(fmt::format("\"{}\" must be a list of at least {}", key, at_least));
    return value;
  }
  double number(std::string_view key, std::optional<double> fallback, double low, double high) {
    const json* value = fallback ? find(key) : &needed(key);
    if (value == nullptr) return *fallback;
    if (!value->is_number()) refuse(fmt::format("\"{}\" must be a number", key));
    const double number = value->get<double>();
    if (!(number >= low && number <= high))
      refuse(fmt::format("{} = {}, allowed {}..{}", key, number, low, high));
    return number;
  }
  std::uint32_t index(std::string_view key, std::size_t count) {
    const json& value = needed(key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
      refuse(fmt::format("\"{}\" must be a node: 0 to {}", key, count - 1));
    return value.get<std::uint32_t>();
  }
  void expect_nothing_else() const {
    for (const auto& [key, value] : object_.items()) {
      if (asked_.contains(key)) continue;
      std::vector<std::string_view> known(asked_.begin(), asked_.end());
      refuse(fmt::format("unknown key \"{}\"{}", key, did_you_mean(key, known)));
    }
  }
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  const json& object_;
  std::string where_;
  std::set<std::string, std::less<>> asked_;
};

/// No building is wider, or has more of anything.
constexpr double kLargestNumber = 1e6;

Point point_of(const Reader& reader, const json& value, std::string_view what) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
    reader.refuse(fmt::format("{} must be [x, y], metres", what));
  const Point p{value[0].get<double>(), value[1].get<double>()};
  if (!std::isfinite(p.x) || !std::isfinite(p.y))
    reader.refuse(fmt::format("{} is not finite", what));
  return p;
}

/// {"balconies": 3, "windows": [10, 20], "doors": [2, null]}
std::vector<AttributeBound> bounds_of(Reader& reader) {
  std::vector<AttributeBound> out;
  const json* bounds = reader.find("bounds");
  if (bounds == nullptr) return out;
  if (!bounds->is_object()) reader.refuse("\"bounds\" must be an object");
  for (const auto& [attribute, value] : bounds->items()) {
    const auto number = [&, &name = attribute](const json& each) {
      if (!each.is_number())
        reader.refuse(fmt::format(
            "bounds: {} must be a number, or [min, max] with null for an open end", name));
      const double amount = each.get<double>();
      if (!(amount >= 0.0 && amount <= kLargestNumber))
        reader.refuse(fmt::format("bounds: {} = {}, allowed 0..{}", name, amount, kLargestNumber));
      return amount;
    };
    AttributeBound& bound = out.emplace_back(AttributeBound{attribute, 0.0, std::nullopt});
    if (value.is_array() && value.size() == 2) {
      if (!value[0].is_null()) bound.min = number(value[0]);
      if (!value[1].is_null()) bound.max = number(value[1]);
    } else {
      bound.min = number(value);
      bound.max = bound.min;
    }
  }
  return out;
}

/// "left", "right", or the direction in which the front looks.
FrontSide front_of(Reader& reader, Point along) {
  const json& value = reader.needed("front");
  if (value == "left") return FrontSide::kLeft;
  if (value == "right") return FrontSide::kRight;
  if (!value.is_array())
    reader.refuse("\"front\" must be \"left\", \"right\" or the direction [x, y] it looks in");
  const double side = cross(along, point_of(reader, value, "\"front\""));
  if (side == 0.0) reader.refuse("\"front\" looks along the edge");
  return side > 0.0 ? FrontSide::kLeft : FrontSide::kRight;
}

BuildingSkeleton skeleton_in(const json& value, const std::string& where) {
  Reader reader(value, where);
  BuildingSkeleton skeleton;
  for (const json& node : reader.list("nodes", 2))
    skeleton.nodes.push_back(point_of(reader, node, fmt::format("node {}", skeleton.nodes.size())));
  for (const json& each : reader.list("edges", 1)) {
    Reader edge(each, fmt::format("{}: edge {}", where, skeleton.edges.size()));
    const std::uint32_t from = edge.index("from", skeleton.nodes.size());
    const std::uint32_t to = edge.index("to", skeleton.nodes.size());
    const FrontSide front = front_of(edge, skeleton.nodes[to] - skeleton.nodes[from]);
    skeleton.edges.push_back({from, to, front, bounds_of(edge)});
    edge.expect_nothing_else();
  }
  skeleton.bounds = bounds_of(reader);
  reader.expect_nothing_else();
  return skeleton;
}

TowerDesign tower_in(const json& value, const std::string& where) {
  Reader reader(value, where);
  TowerDesign tower;
  tower.height_m = reader.number("height_m", std::nullopt, kLengthQuantum_m, 2000.0);
  tower.ground_area_m2 =
      reader.number("ground_area_m2", std::nullopt, kFloorAreaQuantum_m2, kLargestNumber);
  tower.floor_area_ratio = reader.number("floor_area_ratio", std::nullopt, 0.01, 1000.0);
  tower.bounds = bounds_of(reader);
  reader.expect_nothing_else();
  return tower;
}

ContourDesign contour_in(const json& value, const std::string& where) {
  Reader reader(value, where);
  ContourDesign design;
  for (const json& corner : reader.list("ring", 3))
    design.contour.push_back(
        point_of(reader, corner, fmt::format("corner {}", design.contour.size())));
  if (design.contour.front() == design.contour.back()) design.contour.pop_back();
  if (signed_area_m2(design.contour) < 0.0) std::ranges::reverse(design.contour);
  design.offset_m = reader.number("offset_m", design.offset_m, 0.0, 1000.0);
  design.min_edge_m = reader.number("min_edge_m", design.min_edge_m, kLengthQuantum_m, 1000.0);
  design.bounds = bounds_of(reader);
  reader.expect_nothing_else();
  return design;
}

AttributeSteps steps_in(Reader& reader) {
  AttributeSteps steps;
  const json* value = reader.find("steps");
  if (value == nullptr) return steps;
  Reader list(*value, fmt::format("{}: steps", reader.where()));
  for (const auto& [attribute, step] : value->items())
    steps[attribute] = list.number(attribute, std::nullopt, 1e-3, kLargestNumber);
  return steps;
}

Preferences preferences_in(Reader& reader) {
  Preferences out;
  const json* value = reader.find("preferences");
  if (value == nullptr) return out;
  Reader keys(*value, fmt::format("{}: preferences", reader.where()));
  out.part_m2 = keys.number("part_m2", out.part_m2, 0.0, kLargestNumber);
  out.variety_m2 = keys.number("variety_m2", out.variety_m2, 0.0, kLargestNumber);
  out.seed = static_cast<std::uint64_t>(keys.number("seed", 0.0, 0.0, kLargestNumber));
  keys.expect_nothing_else();
  return out;
}

}  // namespace

BuildingDesign read_building_design(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("{}: cannot be opened", file.string()));
  json document;
  try {
    document = json::parse(stream);
  } catch (const json::parse_error& error) {
    throw InputError(fmt::format("{}: not JSON: {}", file.string(), error.what()));
  }
  Reader reader(document, file.string());
  BuildingDesign design;
  if (const json* name = reader.find("name")) {
    if (!name->is_string()) reader.refuse("\"name\" must be text");
    design.name = name->get<std::string>();
  }
  const std::string where = file.string();
  const json* skeleton = reader.find("skeleton");
  const json* tower = reader.find("tower");
  const json* contour = reader.find("contour");
  if ((skeleton != nullptr) + (tower != nullptr) + (contour != nullptr) != 1)
    reader.refuse("one of \"skeleton\", \"tower\" and \"contour\" is needed");
  if (skeleton != nullptr) design.shape = skeleton_in(*skeleton, where + ": skeleton");
  if (tower != nullptr) design.shape = tower_in(*tower, where + ": tower");
  if (contour != nullptr) design.shape = contour_in(*contour, where + ": contour");
  design.steps = steps_in(reader);
  design.preferences = preferences_in(reader);
  reader.expect_nothing_else();
  return design;
}

}  // namespace plat::buildings
