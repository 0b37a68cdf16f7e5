#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "blocks/blocks_from_parcels.h"
#include "command.h"
#include "geodata/layer_io.h"
#include "harness/block_reading.h"
#include "harness/city_layers.h"
#include "harness/subdivision.h"
#include "harness/trace_layers.h"
#include "output_file.h"
#include "set_option.h"

namespace plat::cli {
namespace {

struct Arguments {
  std::string blocks;
  std::string streets;
  std::string observed;
  std::string strategy;
  std::vector<std::string> settings;
  std::uint64_t seed = 1;
  Jobs jobs;
  std::string out;
  std::string trace;
};

harness::StrategyConfig strategy_of(const Arguments& args) {
  harness::StrategyConfig strategy;
  strategy.name = strategy.label = args.strategy;
  strategy.options = options_from_settings(args.settings);
  static_cast<void>(parcels::block_subdividers().make(
      strategy.name, strategy.options));  // before any file is read
  return strategy;
}

ExitStatus run(const Arguments& args) {
  const harness::StrategyConfig strategy = strategy_of(args);
  expect_output(args.out, {args.blocks, args.streets, args.observed});
  if (!args.trace.empty()) {
    expect_output(args.trace, {args.blocks, args.streets, args.observed}, "--trace");
    if (args.trace == args.out)
      throw InputError(fmt::format("--trace {}: is --out; choose another file", args.trace));
  }
  harness::ReadBlocks read =
      harness::read_blocks(geodata::parse_layer_source(args.blocks), args.jobs);
  harness::label_from_streets(read, args.streets, args.jobs);
  std::vector<parcels::ParcelStyle> styles;
  if (!args.observed.empty())
    styles = harness::observed_styles(read, geodata::parse_layer_source(args.observed));

  std::vector<parcels::SubdivisionTrace> traces(args.trace.empty() ? 0 : read.blocks.size());
  Progress progress(args.strategy, read.blocks.size());
  const std::vector<harness::DividedBlock> divided = harness::subdivide_blocks(
      read.blocks, strategy, styles, "subdivide", args.seed, 0, args.jobs, progress, traces);

  harness::ParcelLayer parcels("parcels", read.frame);
  parcels.add(divided, 0, args.strategy);
  harness::FailureLayer failures(read.frame);
  for (const blocks::BlockFailure& failure : read.failures) {
    failures.add(failure.feature_id, "input", 0, failure.failure, failure.shape);
  }
  for (std::size_t i = 0; i < divided.size(); ++i) {
    if (divided[i].parcels) continue;
    failures.add(fmt::format("{}", divided[i].block.value), args.strategy, 0,
                 divided[i].parcels.error(), read.blocks[i].contour);
  }
  const std::vector<geodata::Layer> layers{
      parcels.layer(), harness::block_layer(read.blocks, read.frame), failures.layer()};
  geodata::write_layers(args.out, layers);
  if (!args.trace.empty())
    geodata::write_layers(args.trace, harness::trace_layers(read.blocks, traces, read.frame));
  fmt::print("{}: {} parcels in {} blocks, {} failures\n", args.out,
             parcels.layer().features.size(), read.blocks.size(), failures.layer().features.size());
  return failures.layer().features.empty() ? kDone : kFinishedWithFailures;
}

}  // namespace

void add_subdivide_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("subdivide", "Divide blocks into parcels by one strategy");
  command->add_option("--blocks", args->blocks, "block polygons, FILE[:layer]")->required();
  command->add_option("--streets", args->streets,
                      "centrelines, FILE[:layer]: tell which street an edge faces and how wide it "
                      "is; without, gaps between blocks do");
  command->add_option("--observed", args->observed,
                      "observed parcels, FILE[:layer]: options are fitted to them block by block; "
                      "--set wins over fitted values");
  command
      ->add_option("--strategy", args->strategy,
                   "block subdivision strategy (plat list strategies)")
      ->required();
  command->add_option("--set", args->settings, "option of the strategy, key=value; may be repeated")
      ->take_all();
  command->add_option("--seed", args->seed, "random seed; same seed, same bytes")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--jobs", args->jobs.count,
                   "threads, 0 = all cores; results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command
      ->add_option("--out", args->out,
                   "GeoPackage to write: layers parcels (block and parcel id, strategy, measures), "
                   "blocks (block id, the input feature it was) and failures")
      ->required();
  command->add_option("--trace", args->trace,
                      "GeoPackage to write as well: inner steps of the strategy, where it shows "
                      "them. obb: lot_boxes and splits, numbered by depth; skeleton: "
                      "skeleton_faces and _arcs, offset_contour, walls, beta_strips, slices");
  command->footer(
      "Example:\n  plat subdivide --blocks city.gpkg:blocks --streets city.gpkg:streets --strategy "
      "obb \\\n"
      "      --set street_access=0.5 --set area_max_m2=600 --out parcels.gpkg\n"
      "Areas are in m2, lengths in m; the output is in the blocks' projected CRS, or UTM.\n"
      "Exit status: 0 done, 1 finished with failures listed in the layer, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
