#include "harness/city.h"

#include <fmt/format.h>

#include "blocks/block_assignment.h"
#include "blocks/block_extraction.h"
#include "blocks/edge_labels.h"
#include "footprints/morphological_tessellation.h"
#include "harness/observed_layers.h"
#include "harness/observed_streets.h"
#include "streets/street_width.h"

namespace plat::harness {
namespace {

using geodata::Dataset;
using geodata::GeometryKind;
using geodata::Layer;
using geodata::LayerMapping;

void take_streets(const LayerMapping& mapping, const std::filesystem::path& folder,
                  const std::optional<geodata::LocalFrame>& frame, City& city) {
  ObservedStreets observed = read_streets(mapping, folder, frame);
  city.frame = observed.frame;
  city.network = std::move(observed.network);
  city.repairs = std::move(observed.repairs);
}

City load_observed(const Dataset& dataset, Jobs jobs, const std::filesystem::path& folder) {
  City city;
  const geodata::ObservedMapping& mapping = *dataset.observed;
  if (!mapping.parcels)
    throw InputError(fmt::format("data set \"{}\": no parcel layer is mapped", dataset.name));
  const Layer layer = read_mapped(*mapping.parcels, folder, GeometryKind::kPolygon, std::nullopt);
  city.frame = layer.frame;
  const std::vector<blocks::ObservedParcel> observed =
      parcels_of(layer, mapped_field(*mapping.parcels, "id"));
  if (mapping.streets) take_streets(*mapping.streets, folder, layer.frame, city);

  blocks::BlocksFromParcels found = blocks::blocks_from_parcels(observed, {}, jobs);
  city.failures = std::move(found.failures);
  std::vector<Polygon> land;
  for (const blocks::Block& block : found.blocks) land.push_back(block.contour);
  streets::assign_widths(city.network, land, {}, jobs);
  blocks::label_edges(found.blocks, city.network, {}, jobs);

  for (blocks::Block& block : found.blocks) city.blocks.push_back({std::move(block), {}, {}});
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (!found.block_of[i]) continue;
    ObservedBlock& home = city.blocks[found.block_of[i]->value];
    home.parcels.push_back(std::move(found.parcels[i]));
    home.parcel_ids.push_back(observed[i].id);
  }
  // A joint between two pieces of a closed union can be a block by itself: no parcel lies in it.
  std::erase_if(city.blocks, [&](const ObservedBlock& observed_block) {
    if (!observed_block.parcels.empty()) return false;
    city.failures.push_back({observed_block.block.source_id,
                             {FailureCode::kNoObservation, "no parcel lies in this part"},
                             observed_block.block.contour});
    return true;
  });
  for (std::size_t b = 0; b < city.blocks.size(); ++b)
    city.blocks[b].block.id = {static_cast<std::uint32_t>(b)};
  return city;
}

struct Plots {
  Expected<footprints::Tessellation> cells;
};

City load_tessellated(const Dataset& dataset, Jobs jobs, const std::filesystem::path& folder) {
  City city;
  const geodata::ObservedMapping& mapping = *dataset.observed;
  if (!mapping.streets || !mapping.footprints) {
    throw InputError(fmt::format(
        "data set \"{}\": streets and footprints are needed to tessellate plots", dataset.name));
  }
  take_streets(*mapping.streets, folder, std::nullopt, city);
  streets::assign_widths(city.network, {}, {}, jobs);
  const Layer footprints =
      read_mapped(*mapping.footprints, folder, GeometryKind::kPolygon, city.frame);
  const std::vector<blocks::ObservedParcel> buildings = parcels_of(footprints);
  std::vector<Polygon> shapes;
  for (const blocks::ObservedParcel& building : buildings) shapes.push_back(building.shape);

  blocks::BlocksOfNetwork found = blocks::extract_blocks(city.network, {}, jobs);
  city.failures = std::move(found.failures);
  const blocks::BlockAssignment homes = blocks::assign_to_blocks(found.blocks, shapes);
  const footprints::MorphologicalTessellation tessellation;
  auto plots = parallel_map<Plots>(found.blocks.size(), jobs, [&](std::size_t b) {
    std::vector<Polygon> inside;
    for (const std::uint32_t i : homes.of_block[b]) inside.push_back(shapes[i]);
    return Plots{tessellation.tessellate(found.blocks[b], inside)};
  });
  for (std::size_t b = 0; b < found.blocks.size(); ++b) {
    blocks::Block& block = found.blocks[b];
    auto& cells = plots[b].cells;
    if (!cells) {
      city.failures.push_back({fmt::format("block {}", b), cells.error(), block.contour});
      continue;
    }
    ObservedBlock observed;
    observed.block = std::move(block);
    observed.block.id = {static_cast<std::uint32_t>(city.blocks.size())};
    for (std::size_t k = 0; k < cells->plots.size(); ++k) {
      const std::uint32_t footprint = homes.of_block[b][cells->footprint_of_plot[k]];
      observed.parcels.push_back(std::move(cells->plots[k].shape));
      observed.parcel_ids.push_back(buildings[footprint].id);
    }
    city.blocks.push_back(std::move(observed));
  }
  return city;
}

}  // namespace

void expect_present(const Dataset& dataset, const std::filesystem::path& folder) {
  if (!dataset.observed || dataset.observed->plots == geodata::PlotOrigin::kNone) {
    throw InputError(fmt::format("data set \"{}\" has no plots to compare with: see plat data list",
                                 dataset.name));
  }
  if (!geodata::locate(dataset, folder)) {
    throw InputError(fmt::format("data set \"{}\" is not complete in {}: plat data fetch {}",
                                 dataset.name, folder.string(), dataset.name));
  }
}

City load_city(const Dataset& dataset, Jobs jobs, const std::filesystem::path& folder) {
  expect_present(dataset, folder);
  City city = dataset.observed->plots == geodata::PlotOrigin::kObserved
                  ? load_observed(dataset, jobs, folder)
                  : load_tessellated(dataset, jobs, folder);
  city.dataset = dataset.name;
  city.plots = dataset.observed->plots;
  return city;
}

}  // namespace plat::harness
