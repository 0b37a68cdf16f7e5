// How gaps, deformation and replacements grow with a displacement: README.md.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "harness/experiment_program.h"
#include "harness/json_file.h"
#include "tile_displacement/displacement_experiment.h"
#include "tile_displacement/displacement_tables.h"
#include "tile_displacement/scene.h"

namespace plat::displacement {
namespace {

/// @returns whether every way had a solution
bool run(const harness::ProgramCall& call) {
  const DisplacementConfig config = parse_displacement_config(call.config, call.config_file);
  const DisplacementResult result = run_displacements(config, call.jobs);
  std::filesystem::create_directories(call.out);
  write_file(call.out / "displacements.csv", displacements_csv(config, result));
  write_file(call.out / "curves.csv", curves_csv(config, result));
  write_file(call.out / "replacements.csv", replacements_csv(config, result));
  write_file(call.out / "cities.csv", cities_csv(config, result));
  harness::write_manifest(call);
  return std::ranges::all_of(result.rows,
                             [](const DisplacementRow& row) { return row.status == "ok"; });
}

/// @returns whether the one displacement has a solution
bool show(const std::string& file, const harness::ProgramCall& call) {
  return show_scene(parse_scene(harness::read_json(file), file), call.out, call.jobs);
}

}  // namespace
}  // namespace plat::displacement

int main(int argc, char** argv) {
  std::string scene;
  return plat::harness::run_program(
      argc, argv,
      {.name = "tile_displacement",
       .question = "How do gaps, deformation and replacements grow with the displacement of tiles?",
       .trouble = "a displacement was refused or has no solution",
       .run =
           [&](const plat::harness::ProgramCall& call) {
             return scene.empty() ? plat::displacement::run(call)
                                  : plat::displacement::show(scene, call);
           },
       .add_options =
           [&](CLI::App& app) {
             app.add_option("--scene", scene,
                            "instead: one displacement to be drawn, as JSON (README.md)");
           }});
}
