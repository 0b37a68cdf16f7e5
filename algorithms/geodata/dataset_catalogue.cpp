#include "geodata/dataset_catalogue.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "core/failure.h"
#include "core/options.h"
#include "core/sha256.h"
#include "geodata/catalogue_internal.h"

namespace plat::geodata {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

GeometryKind kind_from(const json& value) {
  for (const GeometryKind kind :
       {GeometryKind::kPolygon, GeometryKind::kLine, GeometryKind::kPoint}) {
    if (kind_name(kind) == value.get<std::string>()) return kind;
  }
  throw LogicError("catalogue.json: unknown geometry kind");
}

PlotOrigin origin_from(const json& value) {
  for (const PlotOrigin origin :
       {PlotOrigin::kObserved, PlotOrigin::kTessellated, PlotOrigin::kNone}) {
    if (plot_origin_name(origin) == value.get<std::string>()) return origin;
  }
  throw LogicError("catalogue.json: unknown origin of plots");
}

std::optional<std::string> text_if_any(const json& object, const char* key) {
  if (!object.contains(key)) return std::nullopt;
  return object.at(key).get<std::string>();
}

std::optional<LayerMapping> mapping_if_any(const json& object, const char* key) {
  if (!object.contains(key)) return std::nullopt;
  const json& mapping = object.at(key);
  return LayerMapping{mapping.at("layer"), mapping.value("where", ""),
                      mapping.value("fields", std::map<std::string, std::string>{}),
                      mapping.value("settings", std::map<std::string, std::string>{})};
}

Fetch fetch_from(const json& object) {
  const std::string method = object.at("method");
  if (method == "files") return FetchFiles{};
  if (method == "manual") return FetchManually{};
  if (method == "tiles") {
    FetchTiles tiles{object.at("npm"),  object.at("source_sha256"), object.at("folder"),
                     object.at("file"), object.at("epsg"),          {}};
    for (const json& layer : object.at("layers"))
      tiles.layers.emplace_back(layer.at("name"), kind_from(layer.at("kind")));
    return tiles;
  }
  expects(method == "recipe", "catalogue.json: known fetch method");
  FetchRecipe recipe;
  recipe.file = object.at("file");
  recipe.epsg = object.at("epsg");
  for (const json& step : object.at("steps")) {
    recipe.steps.push_back({step.at("url"), text_if_any(step, "source_layer"), step.at("layer"),
                            kind_from(step.at("kind"))});
  }
  return recipe;
}

Dataset dataset_from(const json& object) {
  Dataset out;
  out.name = object.at("name");
  out.title = object.at("title");
  out.contents = object.at("contents");
  out.crs = object.at("crs");
  out.licence = object.at("licence");
  out.attribution = object.at("attribution");
  out.source = object.at("source");
  for (const json& file : object.at("files")) {
    out.files.push_back({file.at("path"), file.at("sha256"), text_if_any(file, "url"),
                         file.value("optional", false)});
  }
  for (const json& layer : object.at("layers")) {
    out.layers.push_back(
        {layer.at("file"), layer.at("name"), kind_from(layer.at("kind")), layer.at("count")});
  }
  if (object.contains("observed")) {
    const json& observed = object.at("observed");
    out.observed =
        ObservedMapping{origin_from(observed.at("plots")), mapping_if_any(observed, "parcels"),
                        mapping_if_any(observed, "streets"), mapping_if_any(observed, "footprints"),
                        mapping_if_any(observed, "blocks")};
  }
  out.fetch = fetch_from(object.at("fetch"));
  out.fetch_note = object.at("fetch").value("note", "");
  out.is_fetch_verified = object.at("fetch").value("verified", false);
  return out;
}

/// The checksum of the source that a derived file of this data set must name.
std::optional<std::string> derivation_source(const Dataset& dataset) {
  if (const auto* tiles = std::get_if<FetchTiles>(&dataset.fetch)) return tiles->source_sha256;
  if (const auto* recipe = std::get_if<FetchRecipe>(&dataset.fetch))
    return recipe->steps.empty() ? std::nullopt : std::optional(recipe->steps.front().url);
  return std::nullopt;
}

bool is_derived(const Dataset& dataset, const fs::path& file, const std::string& sha256) {
  const std::optional<std::string> source = derivation_source(dataset);
  std::ifstream in(file.parent_path() / detail::kProvenanceName);
  if (!source || !in) return false;
  const json provenance = json::parse(in, nullptr, false);
  if (!provenance.is_object() || provenance.value("source", "") != *source) return false;
  const json files = provenance.value("files", json::object());
  return files.value(file.filename().string(), "") == sha256;
}

}  // namespace

