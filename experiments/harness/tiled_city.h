#pragma once

#include <vector>

#include "core/parallel.h"
#include "harness/city_file.h"
#include "harness/observed_tiles.h"
#include "tiles/layout_construction.h"

namespace plat::harness {

/// A city whose land is tiles, and the pieces of land that did not become one.
struct TiledCity {
  PlacedCity placed;
  std::vector<tiles::TileFailure> failures;
};

/// The same city with tiles for its land: those that it has, else one for each parcel, and for each
/// block that could not be divided. The source id of a tile is its parcel's id ("block 12" of a
/// block), its zone the parcel's attribute `zone`.
TiledCity with_tiles_of_parcels(PlacedCity placed, Jobs jobs = {});

/// A city of observed tiles, and of the streets among them: those that come within
/// kStreetsAround_m of the tiles' box. It may have none.
TiledCity city_of_observed_tiles(ObservedTiles observed, const editing::CityOptions& options);

inline constexpr double kStreetsAround_m = 60.0;

}  // namespace plat::harness
