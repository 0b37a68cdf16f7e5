#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "blocks/block_extraction.h"
#include "blocks/blocks_from_parcels.h"
#include "blocks/edge_labels.h"
#include "command.h"
#include "geodata/layer_io.h"
#include "harness/city_layers.h"
#include "harness/observed_layers.h"
#include "output_file.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "streets/street_width.h"

namespace plat::cli {
namespace {

using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;

struct Arguments {
  std::string streets;
  std::string parcels;
  std::string out;
  std::string parcel_id_field;
  streets::StreetFields fields;
  double snap_m = streets::CleaningOptions{}.snap_m;
  bool all_classes = false;
  Jobs jobs;
};

struct Result {
  geodata::LocalFrame frame;
  streets::StreetNetwork network;
  std::vector<streets::Repair> repairs;
  std::vector<blocks::Block> blocks;
  std::vector<blocks::BlockFailure> failures;
};

std::int64_t number(std::size_t value) { return static_cast<std::int64_t>(value); }

bool is_drawable(const Polygon& polygon) {
  bool is_finite = !polygon.outer.empty();
  for_each_edge(polygon, [&](const Segment& s) {
    is_finite = is_finite && std::isfinite(s.a.x) && std::isfinite(s.a.y);
  });
  return is_finite;
}

std::size_t street_edge_count(const blocks::Block& block) {
  std::size_t count = 0;
  for (const auto& ring : block.edges) {
    for (const blocks::BlockEdge& edge : ring) count += edge.is_street() ? 1 : 0;
  }
  return count;
}

Layer blocks_layer(const Result& result) {
  Layer layer{"blocks",
              GeometryKind::kPolygon,
              result.frame,
              {{"block", FieldType::kInteger},
               {"source", FieldType::kText},
               {"area_m2", FieldType::kReal},
               {"perimeter_m", FieldType::kReal},
               {"street_edges", FieldType::kInteger}},
              {}};
  for (const blocks::Block& block : result.blocks) {
    Feature feature;
    feature.id = std::to_string(block.id.value);
    feature.polygons.push_back(block.contour);
    feature.attributes = {number(block.id.value), block.source_id, area_m2(block.contour),
                          perimeter_m(block.contour), number(street_edge_count(block))};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

Layer edges_layer(const Result& result) {
  Layer layer{"block_edges",
              GeometryKind::kLine,
              result.frame,
              {{"block", FieldType::kInteger},
               {"ring", FieldType::kInteger},
               {"edge", FieldType::kInteger},
               {"logical_street", FieldType::kInteger},
               {"street", FieldType::kInteger},
               {"name", FieldType::kText},
               {"width_m", FieldType::kReal},
               {"width_source", FieldType::kText}},
              {}};
  for (const blocks::Block& block : result.blocks) {
    for (std::size_t r = 0; r < block.edges.size(); ++r) {
      const Ring& ring = blocks::ring_at(block, r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const blocks::BlockEdge& edge = block.edges[r][i];
        Feature feature;
        feature.id = std::to_string(layer.features.size());
        feature.lines.push_back({ring[i], ring[(i + 1) % ring.size()]});
        feature.attributes.assign(layer.fields.size(), std::monostate{});
        feature.attributes[0] = number(block.id.value);
        feature.attributes[1] = number(r);
        feature.attributes[2] = number(i);
        if (edge.logical_street) feature.attributes[3] = number(*edge.logical_street);
        if (edge.street) {
          feature.attributes[4] = number(edge.street->value);
          feature.attributes[5] = result.network.streets[edge.street->value].attributes.name;
        }
        feature.attributes[6] = edge.street_width_m;
        feature.attributes[7] = std::string(blocks::width_source_name(edge.width_source));
        layer.features.push_back(std::move(feature));
      }
    }
  }
  return layer;
}

Layer repairs_layer(const Result& result) {
  Layer layer{
      "repairs",
      GeometryKind::kPoint,
      result.frame,
      {{"feature", FieldType::kText}, {"reason", FieldType::kText}, {"detail", FieldType::kText}},
      {}};
  for (const streets::Repair& repair : result.repairs) {
    Feature feature;
    feature.id = std::to_string(layer.features.size());
    feature.points.push_back(repair.place);
    feature.attributes = {repair.feature_id, std::string(streets::repair_name(repair.kind)),
                          repair.detail};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

Layer failures_layer(const Result& result) {
  Layer layer{
      "failures",
      GeometryKind::kPolygon,
      result.frame,
      {{"feature", FieldType::kText}, {"code", FieldType::kText}, {"message", FieldType::kText}},
      {}};
  for (const blocks::BlockFailure& row : result.failures) {
    Feature feature;
    feature.id = std::to_string(layer.features.size());
    if (is_drawable(row.shape)) feature.polygons.push_back(row.shape);
    feature.attributes = {row.feature_id, std::string(failure_name(row.failure.code)),
                          row.failure.message};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

Result find_blocks(const Arguments& arguments) {
  Result result;
  std::vector<blocks::ObservedParcel> observed;
  geodata::ReadOptions reading;
  if (!arguments.parcels.empty()) {
    reading.kind = GeometryKind::kPolygon;
    const Layer layer =
        geodata::read_layer(geodata::parse_layer_source(arguments.parcels), reading);
    observed = harness::parcels_of(layer, arguments.parcel_id_field);
    result.frame = layer.frame;
    reading.frame = layer.frame;
  }
  if (!arguments.streets.empty()) {
    reading.kind = GeometryKind::kLine;
    const Layer layer =
        geodata::read_layer(geodata::parse_layer_source(arguments.streets), reading);
    result.frame = layer.frame;
    streets::RawStreets raw = streets::import_streets(layer, arguments.fields);
    result.repairs = std::move(raw.repairs);
    streets::CleanNetwork clean = streets::build_network(raw.streets, {.snap_m = arguments.snap_m});
    result.network = std::move(clean.network);
    result.repairs.insert(result.repairs.end(), clean.repairs.begin(), clean.repairs.end());
  }
  if (arguments.parcels.empty()) {
    streets::assign_widths(result.network, {}, {}, arguments.jobs);
    blocks::ExtractionOptions options;
    if (arguments.all_classes) options.bounding = streets::BoundingClasses::kAll;
    auto found = blocks::extract_blocks(result.network, options, arguments.jobs);
    result.blocks = std::move(found.blocks);
    result.failures = std::move(found.failures);
    return result;
  }
  auto found = blocks::blocks_from_parcels(observed, {}, arguments.jobs);
  result.blocks = std::move(found.blocks);
  result.failures = std::move(found.failures);
  std::vector<Polygon> land;
  for (const blocks::Block& block : result.blocks) land.push_back(block.contour);
  streets::assign_widths(result.network, land, {}, arguments.jobs);
  blocks::label_edges(result.blocks, result.network, {}, arguments.jobs);
  return result;
}

ExitStatus run(const Arguments& arguments) {
  if (arguments.streets.empty() && arguments.parcels.empty())
    throw InputError("plat blocks: give --streets, --parcels or both");
  expect_output(arguments.out, {arguments.streets, arguments.parcels});
  const Result result = find_blocks(arguments);
  const std::vector<Layer> layers{blocks_layer(result), edges_layer(result),
                                  harness::street_layer(result.network, result.frame),
                                  repairs_layer(result), failures_layer(result)};
  geodata::write_layers(arguments.out, layers);
  fmt::print("{}: {} blocks, {} streets, {} failures; {}\n", arguments.out, result.blocks.size(),
             result.network.streets.size(), result.failures.size(),
             streets::summary(result.repairs));
  return result.failures.empty() ? kDone : kFinishedWithFailures;
}

}  // namespace

void add_blocks_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "blocks",
      "Find the blocks that streets enclose, or, with --parcels, the blocks that parcels form.\n"
      "Writes the layers blocks, block_edges (street, width in metres and its source per edge),\n"
      "streets (cleaned, noded), repairs and failures, in the input's projected CRS or UTM.\n"
      "Street widths in metres: from a width field, else lanes, else the gap between parcels,\n"
      "else a table by class.\n"
      "Exit status: 0 done, 1 finished with failures listed in the layer, 2 bad input.\n"
      "Example: plat blocks --streets city.gpkg:roads --parcels city.gpkg:parcels --out b.gpkg");
  command->add_option("--streets", arguments->streets, "centrelines, FILE[:layer]");
  command->add_option("--parcels", arguments->parcels,
                      "observed parcels, FILE[:layer]: blocks are their unions");
  command->add_option("--out", arguments->out, "GeoPackage to write")->required();
  command->add_option("--jobs", arguments->jobs.count, "threads, 0 = all")
      ->check(CLI::Range(0, 1024));
  command->add_option("--parcel-id", arguments->parcel_id_field, "field with the parcels' ids");
  command->add_option("--name-field", arguments->fields.name, "field with street names");
  command->add_option("--class-field", arguments->fields.street_class,
                      "field with street classes (default: highway, class)");
  command->add_option("--class-prefix", arguments->fields.class_prefix,
                      "put before the class, e.g. major_");
  command->add_option("--default-class", arguments->fields.default_class,
                      "class of streets without one");
  command->add_option("--width-field", arguments->fields.width, "field with widths, metres");
  command->add_option("--lanes-field", arguments->fields.lanes, "field with lane counts");
  command->add_option("--level-field", arguments->fields.level,
                      "field with levels, 0 = ground (default: layer)");
  command->add_option("--structure-field", arguments->fields.structure,
                      "field that says bridge or tunnel (default: structure, bridge, tunnel)");
  command
      ->add_option("--snap", arguments->snap_m,
                   "an end nearer than this to a street is moved onto it, metres")
      ->check(CLI::Range(0.0, 20.0))
      ->capture_default_str();
  command->add_flag("--all-classes", arguments->all_classes,
                    "paths, service roads and rails bound blocks too");
  command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace plat::cli
