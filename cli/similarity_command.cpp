#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include "command.h"
#include "core/progress.h"
#include "geodata/layer_io.h"
#include "harness/similarity_layers.h"
#include "harness/tile_shapes.h"
#include "output_file.h"
#include "set_option.h"
#include "similarity/shape_clusters.h"
#include "similarity/similarity_file.h"

namespace plat::cli {
namespace {

using similarity::AnyShapeSimilarity;

struct Arguments {
  std::string tiles;
  std::string zone_field;
  std::string measure = "affine_vertex";
  std::vector<std::string> settings;
  std::vector<std::string> cluster_settings;
  std::optional<std::uint32_t> keep;
  std::string cheap = "box";
  std::size_t nearest = 5;
  std::string matrix;
  std::string out;
  std::uint64_t seed = 1;
  Jobs jobs;
};

AnyShapeSimilarity measure_of(const Arguments& args) {
  return similarity::shape_similarities().make(args.measure, options_from_settings(args.settings));
}

/// @throws InputError where the layer has no such field
void expect_zone_field(const geodata::LayerSource& source, const std::string& field) {
  if (field.empty()) return;
  std::string known;
  for (const geodata::LayerInfo& layer : geodata::list_layers(source.file)) {
    if (source.layer && layer.name != *source.layer) continue;
    for (const geodata::FieldSchema& schema : layer.fields) {
      if (schema.name == field) return;
      known += (known.empty() ? "" : ", ") + schema.name;
    }
  }
  throw InputError(
      fmt::format("{}: no field \"{}\" (known: {})", geodata::to_string(source), field, known));
}

harness::ReadTileShapes read_tiles(const Arguments& args) {
  harness::ParcelShapeSources sources = harness::parcel_shape_sources(args.tiles);
  expect_zone_field(sources.parcels, args.zone_field);
  sources.zone_field = args.zone_field;
  harness::ReadTileShapes tiles = harness::read_tile_shapes(sources, args.jobs);
  if (tiles.shapes.empty())
    throw InputError(fmt::format("{}: none of its {} features is a usable tile", args.tiles,
                                 tiles.failures.size()));
  return tiles;
}

void print_summary(const Arguments& args, const harness::ReadTileShapes& tiles,
                   const similarity::Clusters& clusters, const similarity::SimilarityMatrix& matrix,
                   std::size_t failures) {
  std::set<std::string> zones;
  for (const auto& shape : tiles.shapes) {
    if (!shape.zone.empty()) zones.insert(shape.zone);
  }
  std::size_t largest = 0;
  for (const auto& members : clusters.members) largest = std::max(largest, members.size());
  fmt::print("{}: {} tiles, {} zones, {} clusters (largest {}), {} distances\n", args.out,
             tiles.shapes.size(), zones.size(), clusters.members.size(), largest,
             matrix.entries.size());
  if (tiles.without_streets > 0)
    fmt::print("{} tiles in no block: their edges are not labelled\n", tiles.without_streets);
  if (failures > 0) fmt::print("{} failures in layer failures\n", failures);
}

ExitStatus run(const Arguments& args) {
  const auto cluster_options = from_option_map<similarity::ClusterOptions>(
      "clusters", options_from_settings(args.cluster_settings));
  const AnyShapeSimilarity measure = measure_of(args);
  std::optional<similarity::MatrixPruning> pruning;
  if (args.keep) pruning = {similarity::shape_similarities().make(args.cheap), *args.keep};
  expect_output(args.out, {args.tiles});
  if (!args.matrix.empty()) expect_output(args.matrix, {args.tiles}, "--matrix", ".platsim");
  const harness::ReadTileShapes tiles = read_tiles(args);
  const similarity::Clusters clusters =
      similarity::cluster_shapes(tiles.shapes, cluster_options, args.seed, args.jobs);
  const similarity::MatrixInputs inputs{tiles.shapes, clusters, measure, pruning};
  similarity::LoadedSimilarity loaded;
  if (args.matrix.empty()) {
    loaded.matrix = similarity::compute_matrix(inputs, args.jobs, Progress::Style::kAutomatic);
  } else {
    loaded = similarity::load_or_compute_similarity(args.matrix, inputs, args.jobs,
                                                    Progress::Style::kAutomatic);
    fmt::print("{}\n", loaded.why_computed.empty()
                           ? args.matrix + ": read, nothing was computed again"
                           : "computed: " + loaded.why_computed);
  }
  const std::vector<geodata::Layer> layers =
      harness::similarity_layers(tiles, clusters, loaded.matrix, args.nearest);
  geodata::write_layers(args.out, layers);
  const std::size_t failures = layers.back().features.size();
  print_summary(args, tiles, clusters, loaded.matrix, failures);
  return failures == 0 ? kDone : kFinishedWithFailures;
}

void add_measure_options(CLI::App& command, Arguments& args) {
  command
      .add_option("--measure", args.measure,
                  "shape similarity; plat list strategies describes them all")
      ->capture_default_str();
  command.add_option("--set", args.settings, "option of the measure, key=value; may be repeated")
      ->take_all();
  command
      .add_option("--clusters", args.cluster_settings,
                  "key=value; may be repeated: percent (of the tiles: how many clusters, 1), "
                  "zone_weight, area_weight, corner_count_weight, mean_angle_weight, "
                  "angle_deviation_weight")
      ->take_all();
  command
      .add_option("--keep", args.keep,
                  "per tile only the distances to so many of its cluster, the nearest by --cheap "
                  "(default: to all of its cluster)")
      ->check(CLI::Range(1U, 1000000U));
  command.add_option("--cheap", args.cheap, "measure that chooses what --keep keeps")
      ->capture_default_str();
}

}  // namespace

void add_similarity_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "similarity", "Put tiles into clusters and compare those of each cluster [ABVA08, Sec. 5]");
  command
      ->add_option("--tiles", args->tiles,
                   "polygons, FILE[:layer]; of a file, its layers parcels, blocks and streets: "
                   "they tell which edges face a street")
      ->required();
  command->add_option("--zone-field", args->zone_field, "field of the tiles that names their zone");
  add_measure_options(*command, *args);
  command->add_option("--nearest", args->nearest, "how many of the most similar tiles are written")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  command->add_option("--matrix", args->matrix,
                      "file for the distances, .platsim: read where it is of these tiles, clusters "
                      "and options, else computed and written");
  command
      ->add_option("--out", args->out,
                   "GeoPackage to write: layer tiles with cluster, representative and nearest "
                   "tiles, layer nearest with a line to each, layer failures")
      ->required();
  command->add_option("--seed", args->seed, "of the clusters")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command->add_option("--jobs", args->jobs.count, "threads, 0 = all cores")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->footer(
      "Example:\n  plat similarity --tiles city.gpkg --clusters percent=5 --matrix city.platsim "
      "--out similar.gpkg\n"
      "Exit status: 0 done, 1 finished with failures listed in the layer, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
