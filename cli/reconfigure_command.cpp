#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "command.h"
#include "core/options.h"
#include "core/progress.h"
#include "geodata/dataset_catalogue.h"
#include "geodata/layer_io.h"
#include "harness/reconfigure_script.h"
#include "harness/reconfigure_session.h"
#include "harness/tile_imagery.h"
#include "harness/tiled_city.h"
#include "output_file.h"
#include "parcels/block_subdivider.h"
#include "set_option.h"

namespace plat::cli {
namespace {

struct Arguments {
  std::string script;
  std::string city;
  std::string dataset;
  std::vector<double> near;
  std::optional<std::size_t> count;
  std::string out;
  std::string image;
  std::string image_out;
  std::vector<std::string> settings;
  harness::CityReading reading;
};

void print_step(std::size_t number, const harness::ReconfigureStep& step,
                const harness::StepReport& report, double time_ms) {
  fmt::print("operation {} {}:", number, step.name);
  if (report.named > 0) fmt::print(" {} tiles named;", report.named);
  if (const auto& tiles = report.edit.tiles) {
    fmt::print(" {} moved, {} new, {} gone;", tiles->moved.size(), tiles->appeared.size(),
               tiles->vanished.size());
    if (tiles->replacements + tiles->replacements_refused + tiles->replacements_without_place > 0) {
      fmt::print(" {} replaced, {} tried in vain, {} without place, {} rounds;",
                 tiles->replacements, tiles->replacements_refused,
                 tiles->replacements_without_place, tiles->rounds);
    }
    if (tiles->stiffened > 0) fmt::print(" {} stiffened so that none overlap;", tiles->stiffened);
    fmt::print(
        " mean gap {:.3f} -> {:.3f} m, across streets {:.3f} -> {:.3f} m, deformation {:.4f} -> "
        "{:.4f}, at most {:.4f};",
        report.before->mean_property_gap_m, tiles->mean_property_gap_m,
        report.before->mean_street_gap_m, tiles->mean_street_gap_m, report.before->mean_deformation,
        tiles->mean_deformation, tiles->largest_deformation);
    fmt::print(" streets: {} nodes moved, {} widths, ", report.edit.nodes_moved,
               report.edit.streets_resized);
    if (const std::size_t narrow = report.edit.streets_too_narrow; narrow > 0)
      fmt::print("{} of them with fronts in the street, ", narrow);
    fmt::print("blocks {} changed, {} new, {} gone;", report.edit.changed.size(),
               report.edit.appeared.size(), report.edit.vanished.size());
  }
  fmt::print(" {:.1f} ms\n", time_ms);
}

void add_failures(geodata::Layer& layer, const std::vector<tiles::TileFailure>& failures) {
  for (const tiles::TileFailure& failure : failures) {
    geodata::Feature row;
    row.id = fmt::format("{}", layer.features.size() + 1);
    if (failure.shape.outer.size() >= 3) row.polygons.push_back(failure.shape);
    row.attributes = {fmt::format("tile of {}", failure.source_id),
                      std::string(failure_name(failure.failure.code)), failure.failure.message};
    layer.features.push_back(std::move(row));
  }
}

harness::TiledCity find_city(const Arguments& args) {
  const editing::CityOptions& options = args.reading.options;
  if (args.dataset.empty())
    return harness::with_tiles_of_parcels(harness::read_city(args.city, args.reading),
                                          options.jobs);
  harness::TileSelection selection{args.count, {}};
  if (!args.near.empty()) selection.near = Point{args.near.at(0), args.near.at(1)};
  return harness::city_of_observed_tiles(
      harness::load_tiles(geodata::dataset(args.dataset), selection, {}, options.jobs), options);
}

/// @returns how many steps were refused
std::size_t replay(const harness::ReconfigureScript& script, harness::ReconfigureSession& session) {
  std::size_t refused = 0;
  Progress progress("reconfigure", script.steps.size());
  for (std::size_t i = 0; i < script.steps.size(); ++i) {
    const harness::ReconfigureStep& step = script.steps[i];
    const auto start = std::chrono::steady_clock::now();
    const auto report = session.run(step);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    if (report) {
      print_step(i + 1, step, *report, time.count());
    } else {
      ++refused;
      fmt::print("operation {} {}: refused, {}: {}; {:.1f} ms\n", i + 1, step.name,
                 failure_name(report.error().code), report.error().message, time.count());
    }
    progress.step();
  }
  return refused;
}

ExitStatus run(Arguments args) {
  args.reading.options.style.options = options_from_settings(args.settings);
  static_cast<void>(parcels::block_subdividers().make(args.reading.options.style.strategy,
                                                      args.reading.options.style.options));
  if (args.city.empty() == args.dataset.empty())
    throw InputError("plat reconfigure: give either --city or --dataset");
  if (args.dataset.empty() && (!args.near.empty() || args.count))
    throw InputError("--near, --count: go with --dataset");
  if (!args.near.empty() && !args.count)
    throw InputError("--near goes with --count, the number of tiles");
  const harness::ReconfigureScript script = harness::read_reconfigure_script(args.script);
  expect_output(args.out, {args.city, args.script});
  if (args.image.empty() != args.image_out.empty())
    throw InputError("--image and --image-out: give both or none");
  if (!args.image_out.empty())
    expect_output(args.image_out, {args.image, args.city}, "--image-out", ".tif");
  harness::TiledCity tiled = find_city(args);
  harness::ReconfigureSession session(std::move(tiled.placed));
  const std::size_t refused = replay(script, session);
  std::vector<geodata::Layer> layers = harness::city_layers(session.city(), session.frame());
  add_failures(layers.back(), tiled.failures);
  geodata::write_layers(args.out, layers);
  if (!args.image.empty()) {
    const geodata::RasterGrid grid = harness::write_tile_image(
        args.image_out, *session.city().tiles(), args.image, session.frame(),
        args.reading.options.jobs, Progress::Style::kAutomatic);
    fmt::print("{}: {} x {} pixels of {} m\n", args.image_out, grid.width, grid.height,
               grid.pixel_m);
  }
  const std::size_t failures = layers.back().features.size();
  fmt::print("{}: {} tiles, {} streets, {} failures; {} of {} operations refused\n", args.out,
             session.city().tiles()->tiles.size(), session.city().streets().size(), failures,
             refused, script.steps.size());
  return refused + failures == 0 ? kDone : kFinishedWithFailures;
}

}  // namespace

void add_reconfigure_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("reconfigure",
                                         "Move, turn, copy, cut, paste and replace the tiles of a "
                                         "city; the others make room, streets\n"
                                         "go along [ABVA08]");
  command
      ->add_option("script", args->script,
                   "JSON file with the operations (docs/reconfigure_script.md)")
      ->required();
  command->add_option("--city", args->city,
                      "GeoPackage: what this command or plat edit wrote, or what plat blocks wrote "
                      "from streets; without tiles, its parcels become the tiles");
  command->add_option("--dataset", args->dataset,
                      "instead: a place of the catalogue (plat data list), its observed parcels "
                      "as tiles");
  command
      ->add_option("--near", args->near,
                   "with --dataset and --count: metres east and north in the place's projected "
                   "CRS (default: its middle)")
      ->expected(2);
  command->add_option("--count", args->count, "with --dataset: only the tiles nearest, so many")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--out", args->out,
                   "GeoPackage to write: layers tiles, tile_vertices, tile_links, and those of "
                   "plat edit; --city of a next call")
      ->required();
  command->add_option("--image", args->image,
                      "image of the city before any reconfiguration, whatever GDAL opens");
  command->add_option("--image-out", args->image_out,
                      "GeoTIFF to write, .tif: the same image, every tile's piece of it carried "
                      "where the tile is now");
  command
      ->add_option("--strategy", args->reading.options.style.strategy,
                   "how blocks are divided into tiles (plat list strategies), where the city has "
                   "neither tiles nor parcels")
      ->capture_default_str();
  command->add_option("--set", args->settings, "option of the strategy, key=value; may be repeated")
      ->take_all();
  command->add_option("--seed", args->reading.options.seed, "random seed; same seed, same bytes")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--jobs", args->reading.options.jobs.count,
                   "threads, 0 = all cores; results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->footer(
      "Example:\n  plat edit no_edits.json --city blocks.gpkg --strategy obb --out city.gpkg\n"
      "  plat reconfigure script.json --city city.gpkg --out reconfigured.gpkg\n"
      "Coordinates are metres in the city's CRS. An operation that would make tiles overlap or\n"
      "streets cross is refused and changes nothing.\n"
      "Exit status: 0 done, 1 finished with operations refused or failures in the layer, 2 bad "
      "input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
