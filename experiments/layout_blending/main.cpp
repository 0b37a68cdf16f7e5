// Do blends of two examples lie between them and move with the weight: README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/atomic_file.h"
#include "harness/build_info.h"
#include "layout_blending/blending_experiment.h"
#include "layout_blending/blending_tables.h"

namespace plat::blending {
namespace {

using nlohmann::json;

json read_json(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file + ": cannot be read");
  json object = json::parse(in, nullptr, false);
  if (object.is_discarded()) throw InputError(file + ": is no JSON");
  return object;
}

/// @returns whether every network was grown
bool run(const std::string& config_file, const std::filesystem::path& out, Jobs jobs) {
  const json object = read_json(config_file);
  const BlendingConfig config = parse_blending_config(object, config_file);
  const BlendingResult result = run_blending(config, jobs);
  std::filesystem::create_directories(out);
  harness::write_file(out / "blends.csv", blends_csv(config, result));
  harness::write_file(out / "examples.csv", examples_csv(config, result));
  harness::write_file(out / "weights.csv", weights_csv(config, result));
  harness::write_file(out / "trends.csv", trends_csv(config, result));
  harness::write_file(out / "networks.csv", networks_csv(config, result));
  const json manifest{{"build", harness::build_info()}, {"config", object}};
  harness::write_file(out / "manifest.json", manifest.dump(2) + "\n");
  return std::ranges::all_of(result.rows, [](const BlendRow& row) { return row.status == "ok"; });
}

}  // namespace
}  // namespace plat::blending

int main(int argc, char** argv) {
  CLI::App app{
      "Do attributes and measures of a blend lie between its examples' and move with the weight?\n"
      "Example: layout_blending --out out/layout_blending && \\\n"
      "    python3 experiments/layout_blending/draw.py out/layout_blending\n"
      "Exit status: 0 done, 1 a network could not be grown, 2 bad input"};
  std::string config =
      (plat::harness::experiments_folder() / "layout_blending" / "config.json").string();
  std::string out;
  plat::Jobs jobs;
  app.add_option("--config", config, "what to run")->capture_default_str();
  app.add_option("--out", out, "folder for the tables and manifest.json")->required();
  app.add_option("--jobs", jobs.count, "threads, 0 = all cores; results do not depend on it");
  CLI11_PARSE(app, argc, argv);
  try {
    return plat::blending::run(config, out, jobs) ? 0 : 1;
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "layout_blending: {}\n", error.what());
    return 2;
  }
}
