#include "harness/tile_document.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/layer_rows_internal.h"
#include "tiles/layout_defects.h"

namespace plat::harness {
namespace {

using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;
using nlohmann::json;
using tiles::Tile;
using tiles::TileId;
using tiles::TileLayout;

constexpr std::size_t kLeastCorners = 3;

std::int64_t number(std::uint32_t value) { return std::int64_t{value}; }
std::int64_t number(bool value) { return value ? 1 : 0; }

void add(Layer& layer, Feature feature) {
  feature.id = fmt::format("{}", layer.features.size() + 1);
  layer.features.push_back(std::move(feature));
}

/// [[[vertex, x, y], ...], ...]: the rings, where the tile has its vertices at rest.
std::string corners_text(const Tile& tile) {
  json rings = json::array();
  for (const auto& ring : tile.rings) {
    json corners = json::array();
    for (const tiles::Corner& corner : ring)
      corners.push_back(json::array({corner.vertex, corner.rest.x, corner.rest.y}));
    rings.push_back(std::move(corners));
  }
  return rings.dump();
}

Layer tiles_layer(const TileLayout& layout, const geodata::LocalFrame& frame) {
  Layer layer{"tiles",
              GeometryKind::kPolygon,
              frame,
              {{"tile", FieldType::kInteger},
               {"source", FieldType::kText},
               {"zone", FieldType::kText},
               {"block", FieldType::kInteger},
               {"pinned", FieldType::kInteger},
               {"area_m2", FieldType::kReal},
               {"xx", FieldType::kReal},
               {"xy", FieldType::kReal},
               {"yx", FieldType::kReal},
               {"yy", FieldType::kReal},
               {"shift_x", FieldType::kReal},
               {"shift_y", FieldType::kReal},
               {"corners", FieldType::kText}},
              {}};
  for (const Tile& tile : layout.tiles) {
    const Polygon shape = tiles::shape_of(layout, tile);
    const Affine& at = tile.placement;
    Feature feature;
    feature.attributes = {number(tile.id.value),
                          tile.source_id,
                          tile.zone,
                          number(tile.block),
                          number(tile.is_pinned),
                          area_m2(shape),
                          at.xx,
                          at.xy,
                          at.yx,
                          at.yy,
                          at.shift.x,
                          at.shift.y,
                          corners_text(tile)};
    if (!shape.outer.empty()) feature.polygons.push_back(shape);
    add(layer, std::move(feature));
  }
  return layer;
}

Layer vertices_layer(const TileLayout& layout, const geodata::LocalFrame& frame) {
  Layer layer{"tile_vertices",
              GeometryKind::kPoint,
              frame,
              {{"vertex", FieldType::kInteger}, {"joint", FieldType::kInteger}},
              {}};
  for (const tiles::LayoutVertex& vertex : layout.vertices) {
    Feature feature;
    feature.points.push_back(vertex.at);
    feature.attributes = {static_cast<std::int64_t>(layer.features.size()),
                          number(vertex.is_joint)};
    add(layer, std::move(feature));
  }
  return layer;
}

Layer links_layer(const TileLayout& layout, const geodata::LocalFrame& frame) {
  Layer layer{"tile_links",
              GeometryKind::kPoint,
              frame,
              {{"tile_a", FieldType::kInteger},
               {"tile_b", FieldType::kInteger},
               {"rest_a_x", FieldType::kReal},
               {"rest_a_y", FieldType::kReal},
               {"rest_b_x", FieldType::kReal},
               {"rest_b_y", FieldType::kReal},
               {"width_m", FieldType::kReal}},
              {}};
  for (const tiles::StreetLink& link : layout.links) {
    const Tile& a = layout.tiles.at(link.a);
    const Tile& b = layout.tiles.at(link.b);
    Feature feature;
    feature.points.push_back(midpoint(a.placement(link.rest_a), b.placement(link.rest_b)));
    feature.attributes = {number(a.id.value), number(b.id.value), link.rest_a.x, link.rest_a.y,
                          link.rest_b.x,      link.rest_b.y,      link.width_m};
    add(layer, std::move(feature));
  }
  return layer;
}

void read_vertices(const LayerRows& rows, TileLayout& layout) {
  for (const Feature& feature : rows.layer().features) {
    if (feature.points.size() != 1) rows.refuse(feature, "must be one point");
    if (rows.needed_id(feature, "vertex") != layout.vertices.size())
      rows.refuse(feature, fmt::format("vertex must be {}: they are in order, none left out",
                                       layout.vertices.size()));
    layout.vertices.push_back({feature.points.front(), rows.needed_id(feature, "joint") != 0});
  }
}

std::vector<std::vector<tiles::Corner>> corners_of(const LayerRows& rows, const Feature& feature,
                                                   std::size_t vertex_count) {
  std::vector<std::vector<tiles::Corner>> out;
  try {
    for (const json& ring : json::parse(rows.text(feature, "corners"))) {
      auto& corners = out.emplace_back();
      for (const json& corner : ring) {
        corners.push_back({corner.at(0).get<std::uint32_t>(),
                           {corner.at(1).get<double>(), corner.at(2).get<double>()}});
      }
    }
  } catch (const json::exception&) {
    rows.refuse(feature, "corners must be rings of [vertex, x, y]");
  }
  if (out.empty()) rows.refuse(feature, "corners: there is no ring");
  for (const auto& ring : out) {
    if (ring.size() < kLeastCorners)
      rows.refuse(feature, fmt::format("corners: a ring of {}, at least {} are needed", ring.size(),
                                       kLeastCorners));
    for (const tiles::Corner& corner : ring) {
      if (corner.vertex >= vertex_count)
        rows.refuse(feature, fmt::format("corners: there is no vertex {}", corner.vertex));
      if (!std::isfinite(corner.rest.x) || !std::isfinite(corner.rest.y))
        rows.refuse(feature, "corners must be finite");
    }
  }
  return out;
}

void read_tiles_layer(const LayerRows& rows, TileLayout& layout) {
  std::set<TileId> seen;
  for (const Feature& feature : rows.layer().features) {
    const auto real = [&](std::string_view field) { return rows.needed_real(feature, field); };
    Tile tile;
    tile.id = TileId{rows.needed_id(feature, "tile")};
    if (tile.id.value >= layout.next_id)
      rows.refuse(feature,
                  fmt::format("tile must be below {}, the document's next_tile", layout.next_id));
    if (!seen.insert(tile.id).second) rows.refuse(feature, "its tile id comes twice");
    tile.source_id = rows.text(feature, "source");
    tile.zone = rows.text(feature, "zone");
    tile.block = rows.needed_id(feature, "block");
    tile.is_pinned = rows.needed_id(feature, "pinned") != 0;
    tile.placement = {
        real("xx"), real("xy"), real("yx"), real("yy"), {real("shift_x"), real("shift_y")}};
    if (!tile.placement.is_finite()) rows.refuse(feature, "its placement must be finite");
    if (!tile.placement.inverse() || tile.placement.determinant() < 0.0)
      rows.refuse(feature, fmt::format("its placement has the determinant {}, it must be above 0",
                                       tile.placement.determinant()));
    tile.rings = corners_of(rows, feature, layout.vertices.size());
    layout.tiles.push_back(std::move(tile));
  }
}

void read_links(const LayerRows& rows, TileLayout& layout) {
  std::map<std::uint32_t, std::uint32_t> index_of;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i)
    index_of.emplace(layout.tiles[i].id.value, i);
  for (const Feature& feature : rows.layer().features) {
    const auto end = [&](std::string_view field) {
      const std::uint32_t id = rows.needed_id(feature, field);
      const auto it = index_of.find(id);
      if (it == index_of.end()) rows.refuse(feature, fmt::format("there is no tile {}", id));
      return it->second;
    };
    const auto point = [&](std::string_view x, std::string_view y) {
      return Point{rows.needed_real(feature, x), rows.needed_real(feature, y)};
    };
    layout.links.push_back({end("tile_a"), point("rest_a_x", "rest_a_y"), end("tile_b"),
                            point("rest_b_x", "rest_b_y"), rows.needed_real(feature, "width_m")});
  }
}

void refuse_defects(const std::string& file, const TileLayout& layout) {
  if (layout.tiles.empty() && !layout.vertices.empty())
    throw InputError(fmt::format("{}:tiles: no tile, and {} features in tile_vertices", file,
                                 layout.vertices.size()));
  if (const auto defect = tiles::find_layout_defect(layout))
    throw InputError(fmt::format("{}:tiles: {}", file, defect->message));
}

}  // namespace

std::vector<Layer> tile_document_layers(const TileLayout& layout,
                                        const geodata::LocalFrame& frame) {
  return {tiles_layer(layout, frame), vertices_layer(layout, frame), links_layer(layout, frame)};
}

TileLayout read_tile_document(const std::string& file, const geodata::LocalFrame& frame,
                              std::uint32_t next_id) {
  TileLayout layout;
  layout.next_id = next_id;
  if (has_features(file, "tile_vertices"))
    read_vertices(read_rows(file, "tile_vertices", GeometryKind::kPoint, frame), layout);
  if (has_features(file, "tiles"))
    read_tiles_layer(read_rows(file, "tiles", GeometryKind::kPolygon, frame), layout);
  if (has_features(file, "tile_links"))
    read_links(read_rows(file, "tile_links", GeometryKind::kPoint, frame), layout);
  refuse_defects(file, layout);
  return layout;
}

}  // namespace plat::harness
