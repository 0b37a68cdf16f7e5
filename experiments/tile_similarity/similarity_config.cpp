#include "tile_similarity/similarity_config.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "geodata/dataset_catalogue.h"
#include "harness/config_reader_internal.h"

namespace plat::tile_similarity {
namespace {

using harness::ObjectReader;
using nlohmann::json;

std::string required(ObjectReader& reader, std::string_view key, const std::string& where) {
  std::string text = reader.text(key, "");
  if (text.empty()) throw InputError(fmt::format("{}: \"{}\" is missing", where, key));
  return text;
}

PlaceChoice read_place(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  PlaceChoice out;
  out.name = required(reader, "name", where);
  out.dataset = geodata::dataset(required(reader, "dataset", where)).name;
  out.layer = required(reader, "layer", where);
  if (const json* zones = reader.find("zones")) {
    const std::string here = where + ".zones";
    ObjectReader inner(*zones, here);
    out.zones = ZoneSource{required(inner, "layer", here), required(inner, "field", here)};
    inner.expect_nothing_else();
  }
  reader.expect_nothing_else();
  return out;
}

PruningChoice read_pruning(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  PruningChoice out;
  out.dataset = geodata::dataset(required(reader, "dataset", where)).name;
  out.tiles = static_cast<int>(reader.whole("tiles", out.tiles, 2, 1000000));
  out.places = static_cast<int>(reader.whole("places", out.places, 1, 1000000));
  out.measure = reader.text("measure", out.measure);
  const auto list = [&](std::string_view key) {
    const json* values = reader.find(key);
    if (values == nullptr || !values->is_array() || values->empty())
      throw InputError(fmt::format("{}: \"{}\" must be a list that is not empty", where, key));
    return *values;
  };
  for (const json& cheap : list("cheap")) {
    if (!cheap.is_string()) throw InputError(where + ".cheap: must be names of measures");
    out.cheap.push_back(cheap.get<std::string>());
  }
  for (const json& keep : list("keep")) {
    if (!keep.is_number_unsigned() || keep.get<std::uint64_t>() < 1 ||
        keep.get<std::uint64_t>() > 1000000)
      throw InputError(where + ".keep: must be whole numbers, allowed 1..1000000");
    out.keep.push_back(keep.get<std::uint32_t>());
  }
  reader.expect_nothing_else();
  return out;
}

}  // namespace

SimilarityConfig parse_similarity_config(const json& object, const std::string& source) {
  ObjectReader reader(object, source);
  static_cast<void>(reader.text("experiment", ""));
  static_cast<void>(reader.text("question", ""));
  SimilarityConfig out;
  const json* places = reader.find("places");
  if (places == nullptr || !places->is_array() || places->empty())
    throw InputError(source + ": \"places\" must be a list that is not empty");
  for (const json& place : *places)
    out.places.push_back(
        read_place(place, fmt::format("{}: places[{}]", source, out.places.size())));
  if (const json* pruning = reader.find("pruning"))
    out.pruning = read_pruning(*pruning, source + ": pruning");
  const auto whole = [&](std::string_view key, int fallback, int min) {
    return static_cast<int>(reader.whole(key, fallback, min, 1000000));
  };
  out.gallery = whole("gallery", out.gallery, 11);
  out.queries = whole("queries", out.queries, 2);
  out.copies = whole("copies", out.copies, 1);
  out.timed_pairs = whole("timed_pairs", out.timed_pairs, 1);
  out.resamples = whole("resamples", out.resamples, 20);
  out.permutations = whole("permutations", out.permutations, 20);
  out.seed = static_cast<std::uint64_t>(reader.whole("seed", 1, 0, 1'000'000'000'000));
  reader.expect_nothing_else();
  return out;
}

}  // namespace plat::tile_similarity