namespace detail {

std::string sha256_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw InputError(fmt::format("{}: cannot be read; check its permissions", file.string()));
  Sha256 hash;
  std::array<char, 1U << 16U> buffer{};
  while (in.read(buffer.data(), buffer.size()) || in.gcount() > 0)
    hash.add(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(in.gcount()))));
  return to_hex(hash.digest());
}

}  // namespace detail

std::string_view plot_origin_name(PlotOrigin origin) {
  switch (origin) {
    case PlotOrigin::kObserved:
      return "observed";
    case PlotOrigin::kTessellated:
      return "tessellated";
    case PlotOrigin::kNone:
      return "none";
  }
  return "";
}

std::string_view file_state_name(FileState state) {
  switch (state) {
    case FileState::kOk:
      return "ok";
    case FileState::kDerived:
      return "derived";
    case FileState::kMissing:
      return "missing";
    case FileState::kDiffers:
      return "differs";
  }
  return "";
}

const std::vector<Dataset>& catalogue() {
  static const std::vector<Dataset> all = [] {
    std::vector<Dataset> out;
    for (const json& object : json::parse(detail::catalogue_text()))
      out.push_back(dataset_from(object));
    return out;
  }();
  return all;
}

const Dataset& dataset(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Dataset& known : catalogue()) {
    if (known.name == name) return known;
    names.push_back(known.name);
  }
  throw InputError(fmt::format("no data set \"{}\"{}; `plat data list` names them all", name,
                               did_you_mean(name, names)));
}

fs::path data_dir() {
  const auto set = [](const char* name) -> std::optional<fs::path> {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') return std::nullopt;
    return fs::path(value);
  };
  if (const auto folder = set("PLAT_DATA_DIR")) return *folder;
  if (const auto folder = set("XDG_DATA_HOME")) return *folder / "plat";
  if (const auto home = set("HOME")) return *home / ".local" / "share" / "plat";
  throw InputError("no data folder: set PLAT_DATA_DIR");
}

LayerSource source_of(const LayerMapping& mapping, const fs::path& folder) {
  const std::size_t colon = mapping.layer.rfind(':');
  expects(colon != std::string::npos, "a mapped layer is path:layer");
  return {(folder / mapping.layer.substr(0, colon)).string(), mapping.layer.substr(colon + 1)};
}

std::optional<fs::path> locate(const Dataset& dataset, const fs::path& folder) {
  for (const DatasetFile& file : dataset.files) {
    if (!file.is_optional && !fs::exists(folder / file.path)) return std::nullopt;
  }
  return folder / dataset.name;
}

std::vector<FileCheck> check(const Dataset& dataset, const fs::path& folder) {
  std::vector<FileCheck> out;
  for (const DatasetFile& file : dataset.files) {
    FileCheck result{file.path, FileState::kMissing, file.is_optional};
    const fs::path path = folder / file.path;
    if (fs::exists(path)) {
      const std::string sha256 = detail::sha256_of(path);
      result.state = sha256 == file.sha256               ? FileState::kOk
                     : is_derived(dataset, path, sha256) ? FileState::kDerived
                                                         : FileState::kDiffers;
    }
    out.push_back(std::move(result));
  }
  return out;
}

}  // namespace plat::geodata
