#include "harness/tile_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "tiles/settling.h"
#include "tiles/tile_graph.h"

namespace plat::harness {
namespace {

using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;

Feature& add_feature(Layer& layer) {
  Feature& feature = layer.features.emplace_back();
  feature.id = fmt::format("{}", layer.features.size());
  return feature;
}

/// Per tile, the mean of a solution's gaps over the joints it takes part in.
std::vector<double> mean_gaps_m(const tiles::TileGraph& graph, std::span<const double> gaps_m) {
  std::vector<double> sum(graph.tiles.size(), 0.0);
  std::vector<double> count(graph.tiles.size(), 0.0);
  for (std::size_t j = 0; j < graph.joints.size(); ++j) {
    for (const std::uint32_t t : {graph.joints[j].a, graph.joints[j].b}) {
      sum[t] += gaps_m[j];
      count[t] += 1.0;
    }
  }
  for (std::size_t t = 0; t < sum.size(); ++t) sum[t] = count[t] > 0.0 ? sum[t] / count[t] : 0.0;
  return sum;
}

Layer tiles_layer(const tiles::TileLayout& layout, const geodata::LocalFrame& frame,
                  const tiles::LayoutSolution* solution) {
  Layer layer{"tiles",
              GeometryKind::kPolygon,
              frame,
              {{"tile", FieldType::kInteger},
               {"source_id", FieldType::kText},
               {"zone", FieldType::kText},
               {"block", FieldType::kInteger},
               {"area_m2", FieldType::kReal},
               {"rest_area_m2", FieldType::kReal},
               {"pinned", FieldType::kInteger},
               {"xx", FieldType::kReal},
               {"xy", FieldType::kReal},
               {"yx", FieldType::kReal},
               {"yy", FieldType::kReal},
               {"shift_x", FieldType::kReal},
               {"shift_y", FieldType::kReal},
               {"moved_m", FieldType::kReal},
               {"bent_m", FieldType::kReal}},
              {}};
  std::vector<double> gaps;
  if (solution != nullptr) {
    layer.fields.push_back({"deformation", FieldType::kReal});
    layer.fields.push_back({"gap_m", FieldType::kReal});
    gaps = mean_gaps_m(tiles::graph_of(layout), solution->gaps_m);
  }
  const std::vector<double> bent = tiles::closing_residuals_m(layout);
  for (std::size_t t = 0; t < layout.tiles.size(); ++t) {
    const tiles::Tile& tile = layout.tiles[t];
    const Affine& map = tile.placement;
    const Point rest = centroid(tiles::rest_shape_of(tile));
    Polygon shape = tiles::shape_of(layout, tile);
    const double area = area_m2(shape);
    Feature& feature = add_feature(layer);
    feature.polygons.push_back(std::move(shape));
    feature.attributes = {std::int64_t{tile.id.value},
                          tile.source_id,
                          tile.zone,
                          std::int64_t{tile.block},
                          area,
                          area_m2(tiles::rest_shape_of(tile)),
                          std::int64_t{tile.is_pinned ? 1 : 0},
                          map.xx,
                          map.xy,
                          map.yx,
                          map.yy,
                          map.shift.x,
                          map.shift.y,
                          distance(map(rest), rest),
                          bent[t]};
    if (solution != nullptr) {
      feature.attributes.emplace_back(solution->deformations.at(t));
      feature.attributes.emplace_back(gaps[t]);
    }
  }
  return layer;
}

Layer joints_layer(const tiles::TileLayout& layout, const geodata::LocalFrame& frame) {
  Layer layer{"joints",
              GeometryKind::kPoint,
              frame,
              {{"vertex", FieldType::kInteger},
               {"tiles", FieldType::kInteger},
               {"gap_m", FieldType::kReal}},
              {}};
  std::vector<std::vector<Point>> places(layout.vertices.size());
  for (const tiles::Tile& tile : layout.tiles) {
    for (const auto& ring : tile.rings) {
      for (const tiles::Corner& corner : ring)
        places[corner.vertex].push_back(tile.placement(corner.rest));
    }
  }
  for (std::size_t v = 0; v < layout.vertices.size(); ++v) {
    if (!layout.vertices[v].is_joint) continue;
    double gap = 0.0;
    for (const Point p : places[v]) {
      for (const Point q : places[v]) gap = std::max(gap, distance(p, q));
    }
    Feature& feature = add_feature(layer);
    feature.points.push_back(layout.vertices[v].at);
    feature.attributes = {static_cast<std::int64_t>(v), static_cast<std::int64_t>(places[v].size()),
                          gap};
  }
  return layer;
}

/// The point of the tile, as it is now, nearest to `p`.
Point front_of(const tiles::TileLayout& layout, const tiles::Tile& tile, Point p) {
  std::optional<Point> best;
  for_each_edge(tiles::shape_of(layout, tile), [&](const Segment& s) {
    const Point q = nearest_point(s, p);
    if (!best || distance(q, p) < distance(*best, p)) best = q;
  });
  return best.value_or(p);
}

Layer links_layer(const tiles::TileLayout& layout, const geodata::LocalFrame& frame) {
  Layer layer{"links",
              GeometryKind::kLine,
              frame,
              {{"tile_a", FieldType::kInteger},
               {"tile_b", FieldType::kInteger},
               {"width_m", FieldType::kReal},
               {"gap_m", FieldType::kReal}},
              {}};
  for (const tiles::StreetLink& link : layout.links) {
    const tiles::Tile& a = layout.tiles[link.a];
    const tiles::Tile& b = layout.tiles[link.b];
    const Point at_a = a.placement(link.rest_a);
    const Point at_b = b.placement(link.rest_b);
    Feature& feature = add_feature(layer);
    feature.lines.push_back({front_of(layout, a, at_a), at_a});
    if (at_b != at_a) feature.lines.back().push_back(at_b);
    feature.lines.back().push_back(front_of(layout, b, at_b));
    feature.attributes = {std::int64_t{a.id.value}, std::int64_t{b.id.value}, link.width_m,
                          distance(at_a, at_b)};
  }
  return layer;
}

}  // namespace

std::vector<Layer> tile_layers(const tiles::TileLayout& layout, const geodata::LocalFrame& frame,
                               const tiles::LayoutSolution* solution) {
  return {tiles_layer(layout, frame, solution), joints_layer(layout, frame),
          links_layer(layout, frame)};
}

Layer tile_failure_layer(std::span<const tiles::TileFailure> failures,
                         const geodata::LocalFrame& frame) {
  Layer layer{
      "failures",
      GeometryKind::kPolygon,
      frame,
      {{"source_id", FieldType::kText}, {"code", FieldType::kText}, {"message", FieldType::kText}},
      {}};
  for (const tiles::TileFailure& row : failures) {
    Feature& feature = add_feature(layer);
    bool is_drawable = row.shape.outer.size() >= 3;
    for_each_edge(row.shape, [&](const Segment& s) {
      is_drawable = is_drawable && std::isfinite(s.a.x) && std::isfinite(s.a.y);
    });
    if (is_drawable) feature.polygons.push_back(row.shape);
    feature.attributes = {row.source_id, std::string(failure_name(row.failure.code)),
                          row.failure.message};
  }
  return layer;
}

}  // namespace plat::harness
