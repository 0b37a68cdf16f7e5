#include "harness/observed_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "blocks/block_extraction.h"
#include "blocks/blocks_from_parcels.h"
#include "harness/land_use.h"
#include "harness/observed_layers.h"
#include "harness/observed_streets.h"
#include "streets/network_cleaning.h"
#include "streets/segment_index.h"
#include "streets/street_classes.h"
#include "streets/street_import.h"

namespace plat::harness {
namespace {

using tiles::TilePiece;

/// Observed parcels, by the blocks they form.
std::vector<TilePiece> parcel_pieces(const City& city) {
  std::vector<TilePiece> pieces;
  for (const ObservedBlock& home : city.blocks) {
    for (std::size_t i = 0; i < home.parcels.size(); ++i)
      pieces.push_back({home.parcel_ids[i], {}, home.block.id.value, home.parcels[i]});
  }
  return pieces;
}

/// Whole blocks of a network.
std::vector<TilePiece> block_pieces(const blocks::BlocksOfNetwork& found) {
  std::vector<TilePiece> pieces;
  for (std::uint32_t b = 0; b < found.blocks.size(); ++b)
    pieces.push_back({fmt::format("block {}", b), {}, b, found.blocks[b].contour});
  return pieces;
}

Point middle_of(const std::vector<TilePiece>& pieces) {
  Box box;
  for (const TilePiece& piece : pieces) box.add(box_of(piece.shape));
  return box.is_empty() ? Point{} : box.center();
}

void take_failures(const std::vector<blocks::BlockFailure>& refused, ObservedTiles& out) {
  std::vector<tiles::TileFailure> failures;
  for (const blocks::BlockFailure& row : refused)
    failures.push_back({row.feature_id, row.failure, row.shape});
  out.tiles.failures.insert(out.tiles.failures.begin(), failures.begin(), failures.end());
}

/// How near to a centre line the point of a link that was put on it lies: a grid step.
constexpr double kOnLine_m = 0.01;

std::size_t streets_between(const tiles::TileLayout& layout,
                            const streets::StreetNetwork& network) {
  if (network.streets.empty()) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> facing;
    for (const tiles::StreetLink& link : layout.links) {
      const std::uint32_t a = layout.tiles[link.a].block;
      const std::uint32_t b = layout.tiles[link.b].block;
      if (a != b) facing.insert(std::minmax(a, b));
    }
    return facing.size();
  }
  std::vector<Segment> segments;
  std::vector<std::size_t> street_of;
  for (std::size_t s = 0; s < network.streets.size(); ++s) {
    const Polyline& line = network.streets[s].line;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      segments.push_back({line[i], line[i + 1]});
      street_of.push_back(s);
    }
  }
  const streets::SegmentIndex index(std::move(segments));
  std::set<std::string> names;
  for (const tiles::StreetLink& link : layout.links) {
    const auto hit = index.nearest(link.rest_a, kOnLine_m, [](std::uint32_t) { return true; });
    if (!hit) continue;
    const streets::Street& street = network.streets[street_of[hit->segment]];
    names.insert(street.attributes.name.empty() ? "feature " + street.source_id
                                                : street.attributes.name);
  }
  return names.size();
}

/// Of a place that was read, the wanted part becomes a layout.
void construct(const TileSelection& selection, const tiles::ConstructionOptions& options, Jobs jobs,
               const std::vector<blocks::BlockFailure>& refused, ObservedTiles& out) {
  out.tiles = tiles::construct_layout(out.pieces, street_lines(out.network), options, jobs);
  // What lies elsewhere is no failure of this part.
  if (!selection.count) take_failures(refused, out);
}

void select(const TileSelection& selection, ObservedTiles& out) {
  if (!selection.count) return;
  const Point to = selection.near ? *selection.near - out.frame.origin : middle_of(out.pieces);
  out.pieces = nearest_pieces(std::move(out.pieces), to, *selection.count);
}

/// The zone of each parcel that parcels_of() makes of the layer.
std::vector<std::string> zones_in(const geodata::Layer& layer, const std::string& field) {
  const auto it = std::ranges::find(layer.fields, field, &geodata::FieldSchema::name);
  if (it == layer.fields.end())
    throw InputError(fmt::format("layer \"{}\" has no field \"{}\"", layer.name, field));
  const auto index = static_cast<std::size_t>(it - layer.fields.begin());
  std::vector<std::string> zones;
  for (const geodata::Feature& feature : layer.features) {
    const std::size_t parts = std::max<std::size_t>(1, feature.polygons.size());
    zones.insert(zones.end(), parts, text_of(feature.attributes.at(index)));
  }
  return zones;
}

}  // namespace

