#include <fmt/format.h>

#include <memory>

#include "command.h"
#include "geodata/dataset_catalogue.h"
#include "geodata/layer_io.h"
#include "harness/city_layers.h"
#include "harness/observed_tiles.h"
#include "harness/tile_layers.h"
#include "output_file.h"

namespace plat::cli {
namespace {

struct Arguments {
  std::string dataset;
  harness::TileSources sources;
  std::vector<double> near;
  std::optional<std::size_t> count;
  tiles::ConstructionOptions options;
  std::string out;
  Jobs jobs;
};

harness::ObservedTiles find_tiles(const Arguments& args) {
  harness::TileSelection selection{args.count, {}};
  if (!args.near.empty()) selection.near = Point{args.near.at(0), args.near.at(1)};
  if (!args.dataset.empty())
    return harness::load_tiles(geodata::dataset(args.dataset), selection, args.options, args.jobs);
  return harness::read_tiles(args.sources, selection, args.options, args.jobs);
}

ExitStatus run(const Arguments& args) {
  if (args.dataset.empty() == args.sources.parcels.empty())
    throw InputError("plat tiles: give either --dataset or --parcels");
  if (!args.dataset.empty() && !(args.sources.streets.empty() && args.sources.zone_field.empty() &&
                                 args.sources.id_field.empty())) {
    throw InputError(
        "plat tiles: --streets, --parcel-id and --zone-field go with --parcels; a data set has its "
        "own");
  }
  if (!args.near.empty() && !args.count)
    throw InputError("plat tiles: --near goes with --count, the number of tiles");
  expect_output(args.out, {args.sources.parcels, args.sources.streets});
  const harness::ObservedTiles place = find_tiles(args);
  const tiles::TileLayout& layout = place.tiles.layout;
  std::vector<geodata::Layer> layers = harness::tile_layers(layout, place.frame);
  layers.push_back(harness::street_layer(place.network, place.frame));
  layers.push_back(harness::tile_failure_layer(place.tiles.failures, place.frame));
  geodata::write_layers(args.out, layers);

  const harness::LayoutCounts counts = harness::counts_of(layout, place.network);
  fmt::print("{}: {} streets, {} boundaries, {} tiles\n", args.out, counts.streets,
             counts.boundaries, counts.tiles);
  fmt::print("{} blocks, {} vertices, {} joints, {} links, {} failures\n", counts.blocks,
             counts.vertices, counts.joints, counts.links, place.tiles.failures.size());
  return place.tiles.failures.empty() ? kDone : kFinishedWithFailures;
}

}  // namespace

void add_tiles_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "tiles",
      "Make tiles of observed parcels, or of blocks where no parcels are known, as plat "
      "reconfigure\n"
      "moves them [ABVA08].\n"
      "Writes the layers tiles, joints (vertices that constrain), links (across streets), streets\n"
      "and failures; prints what Table 1 of the paper counts: streets between tiles, boundaries\n"
      "(pairs of tiles with an edge in common) and tiles.\n"
      "Exit status: 0 done, 1 finished with failures listed in the layer, 2 bad input.\n"
      "Example: plat tiles --dataset cambridge_ma --near 233000 901000 --count 2000 --out t.gpkg");
  command->add_option("--dataset", args->dataset, "a place of the catalogue (plat data list)");
  command->add_option("--parcels", args->sources.parcels, "observed parcels, FILE[:layer]");
  command->add_option("--parcel-id", args->sources.id_field, "field with the parcels' ids");
  command->add_option("--zone-field", args->sources.zone_field,
                      "field with the parcels' zone or land use");
  command->add_option("--streets", args->sources.streets,
                      "centrelines, FILE[:layer]: links lie on them; without, half way");
  command
      ->add_option("--near", args->near,
                   "with --count: metres east and north in the place's projected CRS; the middle "
                   "of the place where not given")
      ->expected(2);
  command->add_option("--count", args->count, "only the tiles nearest to a point, so many")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--matching", args->options.matching_m,
                   "vertices of a block nearer than this are one, metres")
      ->check(CLI::Range(0.0, 2.0))
      ->capture_default_str();
  command
      ->add_option("--reach", args->options.links.reach_m,
                   "fronts farther apart than this have no street between them, metres")
      ->check(CLI::Range(1.0, 500.0))
      ->capture_default_str();
  command->add_option("--out", args->out, "GeoPackage to write")->required();
  command->add_option("--jobs", args->jobs.count, "threads, 0 = all")->check(CLI::Range(0, 1024));
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
