#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "command.h"
#include "geodata/dataset_catalogue.h"
#include "harness/experiment.h"

namespace plat::cli {

void add_run_command(CLI::App& app, Action& action) {
  struct Arguments {
    std::string config;
    std::string out;
    std::string data;
    std::optional<std::uint64_t> seed;
    Jobs jobs;
    bool resume = false;
  };
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "run", "Run an experiment: data set x strategy[options] x repetition, with its statistics");
  command
      ->add_option("config", args->config,
                   "a config.json, or the name of an experiment (plat list experiments)")
      ->required();
  command
      ->add_option("--out", args->out,
                   "folder for CSV tables, GeoPackage and manifest.json; made if missing")
      ->required();
  command->add_option("--data", args->data,
                      "data set instead of the config's (plat list datasets)");
  command
      ->add_option("--seed", args->seed,
                   "random seed instead of the config's; same seed, same bytes")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--jobs", args->jobs.count,
                   "threads; 0 = all cores. Results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->add_flag("--resume", args->resume,
                    "take over the finished cells of an interrupted run in DIR");
  command->footer(
      "Example:\n  plat run parcels_vs_observed --data cambridge_ma --out out/cambridge && plat "
      "report out/cambridge\n"
      "Writes into DIR: parcels.csv, blocks.csv, distances.csv, differences.csv, histograms.csv, "
      "summary.json,\n"
      "layout_<dataset>.gpkg, manifest.json, timings.json (docs/run_directory.md).\n"
      "Exit status: 0 done, 1 finished with failures (rows of blocks.csv, layer failures), 2 bad "
      "input.");
  command->callback([args, &action] {
    action = [args]() -> ExitStatus {
      harness::ExperimentConfig config = harness::read_config(args->config);
      if (!args->data.empty()) config.datasets = {geodata::dataset(args->data).name};
      if (args->seed) config.seed = *args->seed;
      const auto outcome =
          harness::run_experiment(config, args->out, args->jobs,
                                  args->resume ? harness::Resume::kYes : harness::Resume::kNo);
      fmt::print("{}: {} block divisions, {} failed; {} observed parcels or blocks refused{}\n",
                 args->out, outcome.blocks, outcome.failures, outcome.input_failures,
                 outcome.resumed_cells > 0
                     ? fmt::format("; {} cells taken over", outcome.resumed_cells)
                     : std::string());
      fmt::print("next: plat report {}\n", args->out);
      return outcome.failures > 0 ? kFinishedWithFailures : kDone;
    };
  });
}

}  // namespace plat::cli
