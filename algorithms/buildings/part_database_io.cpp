#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "buildings/part_database.h"
#include "core/failure.h"
#include "core/options.h"

namespace plat::buildings {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kPartsFile = "parts.json";
constexpr const char* kTransitionsFile = "transitions.json";
constexpr const char* kMeshFolder = "meshes";
constexpr const char* kPartsFormat = "plat parts 1";
constexpr const char* kTransitionsFormat = "plat transitions 1";

std::string read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: no such file, or not readable", file.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  out.close();
  if (!out) throw InputError(fmt::format("{}: cannot be written", file.string()));
}

/// FNV-1a, 64 bits: tells a file that was changed, by accident, from one that was not.
class Checksum {
 public:
  void add(const std::string& bytes) {
    for (const char c : bytes) {
      state_ ^= static_cast<unsigned char>(c);
      state_ *= 0x100000001b3ULL;
    }
  }
  [[nodiscard]] std::string text() const { return fmt::format("fnv1a64:{:016x}", state_); }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

/// Reads one object of a file: every key that is there must have been asked for.
class Object {
 public:
  Object(const ordered_json& json, std::string place) : json_(json), place_(std::move(place)) {
    if (!json.is_object()) throw InputError(fmt::format("{}: not an object", place_));
  }

  template <class T>
  T get(std::string_view key) {
    keys_.push_back(key);
    const auto at = json_.find(key);
    if (at == json_.end()) throw InputError(fmt::format("{}: \"{}\" is missing", place_, key));
    return as<T>(*at, key);
  }
  template <class T>
  std::optional<T> find(std::string_view key) {
    keys_.push_back(key);
    const auto at = json_.find(key);
    if (at == json_.end() || at->is_null()) return std::nullopt;
    return as<T>(*at, key);
  }
  void expect_no_other_keys() const {
    for (const auto& [key, value] : json_.items()) {
      if (std::ranges::find(keys_, key) == keys_.end())
        throw InputError(
            fmt::format("{}: no key \"{}\" here{}", place_, key, did_you_mean(key, keys_)));
    }
  }

 private:
  template <class T>
  T as(const ordered_json& value, std::string_view key) const {
    try {
      return value.get<T>();
    } catch (const nlohmann::json::exception&) {
      throw InputError(fmt::format("{}: \"{}\" = {}, of the wrong type", place_, key,
                                   value.dump().substr(0, 60)));
    }
  }

  const ordered_json& json_;
  std::string place_;
  std::vector<std::string_view> keys_;
};

ordered_json parse(const fs::path& file, const std::string& text) {
  try {
    return ordered_json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(fmt::format("{}: not JSON: {}", file.string(), error.what()));
  }
}

template <class Enum>
Enum named(const std::string& name, Enum last, const std::string& place) {
  std::string known;
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    if (name_of(static_cast<Enum>(i)) == name) return static_cast<Enum>(i);
    known += fmt::format("{}{}", i == 0 ? "" : ", ", name_of(static_cast<Enum>(i)));
  }
  throw InputError(fmt::format("{}: \"{}\", allowed {}", place, name, known));
}

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

// ---- parts.json

ordered_json shape_json(const PartShape& shape) {
  ordered_json out{{"class", name_of(shape.part_class)}};
  switch (shape.part_class) {
    case PartClass::kLeftEnd:
    case PartClass::kMiddle:
      out["length_m"] = shape.right_m;
      break;
    case PartClass::kRightEnd:
      out["length_m"] = shape.left_m;
      break;
    case PartClass::kFloor:
      out["height_m"] = shape.right_m;
      break;
    case PartClass::kCorner:
      out["angle_deg"] = degrees(shape.angle_rad);
      out["arms_m"] = {{"left", shape.left_m}, {"right", shape.right_m}};
      break;
    case PartClass::kTee:
      out["stem"] = name_of(shape.stem_side);
      out["arms_m"] = {{"left", shape.left_m}, {"right", shape.right_m}, {"stem", shape.stem_m}};
      break;
  }
  return out;
}

PartShape read_shape(Object& json, const std::string& place) {
  PartShape shape;
  shape.part_class =
      named(json.get<std::string>("class"), PartClass::kFloor, place + ": \"class\"");
  const auto read_arms = [&](bool has_stem) {
    const auto arms = json.get<ordered_json>("arms_m");
    Object object(arms, place + ": arms_m");
    shape.left_m = object.get<double>("left");
    shape.right_m = object.get<double>("right");
    if (has_stem) shape.stem_m = object.get<double>("stem");
    object.expect_no_other_keys();
  };
  switch (shape.part_class) {
    case PartClass::kLeftEnd:
    case PartClass::kMiddle:
      shape.right_m = json.get<double>("length_m");
      break;
    case PartClass::kRightEnd:
      shape.left_m = json.get<double>("length_m");
      break;
    case PartClass::kFloor:
      shape.right_m = json.get<double>("height_m");
      break;
    case PartClass::kCorner:
      shape.angle_rad = json.get<double>("angle_deg") * std::numbers::pi / 180.0;
      read_arms(false);
      break;
    case PartClass::kTee:
      shape.stem_side =
          named(json.get<std::string>("stem"), StemSide::kFront, place + ": \"stem\"");
      read_arms(true);
      break;
  }
  return shape;
}

