// How the searches for sequences grow with every side of the problem: README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "harness/build_info.h"
#include "harness/json_file.h"
#include "rcksp_scaling/scaling_experiment.h"
#include "rcksp_scaling/scaling_tables.h"

namespace plat::rcksp {
namespace {

using nlohmann::json;

struct Arguments {
  std::string config = (harness::experiments_folder() / "rcksp_scaling" / "config.json").string();
  std::filesystem::path out;
  std::vector<std::string> studies;
};

/// What /proc/cpuinfo calls the processor; empty where there is none.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return {};
}

/// The mean number of busy processes over the last minute: what else the machine was doing.
double load() {
  double value = 0.0;
  std::ifstream("/proc/loadavg") >> value;
  return value;
}

void keep_only(ScalingConfig& config, const std::vector<std::string>& studies) {
  if (studies.empty()) return;
  for (const std::string& name : studies) {
    if (std::ranges::none_of(config.studies, [&](const Study& s) { return s.name == name; }))
      throw InputError(fmt::format("no study \"{}\" in the config", name));
  }
  std::erase_if(config.studies,
                [&](const Study& s) { return std::ranges::count(studies, s.name) == 0; });
}

/// @returns whether all strategies agreed and none crashed
bool run(const Arguments& args) {
  const json object = harness::read_json(args.config);
  const auto& menu = sequences::sequence_searches();
  ScalingConfig config = parse_scaling_config(object, args.config, menu);
  keep_only(config, args.studies);
  std::filesystem::create_directories(args.out);
  const double load_before = load();
  const harness::Stopwatch running;
  const auto cells = run_scaling(config, menu, [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  });
  write_file(args.out / "runs.csv", runs_csv(config, cells));
  write_file(args.out / "cells.csv", cells_csv(config, cells));
  write_file(args.out / "exponents.csv", exponents_csv(config, cells));
  write_file(args.out / "solutions.csv", solutions_csv(config, cells));
  write_file(args.out / "buildings.csv", buildings_csv(config));
  const json manifest{{"build", harness::build_info()},
                      {"config", object},
                      {"studies", args.studies},
                      {"processor", processor()},
                      {"load_before", load_before},
                      {"load_after", load()},
                      {"duration_s", running.elapsed().wall_s}};
  write_file(args.out / "manifest.json", manifest.dump(2) + "\n");
  return std::ranges::none_of(cells, [](const CellResult& cell) {
    return std::ranges::any_of(cell.contenders, [](const ContenderResult& contender) {
      const RunStatus status = contender.guarded.status;
      return status == RunStatus::kDisagrees || status == RunStatus::kInfeasible ||
             status == RunStatus::kCrashed;
    });
  });
}

}  // namespace
}  // namespace plat::rcksp

int main(int argc, char** argv) {
  plat::rcksp::Arguments args;
  CLI::App app{
      "Time, memory and states of every search for sequences over length, elements, resources, k "
      "...\n"
      "Example: rcksp_scaling --out out/rcksp_scaling && \\\n"
      "    python3 experiments/rcksp_scaling/draw_scaling.py out/rcksp_scaling\n"
      "Exit status: 0 done, 1 strategies disagree or crashed, 2 bad input"};
  app.add_option("--config", args.config, "what to run")->capture_default_str();
  app.add_option("--out", args.out, "folder for the tables and manifest.json")->required();
  app.add_option("--study", args.studies, "only this study (repeatable)");
  CLI11_PARSE(app, argc, argv);
  try {
    return plat::rcksp::run(args) ? 0 : 1;
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "rcksp_scaling: {}\n", error.what());
    return 2;
  }
}
