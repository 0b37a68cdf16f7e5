#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "geodata/dataset_catalogue.h"
#include "harness/city.h"
#include "streets/street_network.h"
#include "tiles/layout_construction.h"

namespace plat::harness {

/// Which part of a place.
struct TileSelection {
  std::optional<std::size_t> count{};  ///< that many tiles; none: all
  /// The tiles nearest to this point of the place's projected CRS, metres east and north; none: to
  /// the middle of the place.
  std::optional<Point> near{};
};

/// An observed place as tiles: its parcels, or its blocks where no parcels are observed.
struct ObservedTiles {
  std::string dataset;
  geodata::LocalFrame frame;
  streets::StreetNetwork network;        ///< may be empty
  std::vector<tiles::TilePiece> pieces;  ///< what tiles were made of
  tiles::LayoutConstruction tiles;
};

/// Numbers of [ABVA08, Table 1].
struct LayoutCounts {
  /// That links cross, each name once (a street without a name once for each feature); where no
  /// streets are known, pairs of blocks that links join.
  std::size_t streets = 0;
  std::size_t boundaries = 0;  ///< pairs of tiles that have an edge in common
  std::size_t tiles = 0;
  std::size_t blocks = 0;
  std::size_t vertices = 0;
  std::size_t joints = 0;  ///< vertices that constrain
  std::size_t links = 0;
};
LayoutCounts counts_of(const tiles::TileLayout& layout, const streets::StreetNetwork& network);

/// Reads a data set of the catalogue and makes tiles of it: parcels where they are observed, blocks
/// of the street network elsewhere (where plots would be cells around footprints, too). Zones are
/// those of land_use.h.
/// @throws InputError for a data set without streets and parcels, or that is not in `folder`
ObservedTiles load_tiles(const geodata::Dataset& dataset, const TileSelection& selection = {},
                         const tiles::ConstructionOptions& options = {}, Jobs jobs = {},
                         const std::filesystem::path& folder = geodata::data_dir());

/// Where pieces of land come from that are no data set of the catalogue.
struct TileSources {
  std::string parcels;     ///< "FILE[:layer]"
  std::string id_field;    ///< empty: the features' ids
  std::string zone_field;  ///< empty: zones are unknown
  std::string streets;     ///< centrelines, "FILE[:layer]"; empty: none are known
};
/// The same from layers. The point of the selection is in the parcels' frame's CRS.
/// @throws InputError for a layer that cannot be read, or has no such field
ObservedTiles read_tiles(const TileSources& sources, const TileSelection& selection = {},
                         const tiles::ConstructionOptions& options = {}, Jobs jobs = {});

/// The streets of a network as lines that links lie on: streets proper, no paths or rails.
std::vector<tiles::StreetLine> street_lines(const streets::StreetNetwork& network);

/// The pieces nearest to a point of the local frame, by their centroids; in their order.
std::vector<tiles::TilePiece> nearest_pieces(std::vector<tiles::TilePiece> pieces, Point to,
                                             std::size_t count);

}  // namespace plat::harness
