#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "core/atomic_file.h"
#include "geodata/layer_io.h"
#include "harness/network_report.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"

namespace plat::cli {
namespace {

using geodata::GeometryKind;
using geodata::Layer;

struct Arguments {
  std::string streets;
  std::string land;
  std::string out;
  double snap_m = streets::CleaningOptions{}.snap_m;
  streets::NetworkMeasureOptions options;
  std::uint64_t seed = 1;
};

double area_of(const Layer& layer) {
  double area = 0.0;
  for (const geodata::Feature& feature : layer.features) {
    for (const Polygon& polygon : feature.polygons) area += area_m2(polygon);
  }
  if (!(area > 0.0))
    throw InputError(fmt::format("--land: layer \"{}\" has no area to count by", layer.name));
  return area;
}

ExitStatus run(const Arguments& args) {
  if (std::filesystem::path(args.out).extension() != ".json")
    throw InputError(fmt::format("--out {}: must be a file that ends in .json", args.out));
  geodata::ReadOptions reading;
  reading.kind = GeometryKind::kLine;
  const Layer layer = geodata::read_layer(geodata::parse_layer_source(args.streets), reading);
  streets::RawStreets raw = streets::import_streets(layer);
  streets::CleanNetwork clean = streets::build_network(raw.streets, {.snap_m = args.snap_m});
  raw.repairs.insert(raw.repairs.end(), clean.repairs.begin(), clean.repairs.end());
  streets::NetworkMeasureOptions options = args.options;
  if (!args.land.empty()) {
    reading.kind = GeometryKind::kPolygon;
    reading.frame = layer.frame;
    options.land_area_m2 =
        area_of(geodata::read_layer(geodata::parse_layer_source(args.land), reading));
  }
  Rng rng(derive_seed(args.seed, {seed_key("measures")}));
  const streets::NetworkMeasures measures = streets::measure_network(clean.network, options, rng);
  write_file(args.out, harness::network_report(measures, layer.frame).dump(1) + "\n");
  for (const streets::NetworkScalar& scalar : streets::network_scalars()) {
    const std::optional<double> value = scalar.value(measures);
    fmt::print("{:34} {} {}\n", scalar.name, value ? fmt::format("{:.6g}", *value) : "none",
               scalar.unit);
  }
  fmt::print("{}: {} nodes, {} edges, {} faces; {}\n", args.out, measures.graph.nodes.size(),
             measures.graph.edges.size(), measures.block_area_m2.size(),
             streets::summary(raw.repairs));
  return kDone;
}

}  // namespace

void add_measures_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "measures",
      "Measure a street network: degrees, lengths, densities, circuity, faces, orientation\n"
      "entropy, transport ratio, betweenness (docs/measures.md defines each)");
  command->add_option("streets", args->streets, "centrelines, FILE[:layer]; cleaned first")
      ->required();
  command
      ->add_option("--out", args->out,
                   "JSON file to write: scalars, samples, nodes, edges, faces and the routes drawn")
      ->required();
  command->add_option("--land", args->land,
                      "polygons that do not overlap, FILE[:layer]: densities are per their area; "
                      "per the area of the streets' bounded faces if not given");
  command
      ->add_option("--sources", args->options.routes.sources,
                   "nodes drawn as starts of routes and pivots of betweenness")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_option("--targets", args->options.routes.targets, "ends of routes drawn per source")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command
      ->add_option("--snap", args->snap_m,
                   "an end nearer than this to a street is moved onto it, metres")
      ->check(CLI::Range(0.0, 20.0))
      ->capture_default_str();
  command->add_option("--seed", args->seed, "random seed of what is drawn; same seed, same bytes")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command->footer(
      "Example:\n  plat measures city.gpkg:roads --out measures.json\n"
      "Exit status: 0 done, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
