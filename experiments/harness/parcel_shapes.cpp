#include "harness/parcel_shapes.h"

#include <algorithm>
#include <span>
#include <utility>

#include "blocks/block_assignment.h"
#include "core/failure.h"
#include "core/validity.h"
#include "core/working_grid.h"
#include "harness/block_reading.h"
#include "harness/observed_layers.h"
#include "parcels/parcel_measures.h"

namespace plat::harness {
namespace {

constexpr std::size_t kMaxParcelVertices = 5000;

/// A parcel may touch itself in a point; its box and contour do not mind.
Expected<Polygon> admit_parcel(const Polygon& raw) {
  auto strict = admit_polygon(raw, kMaxParcelVertices);
  if (strict || strict.error().code == FailureCode::kNotFinite) return strict;
  Polygon snapped = snap_polygon(raw);
  if (snapped.outer.size() < 3 || snapped.outer.size() > kMaxParcelVertices ||
      find_ogc_defect(snapped) || !(area_m2(snapped) > 0.0))
    return strict;
  return snapped;
}

/// Per polygon of the layer, in the order of parcels_of().
std::vector<std::string> zones_of(const geodata::Layer& layer, const std::string& field) {
  std::vector<std::string> zones;
  std::optional<std::size_t> column;
  for (std::size_t i = 0; i < layer.fields.size(); ++i) {
    if (!field.empty() && layer.fields[i].name == field) column = i;
  }
  for (const geodata::Feature& feature : layer.features) {
    const std::string zone = column ? text_of(feature.attributes[*column]) : std::string();
    zones.insert(zones.end(), std::max<std::size_t>(1, feature.polygons.size()), zone);
  }
  return zones;
}

ReadBlocks blocks_of(const ParcelShapeSources& sources, const geodata::LocalFrame& frame,
                     const std::vector<blocks::ObservedParcel>& parcels, Jobs jobs) {
  ReadBlocks read;
  if (sources.blocks) {
    read = read_blocks(*sources.blocks, jobs, frame);
  } else {
    read.frame = frame;
    read.blocks = blocks::blocks_from_parcels(parcels, {}, jobs).blocks;
  }
  label_from_streets(read, sources.streets ? geodata::to_string(*sources.streets) : std::string(),
                     jobs);
  return read;
}

struct Admitted {
  std::vector<blocks::ObservedParcel> parcels;
  std::vector<std::string> zones;
};

Admitted admit_all(const geodata::Layer& layer, const std::string& zone_field, Jobs jobs,
                   std::vector<blocks::BlockFailure>& failures) {
  const std::vector<blocks::ObservedParcel> observed = parcels_of(layer);
  const std::vector<std::string> zones = zones_of(layer, zone_field);
  expects(zones.size() == observed.size(), "a zone per polygon");
  const auto admitted = parallel_map<Expected<Polygon>>(
      observed.size(), jobs, [&](std::size_t i) { return admit_parcel(observed[i].shape); });
  Admitted out;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (admitted[i]) {
      out.parcels.push_back({observed[i].id, *admitted[i]});
      out.zones.push_back(zones[i]);
    } else {
      failures.push_back({observed[i].id, admitted[i].error(), observed[i].shape});
    }
  }
  return out;
}

}  // namespace

ParcelShapeSources parcel_shape_sources(const std::string& city) {
  ParcelShapeSources sources;
  sources.parcels = geodata::parse_layer_source(city);
  if (sources.parcels.layer) return sources;
  const std::vector<geodata::LayerInfo> layers = geodata::list_layers(sources.parcels.file);
  const auto named = [&](std::string_view name) -> std::optional<geodata::LayerSource> {
    for (const geodata::LayerInfo& layer : layers) {
      if (layer.name == name && layer.feature_count != 0)
        return geodata::LayerSource{sources.parcels.file, layer.name};
    }
    return std::nullopt;
  };
  if (const auto parcels = named("parcels")) {
    sources.parcels = *parcels;
  } else if (layers.size() != 1) {
    throw InputError(city + ": has several layers and none called parcels; name it FILE:layer");
  }
  sources.blocks = named("blocks");
  sources.streets = named("streets");
  return sources;
}

ReadFrontedParcels read_fronted_parcels(const ParcelShapeSources& sources, Jobs jobs) {
  geodata::ReadOptions options{.kind = geodata::GeometryKind::kPolygon};
  if (!sources.zone_field.empty()) options.fields.push_back(sources.zone_field);
  const geodata::Layer layer = geodata::read_layer(sources.parcels, options);
  ReadFrontedParcels out;
  out.frame = layer.frame;
  Admitted admitted = admit_all(layer, sources.zone_field, jobs, out.failures);
  const ReadBlocks city = blocks_of(sources, layer.frame, admitted.parcels, jobs);
  std::vector<Polygon> polygons;
  for (const blocks::ObservedParcel& parcel : admitted.parcels) polygons.push_back(parcel.shape);
  const blocks::BlockAssignment homes = blocks::assign_to_blocks(city.blocks, polygons);
  out.without_streets = homes.outside.size();
  out.parcels.resize(polygons.size());
  parallel_for(city.blocks.size(), jobs, [&](std::size_t b) {
    std::vector<Polygon> inside;
    for (const std::uint32_t i : homes.of_block[b]) inside.push_back(polygons[i]);
    auto fronts = parcels::street_fronts(city.blocks[b], inside);
    for (std::size_t k = 0; k < inside.size(); ++k) {
      FrontedParcel& parcel = out.parcels[homes.of_block[b][k]];
      parcel.block = static_cast<std::uint32_t>(b);
      parcel.fronts = std::move(fronts[k]);
    }
  });
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    out.parcels[i].id = std::move(admitted.parcels[i].id);
    out.parcels[i].zone = std::move(admitted.zones[i]);
    out.parcels[i].polygon = std::move(polygons[i]);
  }
  return out;
}

ReadParcelShapes read_parcel_shapes(const ParcelShapeSources& sources, Jobs jobs) {
  ReadFrontedParcels read = read_fronted_parcels(sources, jobs);
  ReadParcelShapes out{read.frame, {}, std::move(read.failures), read.without_streets};
  out.shapes = parallel_map<imagery::ParcelShape>(read.parcels.size(), jobs, [&](std::size_t i) {
    FrontedParcel& parcel = read.parcels[i];
    std::optional<std::span<const Segment>> fronts;
    if (parcel.block) fronts = parcel.fronts;
    imagery::ParcelShape shape = imagery::shape_of(std::move(parcel.polygon), fronts);
    shape.id = std::move(parcel.id);
    shape.zone = std::move(parcel.zone);
    return shape;
  });
  return out;
}

}  // namespace plat::harness
