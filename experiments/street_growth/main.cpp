// Whether regrown streets are those of the city whose points were copied: README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "geodata/layer_io.h"
#include "harness/atomic_file.h"
#include "harness/build_info.h"
#include "street_growth/growth_maps.h"
#include "street_growth/growth_tables.h"

namespace plat::growth {
namespace {

using nlohmann::json;

json read_json(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file + ": cannot be read");
  json object = json::parse(in, nullptr, false);
  if (object.is_discarded()) throw InputError(file + ": is no JSON");
  return object;
}

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
bool run(const std::string& config_file, const std::filesystem::path& out, Jobs jobs) {
  const json object = read_json(config_file);
  const GrowthConfig config = parse_growth_config(object, config_file, streets::street_growers());
  const auto start = std::chrono::steady_clock::now();
  const std::vector<CityResult> cities = run_all(config, jobs);
  const json build = harness::build_info();
  std::filesystem::create_directories(out);
  harness::write_file(out / "cells.csv",
                      cells_csv(config, cities, build.at("commit").get<std::string>()));
  harness::write_file(out / "recovery.csv", recovery_csv(config, cities));
  harness::write_file(out / "differences.csv", differences_csv(config, cities));
  harness::write_file(out / "distances.csv", distances_csv(config, cities));
  harness::write_file(out / "scalars.csv", scalars_csv(config, cities));
  json manifest{{"build", build}, {"config", object}};
  bool is_complete = true;
  for (const CityResult& city : cities) {
    manifest["cities"].push_back(about(city));
    is_complete = is_complete && city.city.has_value();
    if (city.city) write_maps(config, city, out);
    for (const auto& cells : city.cells) {
      for (const GrowthCell& cell : cells) is_complete = is_complete && cell.is_ok();
    }
  }
  manifest["duration_s"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  harness::write_file(out / "manifest.json", manifest.dump(2) + "\n");
  return is_complete;
}

}  // namespace
}  // namespace plat::growth

int main(int argc, char** argv) {
  CLI::App app{
      "Copies a city's intersection points, regrows its streets by every strategy and ablation,\n"
      "and compares (README.md).\n"
      "Exit status: 0 done, 1 finished with cities skipped or cells failed, 2 bad input"};
  std::string config =
      (plat::harness::experiments_folder() / "street_growth" / "config.json").string();
  std::string out;
  plat::Jobs jobs;
  app.add_option("--config", config, "what to run")->capture_default_str();
  app.add_option("--out", out, "folder for the tables, maps and manifest.json")->required();
  app.add_option("--jobs", jobs.count, "threads, 0 = all cores; results do not depend on it")
      ->check(CLI::Range(0, 1024));
  CLI11_PARSE(app, argc, argv);
  try {
    return plat::growth::run(config, out, jobs) ? 0 : 1;
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "street_growth: {}\n", error.what());
    return 2;
  }
}
