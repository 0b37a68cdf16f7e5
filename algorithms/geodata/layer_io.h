#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geodata/layer.h"

namespace plat::geodata {

/// A file and, where it holds several, the layer in it.
struct LayerSource {
  std::string file;
  std::optional<std::string> layer{};

  friend bool operator==(const LayerSource&, const LayerSource&) = default;
};

/// "FILE[:layer]". A file that exists under the whole text wins; else the last colon separates the
/// layer, unless a slash follows it.
LayerSource parse_layer_source(std::string_view text);

/// "FILE:layer", or "FILE": how messages name a source.
std::string to_string(const LayerSource& source);

/// What is in a file, without reading the features.
struct LayerInfo {
  std::string name;
  std::optional<GeometryKind> kind;  ///< nullopt where the file does not declare one
  std::int64_t feature_count = 0;    ///< -1 where counting needs a full read (raw OSM)
  std::string crs_name;              ///< empty if unknown
  std::vector<FieldSchema> fields;
};

std::string_view kind_name(GeometryKind kind);

/// @throws InputError where the file is missing or no GDAL driver opens it
std::vector<LayerInfo> list_layers(const std::string& file);

struct ReadOptions {
  std::optional<LocalFrame>
      frame{};  ///< reproject into this one; chosen from the data if not given
  std::vector<std::string> fields{};   ///< wanted, in this order; empty = all the layer has
  std::optional<GeometryKind> kind{};  ///< required; if not given, the kind most features have
  std::string where{};  ///< SQL condition on the layer's fields; empty = all features
};

/// Reads one layer of whatever GDAL opens (GeoPackage, GeoJSON, Shapefile, .osm.pbf, .osm.gz,
/// .mvt).
///
/// Frame: a projected CRS in metres is kept as it is; anything else (degrees, feet, Mercator, whose
/// metres are not metres on the ground) goes to the WGS 84 UTM zone of the data's centre. The
/// origin is that centre, rounded to 1000 m: local = projected - origin. Fields: a wanted name that
/// is no field is looked for in `other_tags` where the layer has it (OSM).
///
/// Guarantees: 1. every feature of the layer that passes `where` is returned, in file order: one
/// without geometry, or whose geometry is of another kind, has no parts, so that a later stage
/// reports it by its id;  2. coordinates that are not finite, or that the projection cannot map,
/// are NaN;  3. multi-part, collected and curved geometries are taken apart and made linear,
/// heights are dropped, nothing else is changed.
/// @throws InputError, one line with file, layer and remedy: file missing or not readable; layer
///   missing or not named among several; no feature (of the required kind); no CRS; unknown field;
///   bad `where`
Layer read_layer(const LayerSource& source, const ReadOptions& options = {});

/// Writes all layers into a new file, replacing an old one: .gpkg, or .geojson (one layer, WGS 84
/// longitude and latitude after RFC 7946). Rings are closed; a layer with a feature of several
/// parts is multi-part throughout. A feature without parts is written without geometry. Feature ids
/// are kept where all of a layer are distinct whole numbers, else features are numbered from 1.
///
/// Guarantees: 1. the same layers give the same bytes;  2. the file appears whole or not at all
/// (written beside the target, renamed);  3. reading a .gpkg back gives the same coordinates, to
/// the last bit where they lie on the working grid.
/// @throws InputError where the path cannot be written or has another ending
void write_layers(const std::string& path, std::span<const Layer> layers);

}  // namespace plat::geodata