ordered_json materials_json(const PartDatabase& database) {
  std::vector<Material> all;
  for (const Part& part : database.parts()) {
    for (const Material& material : part.mesh.materials) {
      if (std::ranges::find(all, material) == all.end()) all.push_back(material);
    }
  }
  ordered_json out = ordered_json::array();
  for (const Material& material : all)
    out.push_back({{"name", material.name}, {"rgb", material.rgb}});
  return out;
}

std::string mesh_path(const Part& part, const std::string& ending) {
  return fmt::format("{}/{}{}", kMeshFolder, part.name, ending);
}

ordered_json parts_json(const PartDatabase& database, const std::string& ending) {
  const DatabaseInfo& info = database.info();
  ordered_json out{{"format", kPartsFormat},
                   {"name", info.name},
                   {"summary", info.summary},
                   {"origin", info.origin}};
  if (info.kit) out["kit"] = *info.kit;
  if (info.transition_limit_m2) out["transition_limit_m2"] = *info.transition_limit_m2;
  out["materials"] = materials_json(database);
  out["parts"] = ordered_json::array();
  for (const Part& part : database.parts()) {
    ordered_json entry{{"name", part.name}};
    entry.update(shape_json(part.shape));
    entry["mesh"] = mesh_path(part, ending);
    entry["attributes"] = part.attributes;
    out["parts"].push_back(std::move(entry));
  }
  return out;
}

/// The names that the manifest gives to colours.
std::vector<Material> read_materials(const ordered_json& json, const std::string& place) {
  std::vector<Material> out;
  for (const ordered_json& entry : json) {
    Object object(entry, fmt::format("{}: material {}", place, out.size()));
    out.push_back(
        {object.get<std::string>("name"), object.get<std::array<std::uint8_t, 3>>("rgb")});
    object.expect_no_other_keys();
  }
  return out;
}

void name_materials(Mesh& mesh, const std::vector<Material>& names) {
  for (Material& material : mesh.materials) {
    const auto at = std::ranges::find(names, material.rgb, &Material::rgb);
    if (at != names.end()) material.name = at->name;
  }
}

Part read_part(const ordered_json& json, const fs::path& folder, const std::string& place,
               const std::vector<Material>& materials, Checksum& checksum) {
  const bool has_name = json.is_object() && json.contains("name") && json["name"].is_string();
  const std::string where =
      has_name ? fmt::format("{} ({})", place, json["name"].get<std::string>()) : place;
  Object object(json, where);
  auto name = object.get<std::string>("name");
  const PartShape shape = read_shape(object, where);
  const fs::path file = folder / object.get<std::string>("mesh");
  auto attributes = object.find<std::map<std::string, double>>("attributes")
                        .value_or(std::map<std::string, double>{});
  object.expect_no_other_keys();
  for (const auto& [key, value] : attributes) {
    if (!(value >= 0.0) || !std::isfinite(value))
      throw InputError(
          fmt::format("{}: attribute \"{}\" = {}, allowed 0 and more", where, key, value));
  }
  Mesh mesh = read_mesh(file);
  checksum.add(read_bytes(file));
  name_materials(mesh, materials);
  try {
    return make_part(std::move(name), shape, std::move(mesh), std::move(attributes));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

// ---- transitions.json

ordered_json transitions_json(const PartDatabase& database, const std::string& checksum) {
  const std::size_t count = database.sections().size();
  ordered_json out{{"format", kTransitionsFormat},
                   {"parts_checksum", checksum},
                   {"step_m2", kCostStep_m2},
                   {"section_areas_m2", ordered_json::array()},
                   {"section_of", ordered_json::object()}};
  for (const CrossSection& section : database.sections())
    out["section_areas_m2"].push_back(area_m2(section));
  for (std::size_t part = 0; part < database.parts().size(); ++part) {
    const Part& entry = database.parts()[part];
    for (std::size_t port = 0; port < entry.ports.size(); ++port)
      out["section_of"][entry.name][name_of(entry.ports[port].role)] =
          database.section_of({part, port});
  }
  for (const Facing facing : {Facing::kSame, Facing::kMirrored}) {
    ordered_json rows = ordered_json::array();
    for (std::size_t a = 0; a < count; ++a) {
      ordered_json row = ordered_json::array();
      for (std::size_t b = 0; b < count; ++b)
        row.push_back(database.transitions().cost(a, b, facing));
      rows.push_back(std::move(row));
    }
    out[facing == Facing::kSame ? "plain" : "mirrored"] = std::move(rows);
  }
  return out;
}

std::vector<std::int64_t> read_rows(Object& json, std::string_view key, std::size_t count,
                                    const fs::path& file) {
  std::vector<std::int64_t> out;
  const auto rows = json.get<std::vector<std::vector<std::int64_t>>>(key);
  for (const std::vector<std::int64_t>& row : rows) {
    if (row.size() == count) out.insert(out.end(), row.begin(), row.end());
  }
  if (rows.size() != count || out.size() != count * count || std::ranges::min(out) < 0)
    throw InputError(fmt::format("{}: \"{}\" must have {} rows of as many costs, none negative",
                                 file.string(), key, count));
  return out;
}

TransitionTable read_transitions(const fs::path& file, const std::string& checksum) {
  const ordered_json json = parse(file, read_bytes(file));
  Object object(json, file.string());
  if (object.get<std::string>("format") != kTransitionsFormat)
    throw InputError(
        fmt::format("{}: not of the format \"{}\"", file.string(), kTransitionsFormat));
  const auto of = object.get<std::string>("parts_checksum");
  if (of != checksum)
    throw InputError(
        fmt::format("{}: made of other parts (checksum {}, the parts here have {}); "
                    "delete it and it is computed anew",
                    file.string(), of, checksum));
  if (object.get<double>("step_m2") != kCostStep_m2)
    throw InputError(fmt::format("{}: \"step_m2\" must be {}", file.string(), kCostStep_m2));
  const std::size_t count = object.get<std::vector<double>>("section_areas_m2").size();
  return {count, read_rows(object, "plain", count, file),
          read_rows(object, "mirrored", count, file)};
}

/// A folder that holds something else is not replaced.
void expect_replaceable(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder))
    throw InputError(fmt::format("{}: is a file, not a folder", folder.string()));
  if (!fs::is_empty(folder) && !fs::exists(folder / kPartsFile))
    throw InputError(
        fmt::format("{}: has other files in it; name a new or empty folder", folder.string()));
}

}  // namespace

