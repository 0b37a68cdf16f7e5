#include "streets/street_import.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/failure.h"
#include "core/options.h"

namespace plat::streets {
namespace {

using geodata::Attribute;
using geodata::Feature;
using geodata::Layer;

std::string text_of(const Attribute& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
  return {};
}

std::optional<std::size_t> find_field(const Layer& layer, std::string_view name) {
  for (std::size_t i = 0; i < layer.fields.size(); ++i) {
    if (layer.fields[i].name == name) return i;
  }
  return std::nullopt;
}

/// The value of a key in OpenStreetMap's "\"key\"=>\"value\",..." text; empty where there is none.
std::string tag_value(std::string_view tags, std::string_view key) {
  const std::string wanted = fmt::format("\"{}\"=>\"", key);
  const std::size_t at = tags.find(wanted);
  if (at == std::string_view::npos) return {};
  std::string value;
  for (std::size_t i = at + wanted.size(); i < tags.size() && tags[i] != '"'; ++i) {
    if (tags[i] == '\\' && i + 1 < tags.size()) ++i;
    value += tags[i];
  }
  return value;
}

/// Reads one attribute of a street from the field that was named, or from OpenStreetMap's. A named
/// one that is no field is looked for in `other_tags`, as layer_io.h does.
class FieldReader {
 public:
  FieldReader(const Layer& layer, const std::string& named,
              std::initializer_list<std::string_view> usual)
      : usual_(usual), tags_(find_field(layer, "other_tags")) {
    if (!named.empty()) {
      const auto field = find_field(layer, named);
      if (!field && tags_) {
        usual_ = {named};
        is_named_ = false;
        return;
      }
      if (!field) {
        std::vector<std::string_view> known;
        for (const auto& f : layer.fields) known.emplace_back(f.name);
        throw InputError(fmt::format("layer \"{}\" has no field \"{}\"{}", layer.name, named,
                                     did_you_mean(named, known)));
      }
      fields_.push_back(*field);
      return;
    }
    for (const std::string_view name : usual_) {
      if (const auto field = find_field(layer, name)) fields_.push_back(*field);
    }
    is_named_ = false;
  }

  [[nodiscard]] std::string read(const Feature& feature) const {
    for (const std::size_t field : fields_) {
      std::string text = text_of(feature.attributes.at(field));
      if (!text.empty()) return text;
    }
    if (is_named_ || !tags_) return {};
    const std::string tags = text_of(feature.attributes.at(*tags_));
    for (const std::string_view name : usual_) {
      std::string text = tag_value(tags, name);
      if (!text.empty()) return text;
    }
    return {};
  }

 private:
  std::vector<std::string_view> usual_;
  std::optional<std::size_t> tags_;
  std::vector<std::size_t> fields_;
  bool is_named_ = true;
};

/// The number that a text starts with; a list ("2;3") counts with its first entry.
std::optional<double> leading_number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  constexpr double kMetresPerFoot = 0.3048;
  if (end != text.data() + text.size() && *end == '\'') value *= kMetresPerFoot;
  return value;
}

bool is_set(std::string_view value) {
  return !value.empty() && value != "no" && value != "none" && value != "0";
}

class StreetReader {
 public:
  StreetReader(const Layer& layer, const StreetFields& fields)
      : options_(fields),
        name_(layer, fields.name, {"name", "Street"}),
        class_(layer, fields.street_class, {"highway", "class"}),
        width_(layer, fields.width, {"width", "width_m"}),
        lanes_(layer, fields.lanes, {"lanes"}),
        level_(layer, fields.level, {"layer"}),
        structure_(layer, fields.structure, {"structure"}),
        bridge_(layer, {}, {"bridge"}),
        tunnel_(layer, {}, {"tunnel"}),
        is_osm_(fields.street_class.empty() && find_field(layer, "highway").has_value()) {}

  void read(const Feature& feature, RawStreets& out) const {
    const Point place = feature.lines.front().empty() ? Point{} : feature.lines.front().front();
    StreetAttributes attributes;
    attributes.name = name_.read(feature);
    attributes.street_class = class_.read(feature);
    if (attributes.street_class.empty() && is_osm_) {
      out.repairs.push_back(
          {feature.id, RepairKind::kNotUsed, place, "no highway value: not a street"});
      return;
    }
    attributes.street_class = attributes.street_class.empty()
                                  ? options_.default_class
                                  : options_.class_prefix + attributes.street_class;
    const auto number = [&](const FieldReader& reader, std::string_view what, double low,
                            double high) -> std::optional<double> {
      const std::string text = reader.read(feature);
      if (text.empty()) return std::nullopt;
      const auto value = leading_number(text);
      if (value && *value >= low && *value <= high) return value;
      out.repairs.push_back(
          {feature.id, RepairKind::kBadValue, place,
           fmt::format("{} \"{}\" ignored, {} to {} expected", what, text, low, high)});
      return std::nullopt;
    };
    attributes.given_width_m = number(width_, "width", 0.5, 150.0);
    attributes.lanes = number(lanes_, "lanes", 1.0, 16.0);
    const std::string structure = structure_.read(feature);
    const bool is_bridge = structure == "bridge" || is_set(bridge_.read(feature));
    const bool is_tunnel = structure == "tunnel" || is_set(tunnel_.read(feature));
    const double level = number(level_, "level", -10.0, 10.0).value_or(0.0);
    attributes.level = static_cast<int>(level);
    if (attributes.level == 0 && is_bridge) attributes.level = 1;
    if (attributes.level == 0 && is_tunnel) attributes.level = -1;
    attributes.structure = attributes.level > 0   ? Structure::kBridge
                           : attributes.level < 0 ? Structure::kTunnel
                                                  : Structure::kGround;
    for (const Polyline& line : feature.lines)
      out.streets.push_back({feature.id, line, attributes});
  }

 private:
  StreetFields options_;
  FieldReader name_;
  FieldReader class_;
  FieldReader width_;
  FieldReader lanes_;
  FieldReader level_;
  FieldReader structure_;
  FieldReader bridge_;
  FieldReader tunnel_;
  bool is_osm_;
};

}  // namespace

RawStreets import_streets(const Layer& layer, const StreetFields& fields) {
  if (layer.kind != geodata::GeometryKind::kLine)
    throw InputError(
        fmt::format("layer \"{}\" holds no lines: streets are read from lines", layer.name));
  const StreetReader reader(layer, fields);
  RawStreets out;
  for (const Feature& feature : layer.features) {
    if (feature.lines.empty()) {
      out.repairs.push_back({feature.id, RepairKind::kNotUsed, {}, "the feature has no line"});
      continue;
    }
    reader.read(feature, out);
  }
  return out;
}

}  // namespace plat::streets
