#pragma once

#include <optional>
#include <string>
#include <vector>

#include "blocks/blocks_from_parcels.h"
#include "core/parallel.h"
#include "geodata/layer_io.h"
#include "imagery/parcel_shape.h"

namespace plat::harness {

/// Where the parcels of a city are, and what tells which of their sides face streets.
struct ParcelShapeSources {
  geodata::LayerSource parcels;
  std::optional<geodata::LayerSource> blocks{};   ///< else unions of the parcels
  std::optional<geodata::LayerSource> streets{};  ///< else gaps between blocks
  std::string zone_field{};                       ///< empty: no zones
};

/// "FILE", whose layers parcels, blocks and streets are taken where it has them, or "FILE:layer"
/// for parcels alone. @throws InputError where the file has several layers, none called parcels
ParcelShapeSources parcel_shape_sources(const std::string& city);

/// A parcel of a city, its block, and which parts of its boundary face streets.
struct FrontedParcel {
  std::string id;
  std::string zone;
  Polygon polygon;                     ///< on the working grid
  std::optional<std::uint32_t> block;  ///< none: in no block, streets unknown
  std::vector<Segment> fronts;         ///< as parcels::street_fronts gives them
};

struct ReadFrontedParcels {
  geodata::LocalFrame frame;
  std::vector<FrontedParcel> parcels;          ///< in file order
  std::vector<blocks::BlockFailure> failures;  ///< features that are no usable parcel
  std::size_t without_streets = 0;             ///< parcels in no block
};

/// Every polygon of the layer with its fronts along the street edges of its block.
/// @throws InputError as geodata::read_layer
ReadFrontedParcels read_fronted_parcels(const ParcelShapeSources& sources, Jobs jobs);

struct ReadParcelShapes {
  geodata::LocalFrame frame;
  std::vector<imagery::ParcelShape> shapes;    ///< on the working grid, in file order
  std::vector<blocks::BlockFailure> failures;  ///< features that are no usable parcel
  std::size_t without_streets = 0;             ///< shapes in no block: their streets are unknown
};

/// Every polygon of the layer as a shape, with the sides that face streets.
/// @throws InputError as geodata::read_layer
ReadParcelShapes read_parcel_shapes(const ParcelShapeSources& sources, Jobs jobs);

}  // namespace plat::harness