PartDatabase read_part_database(const fs::path& folder) {
  const fs::path file = folder / kPartsFile;
  const std::string text = read_bytes(file);
  Checksum checksum;
  checksum.add(text);
  const ordered_json json = parse(file, text);
  Object object(json, file.string());
  if (object.get<std::string>("format") != kPartsFormat)
    throw InputError(fmt::format("{}: not of the format \"{}\"", file.string(), kPartsFormat));
  DatabaseInfo info{object.get<std::string>("name"),
                    object.find<std::string>("summary").value_or(""),
                    object.find<std::string>("origin").value_or(""),
                    object.find<std::string>("kit"), object.find<double>("transition_limit_m2")};
  const std::vector<Material> materials = read_materials(
      object.find<ordered_json>("materials").value_or(ordered_json::array()), file.string());
  std::vector<Part> parts;
  const auto entries = object.get<std::vector<ordered_json>>("parts");
  object.expect_no_other_keys();
  for (const ordered_json& entry : entries)
    parts.push_back(read_part(entry, folder,
                              fmt::format("{}: part {}", file.string(), parts.size()), materials,
                              checksum));
  const fs::path transitions = folder / kTransitionsFile;
  if (!fs::exists(transitions)) return PartDatabase(std::move(info), std::move(parts));
  TransitionTable table = read_transitions(transitions, checksum.text());
  try {
    return PartDatabase(std::move(info), std::move(parts), std::move(table));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", transitions.string(), error.what()));
  }
}

void write_part_database(const PartDatabase& database, const fs::path& folder,
                         const std::string& mesh_ending) {
  expect_replaceable(folder);
  fs::path partial = folder;
  partial += ".partial";
  std::error_code error;
  fs::remove_all(partial, error);
  fs::create_directories(partial / kMeshFolder, error);
  if (error)
    throw InputError(fmt::format("{}: cannot be made: {}", partial.string(), error.message()));
  Checksum checksum;
  const std::string manifest = parts_json(database, mesh_ending).dump(1) + "\n";
  checksum.add(manifest);
  write_bytes(partial / kPartsFile, manifest);
  for (const Part& part : database.parts()) {
    const fs::path file = partial / mesh_path(part, mesh_ending);
    write_mesh(file, part.mesh);
    checksum.add(read_bytes(file));
  }
  write_bytes(partial / kTransitionsFile,
              transitions_json(database, checksum.text()).dump() + "\n");
  fs::remove_all(folder, error);
  fs::rename(partial, folder, error);
  if (error)
    throw InputError(fmt::format("{}: cannot be written: {}", folder.string(), error.message()));
}

}  // namespace plat::buildings
