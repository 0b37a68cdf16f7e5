#include "harness/observed_streets.h"

#include <fmt/format.h>

#include <utility>

#include "core/failure.h"
#include "core/working_grid.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "streets/street_width.h"

namespace plat::harness {
namespace {

using geodata::GeometryKind;
using geodata::Layer;
using geodata::LayerMapping;

streets::StreetFields street_fields(const LayerMapping& mapping) {
  streets::StreetFields fields;
  fields.name = mapped_field(mapping, "name");
  fields.street_class = mapped_field(mapping, "class");
  fields.width = mapped_field(mapping, "width");
  fields.lanes = mapped_field(mapping, "lanes");
  fields.level = mapped_field(mapping, "layer");
  fields.structure = mapped_field(mapping, "structure");
  if (const std::string major = mapped_field(mapping, "major"); !major.empty()) {
    fields.street_class = major;
    fields.class_prefix = "major_";
    fields.default_class = "local";
  }
  return fields;
}

/// Parcels that keep an area on the working grid.
std::vector<Polygon> parcels_in(const Layer& layer) {
  std::vector<Polygon> out;
  for (const geodata::Feature& feature : layer.features) {
    for (const Polygon& shape : feature.polygons) {
      Polygon parcel = snap_polygon(shape);
      if (!parcel.outer.empty()) out.push_back(std::move(parcel));
    }
  }
  return out;
}

}  // namespace

std::string mapped_field(const LayerMapping& mapping, std::string_view name) {
  const auto it = mapping.fields.find(std::string(name));
  return it == mapping.fields.end() ? std::string() : it->second;
}

Layer read_mapped(const LayerMapping& mapping, const std::filesystem::path& folder,
                  GeometryKind kind, const std::optional<geodata::LocalFrame>& frame) {
  geodata::ReadOptions options;
  options.kind = kind;
  options.where = mapping.where;
  options.frame = frame;
  return geodata::read_layer(geodata::source_of(mapping, folder), options);
}

ObservedStreets read_streets(const LayerMapping& mapping, const std::filesystem::path& folder,
                             const std::optional<geodata::LocalFrame>& frame) {
  const Layer layer = read_mapped(mapping, folder, GeometryKind::kLine, frame);
  streets::RawStreets raw = streets::import_streets(layer, street_fields(mapping));
  streets::CleanNetwork clean = streets::build_network(raw.streets);
  ObservedStreets out{layer.frame, std::move(clean.network), {}, std::move(raw.repairs)};
  out.repairs.insert(out.repairs.end(), clean.repairs.begin(), clean.repairs.end());
  return out;
}

ObservedStreets load_streets(const geodata::Dataset& dataset, Jobs jobs,
                             const std::filesystem::path& folder) {
  if (!dataset.observed || !dataset.observed->streets)
    throw InputError(
        fmt::format("data set \"{}\" has no streets: see plat data list", dataset.name));
  if (!geodata::locate(dataset, folder)) {
    throw InputError(fmt::format("data set \"{}\" is not complete in {}: plat data fetch {}",
                                 dataset.name, folder.string(), dataset.name));
  }
  const geodata::ObservedMapping& mapping = *dataset.observed;
  const bool has_parcels =
      mapping.plots == geodata::PlotOrigin::kObserved && mapping.parcels.has_value();
  std::optional<geodata::LocalFrame> frame;
  std::vector<Polygon> parcels;
  if (has_parcels) {
    const Layer layer = read_mapped(*mapping.parcels, folder, GeometryKind::kPolygon, std::nullopt);
    frame = layer.frame;
    parcels = parcels_in(layer);
  }
  ObservedStreets out = read_streets(*mapping.streets, folder, frame);
  streets::assign_widths(out.network, parcels, {}, jobs);
  out.parcels = std::move(parcels);
  return out;
}

}  // namespace plat::harness
