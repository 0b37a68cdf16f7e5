#include "harness/observed_exemplar.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "core/failure.h"
#include "core/working_grid.h"
#include "geodata/dataset_catalogue.h"
#include "geodata/layer_io.h"
#include "harness/observed_layers.h"
#include "harness/observed_streets.h"
#include "streets/network_cleaning.h"
#include "streets/street_classes.h"
#include "streets/street_width.h"

namespace plat::harness {
namespace {

using geodata::GeometryKind;
using geodata::Layer;
using streets::RawStreet;
using streets::StreetNetwork;

constexpr const char* kOwner = "exemplar";

struct Observed {
  geodata::LocalFrame frame;
  std::vector<RawStreet> streets;
  std::vector<Polygon> parcels;
  std::vector<streets::Repair> repairs;
};

std::vector<RawStreet> raw_streets_of(const StreetNetwork& network) {
  std::vector<RawStreet> out;
  out.reserve(network.streets.size());
  for (const streets::Street& street : network.streets)
    out.push_back({street.source_id, street.line, street.attributes});
  return out;
}

Observed read_dataset(const geodata::Dataset& dataset, Jobs jobs) {
  ObservedStreets read = load_streets(dataset, jobs);
  return {std::move(read.frame), raw_streets_of(read.network), std::move(read.parcels),
          std::move(read.repairs)};
}

Observed read_files(const ExemplarSource& source) {
  Observed out;
  geodata::ReadOptions reading;
  if (!source.parcels.empty()) {
    reading.kind = GeometryKind::kPolygon;
    const Layer layer = geodata::read_layer(geodata::parse_layer_source(source.parcels), reading);
    reading.frame = layer.frame;
    for (const blocks::ObservedParcel& parcel : parcels_of(layer)) {
      Polygon shape = snap_polygon(parcel.shape);
      if (!shape.outer.empty()) out.parcels.push_back(std::move(shape));
    }
  }
  reading.kind = GeometryKind::kLine;
  const Layer layer = geodata::read_layer(geodata::parse_layer_source(source.city), reading);
  out.frame = layer.frame;
  streets::RawStreets raw = streets::import_streets(layer, source.fields);
  out.streets = std::move(raw.streets);
  out.repairs = std::move(raw.repairs);
  return out;
}

Observed read_city(const ExemplarSource& source, Jobs jobs) {
  const auto& known = geodata::catalogue();
  const auto dataset = std::find_if(known.begin(), known.end(),
                                    [&](const auto& entry) { return entry.name == source.city; });
  if (dataset == known.end()) return read_files(source);
  if (!source.parcels.empty())
    throw InputError(fmt::format(
        "--parcels: data set \"{}\" brings its own; name its file instead to choose", source.city));
  return read_dataset(*dataset, jobs);
}

/// The network without the streets that leave the window.
StreetNetwork inside(const StreetNetwork& network, const Box& window) {
  std::vector<RawStreet> kept = raw_streets_of(network);
  std::erase_if(kept, [&](const RawStreet& street) {
    return !std::all_of(street.line.begin(), street.line.end(),
                        [&](Point p) { return window.contains(p); });
  });
  return streets::build_network(kept).network;
}

}  // namespace

ObservedExemplar read_exemplar(const ExemplarSource& source, Jobs jobs) {
  Observed read = read_city(source, jobs);
  if (!source.has_all_classes) {
    std::erase_if(read.streets, [](const RawStreet& street) {
      return !streets::bounds_blocks(street.attributes.street_class,
                                     streets::BoundingClasses::kStreets);
    });
  }
  ObservedExemplar out;
  streets::CleanNetwork clean = streets::build_network(read.streets);
  out.network = std::move(clean.network);
  out.repairs = std::move(read.repairs);
  out.repairs.insert(out.repairs.end(), clean.repairs.begin(), clean.repairs.end());
  if (source.window)
    out.network = inside(out.network, {source.window->min - read.frame.origin,
                                       source.window->max - read.frame.origin});
  if (out.network.streets.empty())
    throw InputError(fmt::format("{}: no street {}", source.city,
                                 source.window ? "lies wholly in the window" : "is left"));
  out.frame = std::move(read.frame);
  out.parcel_count = read.parcels.size();
  streets::assign_widths(out.network, read.parcels, {}, jobs);
  out.exemplar = streets::exemplar_of(out.network, read.parcels, source.options);
  return out;
}

std::vector<FieldDescription> exemplar_option_fields() {
  std::vector<FieldDescription> out = describe_fields<streets::ChainOptions>();
  for (const auto& more :
       {describe_fields<streets::HierarchyOptions>(), describe_fields<streets::ExemplarOptions>()})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

streets::ExemplarOptions exemplar_options(const OptionMap& map) {
  const auto split = [&](const std::vector<FieldDescription>& fields) {
    OptionMap part;
    for (const FieldDescription& field : fields) {
      if (const auto it = map.find(field.name); it != map.end()) part.insert(*it);
    }
    return part;
  };
  const std::vector<FieldDescription> fields = exemplar_option_fields();
  std::vector<std::string_view> names;
  for (const FieldDescription& field : fields) names.push_back(field.name);
  detail::expect_known_keys(kOwner, map, names);
  auto out = from_option_map<streets::ExemplarOptions>(
      kOwner, split(describe_fields<streets::ExemplarOptions>()));
  out.chains = from_option_map<streets::ChainOptions>(
      kOwner, split(describe_fields<streets::ChainOptions>()));
  out.hierarchy = from_option_map<streets::HierarchyOptions>(
      kOwner, split(describe_fields<streets::HierarchyOptions>()));
  return out;
}

}  // namespace plat::harness
