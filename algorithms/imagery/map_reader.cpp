#include "imagery/map_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <span>

#include "core/failure.h"
#include "core/options.h"
#include "streets/network_cleaning.h"
#include "streets/street_width.h"

namespace plat::imagery {
namespace {

using geodata::GeometryKind;
using geodata::Layer;
using geodata::LayerSource;

constexpr double kStorey_m = 3.0;
constexpr double kAssumedHeight_m = 6.0;
/// A height outside these is a mistake of the map, or a code for "not known".
constexpr double kLeastHeight_m = 1.5;
constexpr double kMostHeight_m = 450.0;

/// The named field, or the first of the usual ones that the layer has.
std::optional<std::size_t> field_of(const Layer& layer, const std::string& file,
                                    const std::string& named,
                                    std::initializer_list<std::string_view> usual) {
  const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < layer.fields.size(); ++i) {
      if (layer.fields[i].name == name) return i;
    }
    return std::nullopt;
  };
  if (!named.empty()) {
    const auto found = find(named);
    if (found) return found;
    std::vector<std::string_view> known;
    for (const auto& field : layer.fields) known.emplace_back(field.name);
    throw InputError(fmt::format("{}:{}: no field \"{}\"{}", file, layer.name, named,
                                 did_you_mean(named, known)));
  }
  for (const std::string_view name : usual) {
    if (const auto found = find(name)) return found;
  }
  return std::nullopt;
}

std::optional<double> number_in(const geodata::Feature& feature, std::optional<std::size_t> field) {
  if (!field) return std::nullopt;
  const geodata::Attribute& value = feature.attributes[*field];
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

class MapReader {
 public:
  MapReader(const MapSources& sources, Jobs jobs) : sources_(sources), jobs_(jobs) {}

  MapLayers read() {
    out_.parcels = polygons(sources_.parcels);
    read_streets();
    read_footprints();
    out_.water = polygons(sources_.water);
    out_.open_space = polygons(sources_.open_space);
    if (!has_frame_) {
      throw InputError(
          "no layer is given to render; give streets, parcels, footprints, water or open space");
    }
    return std::move(out_);
  }

 private:
  Layer layer(const LayerSource& source, GeometryKind kind) {
    geodata::ReadOptions options;
    options.kind = kind;
    if (has_frame_) options.frame = out_.frame;
    Layer found = geodata::read_layer(source, options);
    out_.frame = found.frame;
    has_frame_ = true;
    return found;
  }

  static bool is_finite(const Polygon& polygon) {
    bool is_good = polygon.outer.size() >= 3;
    for_each_edge(polygon, [&](const Segment& s) {
      is_good = is_good && std::isfinite(s.a.x) && std::isfinite(s.a.y);
    });
    return is_good;
  }

  std::vector<Polygon> polygons(const std::optional<LayerSource>& source) {
    std::vector<Polygon> found;
    if (!source) return found;
    Layer read = layer(*source, GeometryKind::kPolygon);
    for (geodata::Feature& feature : read.features) {
      for (Polygon& polygon : feature.polygons) {
        if (is_finite(polygon)) found.push_back(std::move(polygon));
      }
    }
    return found;
  }

  void read_streets() {
    if (!sources_.streets) return;
    const Layer read = layer(*sources_.streets, GeometryKind::kLine);
    const streets::RawStreets raw = streets::import_streets(read, sources_.street_fields);
    out_.streets = streets::build_network(raw.streets).network;
    streets::assign_widths(out_.streets, out_.parcels, {}, jobs_);
  }

  void read_footprints() {
    if (!sources_.footprints) return;
    Layer read = layer(*sources_.footprints, GeometryKind::kPolygon);
    const std::string& file = sources_.footprints->file;
    const auto height = field_of(read, file, sources_.height_field, {"height_m", "height"});
    const auto storeys =
        field_of(read, file, sources_.storeys_field,
                 {"storeys", "floors", "levels", "building:levels", "numberOfFloorsAboveGround"});
    const auto is_height = [](std::optional<double> h) {
      return h && *h >= kLeastHeight_m && *h <= kMostHeight_m;
    };
    for (geodata::Feature& feature : read.features) {
      Footprint footprint{{}, kAssumedHeight_m, HeightSource::kAssumed};
      const std::optional<double> given = number_in(feature, height);
      std::optional<double> counted = number_in(feature, storeys);
      // A part without storeys above the ground is a cellar's lid or an open porch.
      if (counted) counted = kStorey_m * std::max(*counted, 0.5);
      if (is_height(given)) {
        footprint.height_m = *given;
        footprint.height_source = HeightSource::kAttribute;
      } else if (is_height(counted)) {
        footprint.height_m = *counted;
        footprint.height_source = HeightSource::kStoreys;
      }
      for (Polygon& polygon : feature.polygons) {
        if (!is_finite(polygon)) continue;
        footprint.shape = std::move(polygon);
        out_.footprints.push_back(footprint);
      }
    }
  }

  const MapSources& sources_;
  Jobs jobs_;
  MapLayers out_;
  bool has_frame_ = false;
};

}  // namespace

MapSources map_sources_in(const std::string& file) {
  const std::vector<geodata::LayerInfo> layers = geodata::list_layers(file);
  const auto find =
      [&](std::initializer_list<std::string_view> names) -> std::optional<LayerSource> {
    for (const std::string_view name : names) {
      for (const geodata::LayerInfo& layer : layers) {
        if (layer.name == name && layer.feature_count != 0) return LayerSource{file, layer.name};
      }
    }
    return std::nullopt;
  };
  MapSources out;
  out.streets = find({"streets", "roads", "road"});
  out.parcels = find({"parcels"});
  out.footprints = find({"footprints", "building_parts", "buildings", "building"});
  out.water = find({"water"});
  out.open_space = find({"open_space", "parks"});
  if (!out.streets && !out.parcels && !out.footprints) {
    throw InputError(fmt::format(
        "{}: has no layer named streets, parcels or footprints; name its layers one by one", file));
  }
  return out;
}

MapLayers read_map(const MapSources& sources, Jobs jobs) { return MapReader(sources, jobs).read(); }

}  // namespace plat::imagery
