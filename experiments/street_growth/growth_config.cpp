#include "street_growth/growth_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "geodata/dataset_catalogue.h"
#include "harness/config_reader_internal.h"

namespace plat::growth {
namespace {

using harness::ObjectReader;
using nlohmann::json;
using Menu = Registry<streets::AnyStreetGrower>;

const json& list_at(ObjectReader& reader, std::string_view key, const std::string& where) {
  const json* list = reader.find(key);
  if (list == nullptr || !list->is_array() || list->empty())
    throw InputError(fmt::format("{}: \"{}\" must be a list that is not empty", where, key));
  return *list;
}

OptionMap options_at(ObjectReader& reader, const std::string& where) {
  const json* options = reader.find("options");
  return options == nullptr ? OptionMap{} : harness::read_options(*options, where);
}

std::optional<Box> read_window(ObjectReader& reader, const std::string& where) {
  const json* window = reader.find("window");
  if (window == nullptr) return std::nullopt;
  const bool is_box = window->is_array() && window->size() == 4 &&
                      std::ranges::all_of(*window, [](const json& v) { return v.is_number(); });
  if (!is_box) throw InputError(where + ": \"window\" must be [x_min, y_min, x_max, y_max]");
  Box box;
  box.add(Point{(*window)[0].get<double>(), (*window)[1].get<double>()});
  box.add(Point{(*window)[2].get<double>(), (*window)[3].get<double>()});
  return box;
}

CityChoice read_city(const json& object, const std::string& source) {
  const std::string where = source + ", cities";
  ObjectReader reader(object, where);
  CityChoice out{geodata::dataset(reader.text("dataset", "")).name, read_window(reader, where)};
  reader.expect_nothing_else();
  return out;
}

std::vector<Variant> read_strategies(ObjectReader& reader, const Menu& menu,
                                     const std::string& source) {
  std::vector<Variant> out;
  const json* strategies = reader.find("strategies");
  if (strategies != nullptr && *strategies == "all") {
    for (const std::string& name : menu.names()) out.push_back({name, name, {}, {}});
    return out;
  }
  for (const json& object : list_at(reader, "strategies", source)) {
    ObjectReader entry(object, source + ", strategies");
    Variant variant;
    variant.strategy = entry.text("name", "");
    variant.label = entry.text("label", variant.strategy);
    variant.options = options_at(entry, source + ", strategies");
    entry.expect_nothing_else();
    out.push_back(std::move(variant));
  }
  return out;
}

Attribute attribute_named(const std::string& name, const std::string& where) {
  std::vector<std::string_view> known;
  for (const Attribute attribute : all_attributes()) {
    if (attribute_name(attribute) == name) return attribute;
    known.push_back(attribute_name(attribute));
  }
  throw InputError(
      fmt::format("{}: no attribute \"{}\"{}", where, name, did_you_mean(name, known)));
}

Variant read_ablation(const json& object, const Variant& reference, const std::string& source) {
  const std::string where = source + ", ablations";
  ObjectReader reader(object, where);
  Variant out = reference;
  out.is_ablation = true;
  out.is_mapped = false;
  out.label = reader.text("label", "");
  for (const auto& [key, value] : options_at(reader, where))
    out.options.insert_or_assign(key, value);
  if (const json* flatten = reader.find("flatten")) {
    if (!flatten->is_string())
      throw InputError(where + ": \"flatten\" must name an attribute of the points");
    out.flattened.push_back(attribute_named(flatten->get<std::string>(), where));
  }
  reader.expect_nothing_else();
  return out;
}

void expect_usable(const std::vector<Variant>& variants, const Menu& menu,
                   const std::string& source) {
  std::set<std::string> labels;
  for (const Variant& variant : variants) {
    if (variant.label.empty() || !labels.insert(variant.label).second)
      throw InputError(
          fmt::format("{}: label \"{}\" is empty or comes twice", source, variant.label));
    harness::naming(source + ", " + variant.label,
                    [&] { static_cast<void>(menu.make(variant.strategy, variant.options)); });
  }
}

void read_maps(ObjectReader& reader, std::vector<Variant>& variants, const std::string& source) {
  const json* maps = reader.find("maps");
  if (maps == nullptr) return;
  for (const json& label : *maps) {
    const auto found = std::ranges::find_if(
        variants, [&](const Variant& v) { return label.is_string() && label == v.label; });
    if (found == variants.end())
      throw InputError(fmt::format("{}: maps: {} is no label", source, label.dump()));
    found->is_mapped = true;
  }
}

template <class Options>
Options options_under(ObjectReader& reader, std::string_view key, const std::string& source) {
  const json* object = reader.find(key);
  if (object == nullptr) return {};
  const std::string where = fmt::format("{}, {}", source, key);
  return from_option_map<Options>(where, harness::read_options(*object, where));
}

}  // namespace

GrowthConfig parse_growth_config(const json& object, const std::string& source, const Menu& menu) {
  ObjectReader reader(object, source);
  static_cast<void>(reader.text("experiment", ""));
  static_cast<void>(reader.text("question", ""));
  GrowthConfig out;
  for (const json& city : list_at(reader, "cities", source))
    out.cities.push_back(read_city(city, source));
  out.variants = read_strategies(reader, menu, source);
  expect_usable(out.variants, menu, source);
  const std::string reference = reader.text("reference", out.variants.front().label);
  const auto found = std::ranges::find(out.variants, reference, &Variant::label);
  if (found == out.variants.end())
    throw InputError(
        fmt::format("{}: reference \"{}\" is no label of a strategy", source, reference));
  out.reference = static_cast<std::size_t>(found - out.variants.begin());
  if (const json* ablations = reader.find("ablations")) {
    const Variant whole = out.variants[out.reference];
    for (const json& ablation : *ablations)
      out.variants.push_back(read_ablation(ablation, whole, source));
  }
  expect_usable(out.variants, menu, source);
  read_maps(reader, out.variants, source);
  out.seeds = static_cast<int>(reader.whole("seeds", out.seeds, 1, 10000));
  out.ablation_seeds =
      static_cast<int>(reader.whole("ablation_seeds", out.ablation_seeds, 1, 10000));
  out.tile_m = static_cast<double>(
      reader.whole("tile_m", static_cast<std::int64_t>(out.tile_m), 10, 100000));
  out.resamples = static_cast<int>(reader.whole("resamples", out.resamples, 20, 100000));
  out.permutations = static_cast<int>(reader.whole("permutations", out.permutations, 20, 1000000));
  out.seed = static_cast<std::uint64_t>(reader.whole("seed", 1, 0, 1LL << 53));
  out.length = options_under<streets::LengthRecoveryOptions>(reader, "length", source);
  out.routes = options_under<streets::RouteOptions>(reader, "routes", source);
  reader.expect_nothing_else();
  return out;
}

}  // namespace plat::growth
