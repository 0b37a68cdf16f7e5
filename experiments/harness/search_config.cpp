#include "harness/search_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/config_reader_internal.h"
#include "parcels/block_subdivider.h"
#include "parcels/parcel_measures.h"

namespace plat::harness {
namespace {

using nlohmann::json;

std::vector<OptionValue> read_values(const json& list, const std::string& key,
                                     const std::string& where) {
  if (!list.is_array() || list.empty())
    throw InputError(fmt::format("{}: option \"{}\" must be a list of values to try", where, key));
  std::vector<OptionValue> out;
  for (const json& value : list) {
    out.push_back(read_option(value, key, where));
    if (std::find(out.begin(), out.end() - 1, out.back()) != out.end() - 1)
      throw InputError(fmt::format("{}: option \"{}\" lists {} twice", where, key, value.dump()));
  }
  return out;
}

void expect_measure(const std::string& name, const std::string& where) {
  std::vector<std::string_view> known;
  for (const parcels::MeasureColumn& column : parcels::measure_columns()) {
    if (column.kind != parcels::MeasureKind::kFlag) known.push_back(column.name);
  }
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError(fmt::format("{}: unknown measure \"{}\"{} (docs/measures.md)", where, name,
                               did_you_mean(name, known)));
}

std::vector<std::string> read_measures(const json& list, const std::string& where) {
  if (!list.is_array() || list.empty())
    throw InputError(where + ": \"measures\" must be a list of measures (docs/measures.md)");
  std::vector<std::string> out;
  for (const json& name : list) {
    if (!name.is_string()) throw InputError(where + ": \"measures\" must hold names");
    out.push_back(name.get<std::string>());
    expect_measure(out.back(), where);
    if (std::find(out.begin(), out.end() - 1, out.back()) != out.end() - 1)
      throw InputError(fmt::format("{}: measure \"{}\" is listed twice", where, out.back()));
  }
  return out;
}

std::size_t point_count(const SearchConfig& search) {
  std::size_t count = 1;
  for (const auto& [key, values] : search.options) {
    count *= values.size();
    if (count > kMaxSearchPoints) break;
  }
  return count;
}

}  // namespace

std::vector<OptionMap> grid_points(const SearchConfig& search) {
  std::vector<OptionMap> out{{}};
  for (const auto& [key, values] : search.options) {
    std::vector<OptionMap> longer;
    for (const OptionMap& point : out) {
      for (const OptionValue& value : values) {
        longer.push_back(point);
        longer.back().emplace(key, value);
      }
    }
    out = std::move(longer);
  }
  return out;
}

SearchConfig parse_search(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  SearchConfig out;
  const json* options = reader.find("options");
  if (options == nullptr || !options->is_object() || options->empty())
    throw InputError(where + ": \"options\" must be an object of option: [values to try]");
  for (const auto& [key, list] : options->items())
    out.options.emplace(key, read_values(list, key, where));
  if (const json* measures = reader.find("measures"))
    out.measures = read_measures(*measures, where);
  out.folds = static_cast<int>(reader.whole("folds", out.folds, 2, 20));
  reader.expect_nothing_else();
  return out;
}

void expect_valid(const SearchConfig& search, const std::string& strategy, const OptionMap& given) {
  if (point_count(search) > kMaxSearchPoints)
    throw InputError(fmt::format("the grid has more than {} points", kMaxSearchPoints));
  for (const auto& [key, values] : search.options) {
    if (given.contains(key))
      throw InputError(fmt::format("option \"{}\" is also given a value in \"options\"", key));
  }
  for (OptionMap point : grid_points(search)) {
    point.insert(given.begin(), given.end());
    static_cast<void>(parcels::block_subdividers().make(strategy, point));
  }
}

json to_json(const SearchConfig& search) {
  json options = json::object();
  for (const auto& [key, values] : search.options) {
    for (const OptionValue& value : values)
      std::visit([&](const auto& v) { options[key].push_back(v); }, value);
  }
  return {{"options", options}, {"measures", search.measures}, {"folds", search.folds}};
}

json options_json(const OptionMap& options) {
  json object = json::object();
  for (const auto& [key, value] : options) {
    std::visit([&](const auto& v) { object[key] = v; }, value);
  }
  return object;
}

}  // namespace plat::harness
