#include "harness/layer_comparison.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "blocks/block_assignment.h"
#include "blocks/blocks_from_parcels.h"
#include "blocks/edge_labels.h"
#include "core/atomic_file.h"
#include "core/working_grid.h"
#include "harness/build_info.h"
#include "harness/city_layers.h"
#include "harness/comparison_tables.h"
#include "harness/experiment_config.h"
#include "harness/observed_layers.h"
#include "harness/run_tables.h"

namespace plat::harness {
namespace {

using nlohmann::json;

constexpr const char* kGenerated = "generated";

/// Parcels of one layer, block by block.
struct Side {
  std::vector<std::vector<std::string>> ids;
  std::vector<std::vector<Polygon>> shapes;
  MeasuredLayer measured;
};

Side gather(std::string label, std::span<const blocks::Block> blocks,
            const blocks::BlockAssignment& homes, std::span<const blocks::ObservedParcel> parcels,
            Jobs jobs) {
  Side side;
  side.ids.resize(blocks.size());
  side.shapes.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const std::uint32_t i : homes.of_block[b]) {
      side.ids[b].push_back(parcels[i].id);
      side.shapes[b].push_back(snap_polygon(parcels[i].shape));
    }
  }
  side.measured.label = std::move(label);
  side.measured.per_block = parallel_map<std::vector<parcels::ParcelMeasures>>(
      blocks.size(), jobs,
      [&](std::size_t b) { return parcels::measure_parcels(blocks[b], side.shapes[b]); });
  return side;
}

ParcelLayer layer_of(const Side& side, std::span<const blocks::Block> blocks,
                     const geodata::LocalFrame& frame) {
  ParcelLayer layer(side.measured.label, frame);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t k = 0; k < side.shapes[b].size(); ++k) {
      layer.add(blocks[b].id, side.ids[b][k], 0, side.measured.label, side.shapes[b][k],
                side.measured.per_block[b][k]);
    }
  }
  return layer;
}

json manifest_of(const geodata::LayerSource& observed, const geodata::LayerSource& generated,
                 const std::string& dataset, const LayerComparisonOutcome& outcome,
                 const statistics::ComparisonOptions& options, std::uint64_t seed) {
  json manifest = build_info();
  manifest["experiment"] = "compare";
  manifest["seed"] = seed;
  manifest["repetitions"] = 1;
  manifest["config"] = {{"observed", geodata::to_string(observed)},
                        {"generated", geodata::to_string(generated)},
                        {"statistics", options_json(to_option_map(options))}};
  manifest["datasets"] = json::array({{{"name", dataset},
                                       {"title", geodata::to_string(observed)},
                                       {"licence", "as given by its source"},
                                       {"attribution", geodata::to_string(observed)},
                                       {"plots", "observed"},
                                       {"crs", ""},
                                       {"blocks", outcome.blocks},
                                       {"parcels", outcome.observed},
                                       {"input_failures", outcome.input_failures}}});
  manifest["strategies"] = json::array({{{"label", kGenerated},
                                         {"name", geodata::to_string(generated)},
                                         {"options", json::object()},
                                         {"fit", "none"}}});
  return manifest;
}

}  // namespace

LayerComparisonOutcome compare_layers(const geodata::LayerSource& observed_source,
                                      const geodata::LayerSource& generated_source,
                                      const std::filesystem::path& out,
                                      const statistics::ComparisonOptions& options,
                                      std::uint64_t seed, Jobs jobs) {
  const geodata::Layer observed_layer =
      geodata::read_layer(observed_source, {.kind = geodata::GeometryKind::kPolygon});
  const geodata::Layer generated_layer = geodata::read_layer(
      generated_source, {.frame = observed_layer.frame, .kind = geodata::GeometryKind::kPolygon});
  const std::vector<blocks::ObservedParcel> observed = parcels_of(observed_layer);
  const std::vector<blocks::ObservedParcel> generated = parcels_of(generated_layer);

  blocks::BlocksFromParcels found = blocks::blocks_from_parcels(observed, {}, jobs);
  blocks::label_edges(found.blocks, {}, {}, jobs);
  blocks::BlockAssignment observed_homes;
  observed_homes.of_block.resize(found.blocks.size());
  for (std::uint32_t i = 0; i < observed.size(); ++i) {
    if (found.block_of[i]) observed_homes.of_block[found.block_of[i]->value].push_back(i);
  }
  std::vector<Polygon> shapes;
  for (const blocks::ObservedParcel& parcel : generated) shapes.push_back(parcel.shape);
  const blocks::BlockAssignment generated_homes = blocks::assign_to_blocks(found.blocks, shapes);
  if (generated_homes.outside.size() == generated.size()) {
    throw InputError(fmt::format(
        "{}: none of its {} parcels lies in a block of {}: is it the same place and CRS?",
        geodata::to_string(generated_source), generated.size(),
        geodata::to_string(observed_source)));
  }
  const Side left = gather("observed", found.blocks, observed_homes, observed, jobs);
  const Side right = gather(kGenerated, found.blocks, generated_homes, generated, jobs);

  LayerComparisonOutcome outcome{found.blocks.size(), observed.size(), generated.size(),
                                 generated_homes.outside.size(), found.failures.size()};
  const std::string dataset = std::filesystem::path(observed_source.file).stem().string();
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw InputError(fmt::format("{}: cannot be made: {}", out.string(), error.message()));

  RunTables tables;
  for (std::size_t b = 0; b < found.blocks.size(); ++b) {
    for (const Side* side : {&left, &right}) {
      BlockRow row;
      row.layer = side->measured.label;
      row.block = found.blocks[b].id;
      row.block_area_m2 = area_m2(found.blocks[b].contour);
      row.observed_parcels = left.shapes[b].size();
      row.style = parcels::style_of(found.blocks[b], side->shapes[b]);
      row.ks_area = area_ks(left.measured.per_block[b], side->measured.per_block[b]);
      tables.add_block(dataset, row);
      for (std::size_t k = 0; k < side->shapes[b].size(); ++k) {
        tables.add_parcel(dataset, side->measured.label, 0, found.blocks[b].id, side->ids[b][k],
                          side->measured.per_block[b][k]);
      }
    }
  }
  const std::vector<MeasuredLayer> layers{right.measured};
  ComparisonTables comparison;
  comparison.add(dataset, layers,
                 statistics::compare(measure_samples(left.measured, layers), options, seed, jobs));

  FailureLayer failures(observed_layer.frame);
  for (const blocks::BlockFailure& f : found.failures)
    failures.add(f.feature_id, "input", 0, f.failure, f.shape);
  for (const std::uint32_t i : generated_homes.outside) {
    failures.add(generated[i].id, kGenerated, 0, {FailureCode::kNotCovered, "in no observed block"},
                 generated[i].shape);
  }
  const std::vector<geodata::Layer> written{
      layer_of(left, found.blocks, observed_layer.frame).layer(),
      layer_of(right, found.blocks, observed_layer.frame).layer(),
      block_layer(found.blocks, observed_layer.frame), failures.layer()};
  geodata::write_layers(out / fmt::format("layout_{}.gpkg", dataset), written);
  tables.write(out);
  comparison.write(out);
  write_file(
      out / "manifest.json",
      manifest_of(observed_source, generated_source, dataset, outcome, options, seed).dump(1) +
          "\n");
  return outcome;
}

}  // namespace plat::harness
