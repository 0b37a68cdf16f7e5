#include "harness/observed_layers.h"

#include <fmt/format.h>

#include <optional>

#include "core/failure.h"
#include "core/options.h"

namespace plat::harness {

std::string text_of(const geodata::Attribute& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
  return {};
}

std::vector<blocks::ObservedParcel> parcels_of(const geodata::Layer& layer,
                                               const std::string& id_field) {
  if (layer.kind != geodata::GeometryKind::kPolygon)
    throw InputError(
        fmt::format("layer \"{}\" holds no polygons: parcels are polygons", layer.name));
  std::optional<std::size_t> id_index;
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < layer.fields.size(); ++i) {
    known.emplace_back(layer.fields[i].name);
    if (layer.fields[i].name == id_field) id_index = i;
  }
  if (!id_field.empty() && !id_index) {
    throw InputError(fmt::format("layer \"{}\" has no field \"{}\"{}", layer.name, id_field,
                                 did_you_mean(id_field, known)));
  }
  std::vector<blocks::ObservedParcel> out;
  for (const geodata::Feature& feature : layer.features) {
    std::string id = id_index ? text_of(feature.attributes.at(*id_index)) : std::string();
    if (id.empty()) id = feature.id;
    if (feature.polygons.empty()) out.push_back({id, {}});
    for (std::size_t part = 0; part < feature.polygons.size(); ++part) {
      out.push_back({part == 0 ? id : fmt::format("{}#{}", id, part + 1), feature.polygons[part]});
    }
  }
  return out;
}

}  // namespace plat::harness
