// How gaps, deformation and replacements grow with a displacement: README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/atomic_file.h"
#include "harness/build_info.h"
#include "tile_displacement/displacement_experiment.h"
#include "tile_displacement/displacement_tables.h"
#include "tile_displacement/scene.h"

namespace plat::displacement {
namespace {

using nlohmann::json;

json read_json(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file + ": cannot be read");
  json object = json::parse(in, nullptr, false);
  if (object.is_discarded()) throw InputError(file + ": is no JSON");
  return object;
}

/// @returns whether every way had a solution
bool run(const std::string& config_file, const std::filesystem::path& out, Jobs jobs) {
  const json object = read_json(config_file);
  const DisplacementConfig config = parse_displacement_config(object, config_file);
  const DisplacementResult result = run_displacements(config, jobs);
  std::filesystem::create_directories(out);
  harness::write_file(out / "displacements.csv", displacements_csv(config, result));
  harness::write_file(out / "curves.csv", curves_csv(config, result));
  harness::write_file(out / "replacements.csv", replacements_csv(config, result));
  harness::write_file(out / "cities.csv", cities_csv(config, result));
  const json manifest{{"build", harness::build_info()}, {"config", object}};
  harness::write_file(out / "manifest.json", manifest.dump(2) + "\n");
  return std::ranges::all_of(result.rows,
                             [](const DisplacementRow& row) { return row.status == "ok"; });
}

}  // namespace
}  // namespace plat::displacement

int main(int argc, char** argv) {
  CLI::App app{
      "How do gaps, deformation and replacements grow with the displacement of tiles?\n"
      "Example: tile_displacement --out out/tile_displacement && \\\n"
      "    python3 experiments/tile_displacement/draw.py out/tile_displacement\n"
      "Exit status: 0 done, 1 a displacement was refused or has no solution, 2 bad input"};
  std::string config =
      (plat::harness::experiments_folder() / "tile_displacement" / "config.json").string();
  std::string scene;
  std::string out;
  plat::Jobs jobs;
  app.add_option("--config", config, "what to run")->capture_default_str();
  app.add_option("--scene", scene, "instead: one displacement to be drawn, as JSON (README.md)");
  app.add_option("--out", out, "folder for the tables and manifest.json")->required();
  app.add_option("--jobs", jobs.count, "threads, 0 = all cores; results do not depend on it");
  CLI11_PARSE(app, argc, argv);
  try {
    if (scene.empty()) return plat::displacement::run(config, out, jobs) ? 0 : 1;
    const auto chosen =
        plat::displacement::parse_scene(plat::displacement::read_json(scene), scene);
    return plat::displacement::show_scene(chosen, out, jobs) ? 0 : 1;
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "tile_displacement: {}\n", error.what());
    return 2;
  }
}
