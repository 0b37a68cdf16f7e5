#include "layout_blending/blending_config.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "geodata/dataset_catalogue.h"
#include "harness/config_reader_internal.h"
#include "streets/street_grower.h"

namespace plat::blending {
namespace {

using harness::ObjectReader;
using nlohmann::json;

const json& list_at(ObjectReader& reader, std::string_view key, const std::string& where) {
  const json* list = reader.find(key);
  if (list == nullptr || !list->is_array() || list->empty())
    throw InputError(fmt::format("{}: \"{}\" must be a list that is not empty", where, key));
  return *list;
}

double number_in(const json& value, const std::string& where, double min, double max) {
  if (!value.is_number()) throw InputError(where + ": must be a number");
  const auto number = value.get<double>();
  if (!(number >= min && number <= max))
    throw InputError(fmt::format("{} = {}, allowed {}..{}", where, number, min, max));
  return number;
}

ExampleChoice read_example(ObjectReader& reader, std::string_view key, const std::string& where) {
  const std::string here = fmt::format("{}.{}", where, key);
  const json* object = reader.find(key);
  if (object == nullptr) throw InputError(here + ": is missing");
  ObjectReader inner(*object, here);
  ExampleChoice out;
  out.dataset = geodata::dataset(inner.text("dataset", "")).name;
  const json& centre = list_at(inner, "centre_m", here);
  if (centre.size() != 2) throw InputError(here + ".centre_m: must be [east, north]");
  constexpr double kFarthest_m = 1e8;
  out.centre_m = {number_in(centre[0], here + ".centre_m", -kFarthest_m, kFarthest_m),
                  number_in(centre[1], here + ".centre_m", -kFarthest_m, kFarthest_m)};
  inner.expect_nothing_else();
  return out;
}

BlendWay read_way(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  BlendWay out;
  out.name = reader.text("name", "");
  if (out.name.empty()) throw InputError(where + ": \"name\" is missing");
  const std::string positions = reader.text("positions", "thinned");
  if (positions == "morphed") {
    out.positions = synthesis::BlendPositions::kMorphed;
  } else if (positions != "thinned") {
    throw InputError(where + ".positions: must be \"thinned\" or \"morphed\"");
  }
  out.patch_places = reader.whole("patch_places", 20, 1, 1000000);
  reader.expect_nothing_else();
  return out;
}

}  // namespace

BlendingConfig parse_blending_config(const json& object, const std::string& source) {
  ObjectReader reader(object, source);
  static_cast<void>(reader.text("experiment", ""));
  static_cast<void>(reader.text("question", ""));
  BlendingConfig out;
  for (const json& pair : list_at(reader, "pairs", source)) {
    const std::string where = fmt::format("{}: pairs[{}]", source, out.pairs.size());
    ObjectReader inner(pair, where);
    PairChoice choice;
    choice.name = inner.text("name", "");
    if (choice.name.empty()) throw InputError(where + ": \"name\" is missing");
    choice.grid = read_example(inner, "grid", where);
    choice.irregular = read_example(inner, "irregular", where);
    inner.expect_nothing_else();
    out.pairs.push_back(std::move(choice));
  }
  if (const json* window = reader.find("window_m"))
    out.window_m = number_in(*window, source + ": window_m", 100.0, 20000.0);
  out.grower = reader.text("grower", "random_walk");
  if (const json* options = reader.find("grower_options"))
    out.grower_options = harness::read_options(*options, source + ": grower_options");
  static_cast<void>(streets::street_growers().make(out.grower, out.grower_options));
  for (const json& way : list_at(reader, "ways", source))
    out.ways.push_back(read_way(way, source + ": ways"));
  for (const json& weight : list_at(reader, "weights_01", source))
    out.weights_01.push_back(number_in(weight, source + ": weights_01", 0.0, 1.0));
  out.seeds = static_cast<int>(reader.whole("seeds", out.seeds, 1, 10000));
  out.resamples = static_cast<int>(reader.whole("resamples", out.resamples, 1, 100000));
  out.seed = static_cast<std::uint64_t>(reader.whole("seed", 1, 0, 1LL << 53));
  reader.expect_nothing_else();
  return out;
}

}  // namespace plat::blending
