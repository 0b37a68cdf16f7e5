// Do blends of two examples lie between them and move with the weight: README.md.

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "harness/experiment_program.h"
#include "layout_blending/blending_experiment.h"
#include "layout_blending/blending_tables.h"

namespace plat::blending {
namespace {

/// @returns whether every network was grown
bool run(const harness::ProgramCall& call) {
  const BlendingConfig config = parse_blending_config(call.config, call.config_file);
  const BlendingResult result = run_blending(config, call.jobs);
  std::filesystem::create_directories(call.out);
  write_file(call.out / "blends.csv", blends_csv(config, result));
  write_file(call.out / "examples.csv", examples_csv(config, result));
  write_file(call.out / "weights.csv", weights_csv(config, result));
  write_file(call.out / "trends.csv", trends_csv(config, result));
  write_file(call.out / "networks.csv", networks_csv(config, result));
  harness::write_manifest(call);
  return std::ranges::all_of(result.rows, [](const BlendRow& row) { return row.status == "ok"; });
}

}  // namespace
}  // namespace plat::blending

int main(int argc, char** argv) {
  return plat::harness::run_program(argc, argv,
                                    {.name = "layout_blending",
                                     .question = "Do attributes and measures of a blend lie "
                                                 "between its examples' and move with the weight?",
                                     .trouble = "a network could not be grown",
                                     .run = plat::blending::run});
}
