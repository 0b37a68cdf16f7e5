#include "tile_displacement/displacement_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "geodata/dataset_catalogue.h"
#include "harness/config_reader_internal.h"
#include "similarity/shape_similarity.h"

namespace plat::displacement {
namespace {

using harness::ObjectReader;
using nlohmann::json;

double number_in(const json& value, const std::string& where, double min, double max) {
  if (!value.is_number()) throw InputError(where + ": must be a number");
  const auto number = value.get<double>();
  if (!(number >= min && number <= max))
    throw InputError(fmt::format("{} = {}, allowed {}..{}", where, number, min, max));
  return number;
}

double number_at(ObjectReader& reader, std::string_view key, double fallback,
                 const std::string& where, double min, double max) {
  const json* value = reader.find(key);
  return value == nullptr ? fallback
                          : number_in(*value, fmt::format("{}.{}", where, key), min, max);
}

const json& list_at(ObjectReader& reader, std::string_view key, const std::string& where) {
  const json* list = reader.find(key);
  if (list == nullptr || !list->is_array() || list->empty())
    throw InputError(fmt::format("{}: \"{}\" must be a list that is not empty", where, key));
  return *list;
}

std::vector<double> distances_at(ObjectReader& reader, const std::string& where) {
  std::vector<double> out;
  for (const json& value : list_at(reader, "displacements_m", where))
    out.push_back(number_in(value, where + ": displacements_m", 0.0, 1000.0));
  return out;
}

Way read_way(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  Way out;
  out.name = reader.text("name", "");
  if (out.name.empty()) throw InputError(where + ": \"name\" is missing");
  const std::string by = reader.text("by", "solver");
  if (by == "warp") {
    out.method = Method::kWarp;
  } else if (by == "none") {
    out.method = Method::kNone;
  } else if (by != "solver") {
    throw InputError(where + ".by: must be \"solver\", \"warp\" or \"none\"");
  }
  if (const json* options = reader.find("options")) {
    const OptionMap map = harness::read_options(*options, where + ".options");
    harness::naming(
        where, [&] { out.solver = from_option_map<tiles::SolverOptions>("layout solver", map); });
  }
  reader.expect_nothing_else();
  return out;
}

ReplacementChoice read_replacement(const json& object, const DisplacementConfig& config,
                                   const std::string& where) {
  ObjectReader reader(object, where);
  ReplacementChoice out;
  out.way = reader.text("way", "");
  const auto way = std::ranges::find(config.ways, out.way, &Way::name);
  if (way == config.ways.end() || way->method != Method::kSolver)
    throw InputError(fmt::format("{}.way: \"{}\" is none of the solver's ways", where, out.way));
  if (const json* names = reader.find("similarities")) {
    for (const json& name : *names) out.similarities.push_back(name.get<std::string>());
  } else {
    out.similarities = similarity::shape_similarities().names();
  }
  for (const std::string& name : out.similarities)
    static_cast<void>(similarity::shape_similarities().make(name, {}));
  out.reach_m = number_at(reader, "reach_m", config.reach_m, where, 0.0, 100000.0);
  out.deformation_threshold = number_at(reader, "deformation_threshold", 0.25, where, 0.0, 1e3);
  out.gap_threshold_m = number_at(reader, "gap_threshold_m", 4.0, where, 0.0, 1e4);
  out.candidates = static_cast<int>(reader.whole("candidates", 5, 1, 1000));
  out.max_rounds = static_cast<int>(reader.whole("max_rounds", 10, 1, 1000));
  out.groups = static_cast<int>(reader.whole("groups", config.groups, 1, config.groups));
  out.displacements_m = distances_at(reader, where);
  reader.expect_nothing_else();
  return out;
}

}  // namespace

Point read_pair(const json& list, const std::string& where) {
  constexpr double kFarthest_m = 1e8;
  if (!list.is_array() || list.size() != 2) throw InputError(where + ": must be two numbers");
  return {number_in(list[0], where, -kFarthest_m, kFarthest_m),
          number_in(list[1], where, -kFarthest_m, kFarthest_m)};
}

CityChoice read_city_choice(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  CityChoice out;
  out.dataset = geodata::dataset(reader.text("dataset", "")).name;
  constexpr std::int64_t kMostTiles = 1000000;
  if (reader.find("tiles") != nullptr)
    out.tiles = static_cast<std::size_t>(reader.whole("tiles", 1, 1, kMostTiles));
  if (const json* near = reader.find("near_m")) out.near = read_pair(*near, where + ".near_m");
  reader.expect_nothing_else();
  return out;
}

std::vector<Way> read_ways(const json& list, const std::string& where) {
  std::vector<Way> out;
  for (const json& way : list)
    out.push_back(read_way(way, fmt::format("{}[{}]", where, out.size())));
  return out;
}

DisplacementConfig parse_displacement_config(const json& object, const std::string& source) {
  ObjectReader reader(object, source);
  static_cast<void>(reader.text("experiment", ""));
  static_cast<void>(reader.text("question", ""));
  DisplacementConfig out;
  for (const json& city : list_at(reader, "cities", source))
    out.cities.push_back(
        read_city_choice(city, fmt::format("{}: cities[{}]", source, out.cities.size())));
  out.displacements_m = distances_at(reader, source);
  out.groups = static_cast<int>(reader.whole("groups", out.groups, 1, 10000));
  out.group_radius_m = number_at(reader, "group_radius_m", 60.0, source, 0.0, 10000.0);
  out.reach_m = number_at(reader, "reach_m", 250.0, source, 0.0, 100000.0);
  out.ways = read_ways(list_at(reader, "ways", source), source + ": ways");
  if (const json* replacement = reader.find("replacement"))
    out.replacement = read_replacement(*replacement, out, source + ": replacement");
  out.resamples = static_cast<int>(reader.whole("resamples", out.resamples, 1, 100000));
  out.seed = static_cast<std::uint64_t>(reader.whole("seed", 1, 0, 1LL << 53));
  reader.expect_nothing_else();
  return out;
}

}  // namespace plat::displacement
