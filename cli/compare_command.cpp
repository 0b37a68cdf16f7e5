#include <fmt/format.h>

#include <cstdint>
#include <memory>

#include "command.h"
#include "geodata/layer_io.h"
#include "harness/layer_comparison.h"

namespace plat::cli {

void add_compare_command(CLI::App& app, Action& action) {
  struct Arguments {
    std::string observed;
    std::string generated;
    std::string out;
    statistics::ComparisonOptions options;
    std::uint64_t seed = 1;
    Jobs jobs;
  };
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Compare any two parcel layers, also ones that other programs made");
  command
      ->add_option("observed", args->observed,
                   "observed parcels, FILE[:layer]; blocks are their unions")
      ->required();
  command
      ->add_option("generated", args->generated,
                   "generated parcels, FILE[:layer], of the same place")
      ->required();
  command
      ->add_option("--out", args->out,
                   "folder for tables, GeoPackage and manifest.json; made if missing")
      ->required();
  command->add_option("--resamples", args->options.resamples, "bootstrap resamples of blocks")
      ->capture_default_str()
      ->check(CLI::Range(20, 1000000));
  command->add_option("--seed", args->seed, "random seed of the bootstrap")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--jobs", args->jobs.count,
                   "threads, 0 = all cores; results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->footer(
      "Example:\n  plat compare city.gpkg:parcels parcels.gpkg:parcels --out out/compare && plat "
      "report out/compare\n"
      "Exit status: 0 done, 1 finished with failures listed (parcels outside every block, refused "
      "input), 2 bad input.");
  command->callback([args, &action] {
    action = [args]() -> ExitStatus {
      const auto outcome = harness::compare_layers(
          geodata::parse_layer_source(args->observed), geodata::parse_layer_source(args->generated),
          args->out, args->options, args->seed, args->jobs);
      fmt::print(
          "{}: {} observed and {} generated parcels in {} blocks; {} generated outside every "
          "block, {} observed refused\n",
          args->out, outcome.observed, outcome.generated, outcome.blocks, outcome.outside,
          outcome.input_failures);
      fmt::print("next: plat report {}\n", args->out);
      return outcome.outside + outcome.input_failures > 0 ? kFinishedWithFailures : kDone;
    };
  });
}

}  // namespace plat::cli
