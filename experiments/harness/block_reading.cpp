#include "harness/block_reading.h"

#include "blocks/block_assignment.h"
#include "blocks/edge_labels.h"
#include "core/validity.h"
#include "harness/observed_layers.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "streets/street_width.h"

namespace plat::harness {
namespace {

/// Larger rings are refused as kTooManyVertices: a contour of more vertices is a coastline, not a
/// block.
constexpr std::size_t kMaxBlockVertices = 20000;

}  // namespace

ReadBlocks read_blocks(const geodata::LayerSource& source, Jobs jobs,
                       const std::optional<geodata::LocalFrame>& frame) {
  const geodata::Layer layer =
      geodata::read_layer(source, {.frame = frame, .kind = geodata::GeometryKind::kPolygon});
  const std::vector<blocks::ObservedParcel> shapes = parcels_of(layer);
  const auto admitted = parallel_map<Expected<Polygon>>(shapes.size(), jobs, [&](std::size_t i) {
    return admit_polygon(shapes[i].shape, kMaxBlockVertices);
  });
  ReadBlocks out;
  out.frame = layer.frame;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!admitted[i]) {
      out.failures.push_back({shapes[i].id, admitted[i].error(), shapes[i].shape});
      continue;
    }
    blocks::Block block;
    block.id = BlockId{static_cast<std::uint32_t>(out.blocks.size())};
    block.source_id = shapes[i].id;
    block.contour = *admitted[i];
    block.edges.emplace_back(block.contour.outer.size());
    for (const Ring& hole : block.contour.holes) block.edges.emplace_back(hole.size());
    out.blocks.push_back(std::move(block));
  }
  return out;
}

void label_from_streets(ReadBlocks& read, const std::string& source, Jobs jobs) {
  streets::StreetNetwork network;
  if (!source.empty()) {
    const geodata::Layer layer =
        geodata::read_layer(geodata::parse_layer_source(source),
                            {.frame = read.frame, .kind = geodata::GeometryKind::kLine});
    network = streets::build_network(streets::import_streets(layer, {}).streets).network;
    std::vector<Polygon> land;
    for (const blocks::Block& block : read.blocks) land.push_back(block.contour);
    streets::assign_widths(network, land, {}, jobs);
  }
  blocks::label_edges(read.blocks, network, {}, jobs);
}

std::vector<parcels::ParcelStyle> observed_styles(const ReadBlocks& read,
                                                  const geodata::LayerSource& observed) {
  const geodata::Layer layer =
      geodata::read_layer(observed, {.frame = read.frame, .kind = geodata::GeometryKind::kPolygon});
  std::vector<Polygon> shapes;
  for (blocks::ObservedParcel& parcel : parcels_of(layer))
    shapes.push_back(std::move(parcel.shape));
  const blocks::BlockAssignment homes = blocks::assign_to_blocks(read.blocks, shapes);
  std::vector<parcels::ParcelStyle> styles;
  for (std::size_t b = 0; b < read.blocks.size(); ++b) {
    std::vector<Polygon> inside;
    for (const std::uint32_t i : homes.of_block[b]) inside.push_back(shapes[i]);
    styles.push_back(parcels::style_of(read.blocks[b], inside));
  }
  return styles;
}

}  // namespace plat::harness
