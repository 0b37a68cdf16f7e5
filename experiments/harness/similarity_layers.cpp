#include "harness/similarity_layers.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "harness/city_layers.h"

namespace plat::harness {
namespace {

/// Fields before nearest_1.
constexpr std::size_t kOwnFields = 6;

using geodata::Attribute;
using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;
using similarity::Candidate;

Layer tiles_layer(const ReadTileShapes& tiles, std::size_t nearest) {
  Layer layer{"tiles", GeometryKind::kPolygon, tiles.frame, {}, {}};
  layer.fields = {
      {"source_id", FieldType::kText},       {"zone", FieldType::kText},
      {"block", FieldType::kInteger},        {"cluster", FieldType::kInteger},
      {"cluster_size", FieldType::kInteger}, {"is_representative", FieldType::kInteger}};
  for (std::size_t n = 1; n <= nearest; ++n) {
    layer.fields.push_back({fmt::format("nearest_{}", n), FieldType::kText});
    layer.fields.push_back({fmt::format("distance_{}", n), FieldType::kReal});
  }
  return layer;
}

Feature tile_feature(const ReadTileShapes& tiles, const similarity::Clusters& clusters,
                     std::uint32_t i, const std::vector<Candidate>& row, std::size_t nearest) {
  const std::uint32_t cluster = clusters.cluster_of[i];
  const auto whole = [](auto number) { return Attribute(static_cast<std::int64_t>(number)); };
  Feature feature;
  feature.polygons.push_back(tiles.shapes[i].polygon);
  std::vector<Attribute>& values = feature.attributes;
  values.resize(kOwnFields + 2 * nearest);
  values[0] = tiles.ids[i];
  if (!tiles.shapes[i].zone.empty()) values[1] = tiles.shapes[i].zone;
  if (tiles.blocks[i]) values[2] = whole(*tiles.blocks[i]);
  values[3] = whole(cluster);
  values[4] = whole(clusters.members[cluster].size());
  values[5] = whole(clusters.representative(cluster) == i ? 1 : 0);
  for (std::size_t n = 0; n < row.size(); ++n) {
    values[kOwnFields + 2 * n] = tiles.ids[row[n].shape];
    values[kOwnFields + 2 * n + 1] = row[n].distance;
  }
  return feature;
}

Feature line_feature(const ReadTileShapes& tiles, std::uint32_t i, const Candidate& candidate,
                     std::size_t rank) {
  Feature feature;
  feature.lines.push_back({interior_point(tiles.shapes[i].polygon),
                           interior_point(tiles.shapes[candidate.shape].polygon)});
  feature.attributes = {tiles.ids[i], tiles.ids[candidate.shape], static_cast<std::int64_t>(rank),
                        candidate.distance};
  return feature;
}

Layer failures_layer(const ReadTileShapes& tiles, const similarity::SimilarityMatrix& matrix) {
  FailureLayer failures(tiles.frame);
  for (const blocks::BlockFailure& failure : tiles.failures)
    failures.add(failure.feature_id, "similarity", 0, failure.failure, failure.shape);
  for (const similarity::ShapeFailure& failure : matrix.failures)
    failures.add(tiles.ids[failure.shape], "similarity", 0, failure.failure,
                 tiles.shapes[failure.shape].polygon);
  return failures.layer();
}

}  // namespace

std::vector<Layer> similarity_layers(const ReadTileShapes& tiles,
                                     const similarity::Clusters& clusters,
                                     const similarity::SimilarityMatrix& matrix,
                                     std::size_t nearest) {
  Layer polygons = tiles_layer(tiles, nearest);
  Layer lines{"nearest", GeometryKind::kLine, tiles.frame, {}, {}};
  lines.fields = {{"source_id", FieldType::kText},
                  {"nearest_id", FieldType::kText},
                  {"rank", FieldType::kInteger},
                  {"distance", FieldType::kReal}};
  for (std::uint32_t i = 0; i < tiles.shapes.size(); ++i) {
    const std::vector<Candidate> row = matrix.nearest(i, nearest);
    polygons.features.push_back(tile_feature(tiles, clusters, i, row, nearest));
    for (std::size_t n = 0; n < row.size(); ++n)
      lines.features.push_back(line_feature(tiles, i, row[n], n + 1));
  }
  return {std::move(polygons), std::move(lines), failures_layer(tiles, matrix)};
}

}  // namespace plat::harness