std::vector<tiles::StreetLine> street_lines(const streets::StreetNetwork& network) {
  std::vector<tiles::StreetLine> lines;
  for (const streets::Street& street : network.streets) {
    if (streets::bounds_blocks(street.attributes.street_class, streets::BoundingClasses::kStreets))
      lines.push_back({street.line, street.width_m});
  }
  return lines;
}

std::vector<TilePiece> nearest_pieces(std::vector<TilePiece> pieces, Point to, std::size_t count) {
  if (count >= pieces.size()) return pieces;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    order.emplace_back(squared_length(centroid(pieces[i].shape) - to), i);
  std::ranges::sort(order);
  order.resize(count);
  std::ranges::sort(order, {}, &std::pair<double, std::size_t>::second);
  std::vector<TilePiece> out;
  for (const auto& [squared, i] : order) out.push_back(std::move(pieces[i]));
  return out;
}

ObservedTiles load_tiles(const geodata::Dataset& dataset, const TileSelection& selection,
                         const tiles::ConstructionOptions& options, Jobs jobs,
                         const std::filesystem::path& folder) {
  ObservedTiles out;
  out.dataset = dataset.name;
  std::vector<blocks::BlockFailure> refused;
  const bool has_parcels =
      dataset.observed && dataset.observed->plots == geodata::PlotOrigin::kObserved;
  if (has_parcels) {
    City city = load_city(dataset, jobs, folder);
    out.frame = city.frame;
    out.pieces = parcel_pieces(city);
    out.network = std::move(city.network);
    refused = std::move(city.failures);
  } else {
    ObservedStreets observed = load_streets(dataset, jobs, folder);
    out.frame = observed.frame;
    out.network = std::move(observed.network);
    blocks::BlocksOfNetwork found = blocks::extract_blocks(out.network, {}, jobs);
    out.pieces = block_pieces(found);
    refused = std::move(found.failures);
  }
  select(selection, out);
  std::vector<Polygon> shapes;
  for (const TilePiece& piece : out.pieces) shapes.push_back(piece.shape);
  std::vector<std::string> zones = zones_of(dataset, shapes, out.frame, folder);
  for (std::size_t i = 0; i < zones.size(); ++i) out.pieces[i].zone = std::move(zones[i]);

  construct(selection, options, jobs, refused, out);
  return out;
}

ObservedTiles read_tiles(const TileSources& sources, const TileSelection& selection,
                         const tiles::ConstructionOptions& options, Jobs jobs) {
  ObservedTiles out;
  out.dataset = sources.parcels;
  geodata::ReadOptions reading;
  reading.kind = geodata::GeometryKind::kPolygon;
  const geodata::Layer layer =
      geodata::read_layer(geodata::parse_layer_source(sources.parcels), reading);
  out.frame = layer.frame;
  const std::vector<blocks::ObservedParcel> parcels = parcels_of(layer, sources.id_field);
  std::vector<std::string> zones(parcels.size());
  if (!sources.zone_field.empty()) zones = zones_in(layer, sources.zone_field);
  if (!sources.streets.empty()) {
    reading.kind = geodata::GeometryKind::kLine;
    reading.frame = layer.frame;
    const geodata::Layer lines =
        geodata::read_layer(geodata::parse_layer_source(sources.streets), reading);
    out.network = streets::build_network(streets::import_streets(lines).streets).network;
  }
  blocks::BlocksFromParcels found = blocks::blocks_from_parcels(parcels, {}, jobs);
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    if (!found.block_of[i]) continue;
    out.pieces.push_back({parcels[i].id, std::move(zones[i]), found.block_of[i]->value,
                          std::move(found.parcels[i])});
  }
  select(selection, out);
  construct(selection, options, jobs, found.failures, out);
  return out;
}

LayoutCounts counts_of(const tiles::TileLayout& layout, const streets::StreetNetwork& network) {
  LayoutCounts counts;
  counts.tiles = layout.tiles.size();
  counts.vertices = layout.vertices.size();
  counts.links = layout.links.size();
  for (const tiles::LayoutVertex& vertex : layout.vertices)
    counts.joints += vertex.is_joint ? 1 : 0;

  std::set<std::uint32_t> blocks;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> owner;
  std::set<std::pair<std::uint32_t, std::uint32_t>> neighbours;
  for (std::uint32_t t = 0; t < layout.tiles.size(); ++t) {
    blocks.insert(layout.tiles[t].block);
    for (const auto& ring : layout.tiles[t].rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t a = ring[i].vertex;
        const std::uint32_t b = ring[(i + 1) % ring.size()].vertex;
        owner.emplace(std::pair{a, b}, t);
        if (const auto other = owner.find({b, a}); other != owner.end())
          neighbours.insert(std::minmax(t, other->second));
      }
    }
  }
  counts.blocks = blocks.size();
  counts.boundaries = neighbours.size();
  counts.streets = streets_between(layout, network);
  return counts;
}

}  // namespace plat::harness
