#pragma once

#include <optional>
#include <vector>

#include "core/polygon.h"
#include "geodata/layer.h"
#include "streets/street_network.h"

namespace plat::imagery {

/// Where the height of a building comes from.
enum class HeightSource {
  kAttribute,  ///< a height field of the layer
  kStoreys,    ///< its number of storeys times a storey's height
  kAssumed,    ///< neither
};

/// A building as a map has it.
struct Footprint {
  Polygon shape;
  double height_m = 0.0;  ///< of the eaves above the ground
  HeightSource height_source = HeightSource::kAssumed;
};

/// The map that an orthophoto is rendered from, in one local frame. Every layer may be empty.
struct MapLayers {
  geodata::LocalFrame frame;
  streets::StreetNetwork streets;  ///< with widths: from plot to plot, pavements included
  std::vector<Polygon> parcels;
  std::vector<Footprint> footprints;
  std::vector<Polygon> water;
  std::vector<Polygon> open_space;  ///< parks, cemeteries, playing fields
};

/// Of all layers; empty where they are.
Box box_of(const MapLayers& layers);

}  // namespace plat::imagery
