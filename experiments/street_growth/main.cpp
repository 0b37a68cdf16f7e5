// Whether regrown streets are those of the city whose points were copied: README.md.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/progress.h"
#include "geodata/layer_io.h"
#include "harness/build_info.h"
#include "harness/experiment_program.h"
#include "street_growth/growth_maps.h"
#include "street_growth/growth_tables.h"

namespace plat::growth {
namespace {

using nlohmann::json;

std::vector<CityResult> know_cities(const GrowthConfig& config, Jobs jobs) {
  std::vector<CityResult> out;
  for (const CityChoice& choice : config.cities) {
    CityResult result;
    result.label = choice.dataset;
    try {
      result.city = know_city(choice, config, jobs);
    } catch (const InputError& error) {
      result.skipped = error.what();
      fmt::print("{}: skipped, {}\n", choice.dataset, error.what());
    }
    out.push_back(std::move(result));
  }
  return out;
}

std::vector<CityResult> run_all(const GrowthConfig& config, Jobs jobs) {
  std::vector<CityResult> cities = know_cities(config, jobs);
  std::vector<std::pair<std::size_t, std::size_t>> tasks;  // city, variant
  for (std::size_t c = 0; c < cities.size(); ++c) {
    if (!cities[c].city) continue;
    cities[c].cells.resize(config.variants.size());
    for (std::size_t v = 0; v < config.variants.size(); ++v) tasks.emplace_back(c, v);
  }
  Progress progress("street_growth", tasks.size());
  parallel_for(tasks.size(), jobs, [&](std::size_t i) {
    const auto [c, v] = tasks[i];
    const Variant& variant = config.variants[v];
    cities[c].cells[v] = run_cells(*cities[c].city, variant, config.seeds_of(variant), config);
    progress.step();
  });
  return cities;
}

json about(const CityResult& city) {
  json out{{"dataset", city.label}, {"skipped", city.skipped}};
  if (!city.city) return out;
  out["parcels"] = city.city->observed.parcel_count;
  out["points"] = city.city->places.size();
  out["streets"] = city.city->observed.network.streets.size();
  out["chains"] = city.city->observed.exemplar.chains.size();
  for (const streets::NetworkScalar& scalar : streets::network_scalars()) {
    const auto value = scalar.value(city.city->measures);
    out["measures"][std::string(scalar.name)] = value ? json(*value) : json();
  }
  return out;
}

void write_maps(const GrowthConfig& config, const CityResult& city,
                const std::filesystem::path& out) {
  std::vector<geodata::Layer> layers;
  for (const Variant& variant : config.variants) {
    if (!variant.is_mapped) continue;
    geodata::Layer layer = edge_map(*city.city, variant, config);
    if (!layer.features.empty()) layers.push_back(std::move(layer));
  }
  if (!layers.empty())
    geodata::write_layers((out / ("edges_" + city.label + ".gpkg")).string(), layers);
}

/// @returns whether every cell of every city ran
bool run(const harness::ProgramCall& call) {
  const GrowthConfig config =
      parse_growth_config(call.config, call.config_file, streets::street_growers());
  const std::filesystem::path& out = call.out;
  const auto start = std::chrono::steady_clock::now();
  const std::vector<CityResult> cities = run_all(config, call.jobs);
  std::filesystem::create_directories(out);
  write_file(out / "cells.csv",
             cells_csv(config, cities, harness::build_info().at("commit").get<std::string>()));
  write_file(out / "recovery.csv", recovery_csv(config, cities));
  write_file(out / "differences.csv", differences_csv(config, cities));
  write_file(out / "distances.csv", distances_csv(config, cities));
  write_file(out / "scalars.csv", scalars_csv(config, cities));
  json more;
  bool is_complete = true;
  for (const CityResult& city : cities) {
    more["cities"].push_back(about(city));
    is_complete = is_complete && city.city.has_value();
    if (city.city) write_maps(config, city, out);
    for (const auto& cells : city.cells) {
      for (const GrowthCell& cell : cells) is_complete = is_complete && cell.is_ok();
    }
  }
  more["duration_s"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  harness::write_manifest(call, more);
  return is_complete;
}

}  // namespace
}  // namespace plat::growth

int main(int argc, char** argv) {
  return plat::harness::run_program(
      argc, argv,
      {.name = "street_growth",
       .question =
           "Copies a city's intersection points, regrows its streets by every strategy and\n"
           "ablation, and compares (README.md).",
       .trouble = "finished with cities skipped or cells failed",
       .run = plat::growth::run});
}
