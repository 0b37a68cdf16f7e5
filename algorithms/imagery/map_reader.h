#pragma once

#include <optional>
#include <string>

#include "core/parallel.h"
#include "geodata/layer_io.h"
#include "imagery/map_layers.h"
#include "streets/street_import.h"

namespace plat::imagery {

/// Where the layers of a map are; what is not given stays empty.
struct MapSources {
  std::optional<geodata::LayerSource> streets{};
  std::optional<geodata::LayerSource> parcels{};
  std::optional<geodata::LayerSource> footprints{};
  std::optional<geodata::LayerSource> water{};
  std::optional<geodata::LayerSource> open_space{};
  streets::StreetFields street_fields{};
  std::string height_field{};   ///< of footprints, metres; empty: "height_m" or "height"
  std::string storeys_field{};  ///< of footprints; empty: "storeys", "floors", ... (INSPIRE's too)
};

/// The layers of one file by their usual names: streets (roads, road), parcels, footprints
/// (building_parts, buildings, building), water, open_space (parks). Empty layers are left out.
/// @throws InputError where the file cannot be read or has neither streets nor parcels nor
///   footprints
MapSources map_sources_in(const std::string& file);

/// Reads all layers into the frame of the first that is given: parcels, streets, footprints, water,
/// open space. Streets are cleaned and noded; widths as assign_widths() finds them, between the
/// parcels. Heights: the height field, else storeys of 3 m each, else 6 m, assumed.
/// @throws InputError as read_layer(); where nothing is given; for a field that a layer lacks
MapLayers read_map(const MapSources& sources, Jobs jobs = {});

}  // namespace plat::imagery
