#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editing/city.h"
#include "geodata/layer.h"

namespace plat::harness {

/// A city under edit with its place on Earth.
struct PlacedCity {
  editing::City city;
  geodata::LocalFrame frame;
};

/// The layers of a city: document, streets, blocks, parcels, those of its tiles where it has any
/// (tile_document.h), failures (docs/edit_script.md).
/// Reading them back gives the same city.
std::vector<geodata::Layer> city_layers(const editing::City& city,
                                        const geodata::LocalFrame& frame);

struct CityReading {
  editing::CityOptions options;  ///< of a city that is made, not of one that was written
  /// Fields of the file's `blocks` layer with the strategy and its options ("key=value;...") of
  /// each block; empty: every block has the style of `options`.
  std::string strategy_field;
  std::string options_field;
};

/// A city from a GeoPackage: as it was written where it has the layer `document`; else made from
/// its layer `streets`, as plat blocks writes it.
/// @throws InputError for a file that cannot be read or was changed so that it is no city
PlacedCity read_city(const std::string& file, const CityReading& reading);

}  // namespace plat::harness
