#include "harness/city_layers.h"

#include <fmt/format.h>

namespace plat::harness {

using geodata::FieldType;

ParcelLayer::ParcelLayer(std::string name, const geodata::LocalFrame& frame) {
  layer_.name = std::move(name);
  layer_.frame = frame;
  layer_.fields = {{"block_id", FieldType::kInteger},
                   {"parcel_id", FieldType::kText},
                   {"repetition", FieldType::kInteger},
                   {"strategy", FieldType::kText}};
  for (const parcels::MeasureColumn& column : parcels::measure_columns()) {
    const bool is_whole = column.kind != parcels::MeasureKind::kContinuous;
    layer_.fields.push_back(
        {std::string(column.name), is_whole ? FieldType::kInteger : FieldType::kReal});
  }
}

void ParcelLayer::add(BlockId block, const std::string& parcel_id, int repetition,
                      const std::string& strategy, const Polygon& shape,
                      const parcels::ParcelMeasures& measures) {
  geodata::Feature feature;
  feature.id = fmt::format("{}", layer_.features.size() + 1);
  feature.polygons.push_back(shape);
  feature.attributes = {static_cast<std::int64_t>(block.value), parcel_id,
                        static_cast<std::int64_t>(repetition), strategy};
  for (const parcels::MeasureColumn& column : parcels::measure_columns()) {
    const double value = column.value(measures);
    if (column.kind == parcels::MeasureKind::kContinuous) {
      feature.attributes.emplace_back(value);
    } else {
      feature.attributes.emplace_back(static_cast<std::int64_t>(value));
    }
  }
  layer_.features.push_back(std::move(feature));
}

void ParcelLayer::add(std::span<const DividedBlock> blocks, int repetition,
                      const std::string& strategy) {
  for (const DividedBlock& block : blocks) {
    if (!block.parcels) continue;
    for (std::size_t i = 0; i < block.parcels->size(); ++i) {
      const parcels::Parcel& parcel = (*block.parcels)[i];
      add(block.block, fmt::format("{}", parcel.id.value), repetition, strategy, parcel.shape,
          block.measures[i]);
    }
  }
}

geodata::Layer block_layer(std::span<const blocks::Block> blocks,
                           const geodata::LocalFrame& frame) {
  geodata::Layer layer;
  layer.name = "blocks";
  layer.frame = frame;
  layer.fields = {{"block_id", FieldType::kInteger},
                  {"source_id", FieldType::kText},
                  {"area_m2", FieldType::kReal},
                  {"street_edges", FieldType::kInteger},
                  {"street_length_m", FieldType::kReal}};
  for (const blocks::Block& block : blocks) {
    std::int64_t street_edges = 0;
    double street_length = 0.0;
    for (std::size_t r = 0; r < block.edges.size(); ++r) {
      const Ring& ring = blocks::ring_at(block, r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        if (!block.edges[r][i].is_street()) continue;
        ++street_edges;
        street_length += distance(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
      }
    }
    geodata::Feature feature;
    feature.id = fmt::format("{}", layer.features.size() + 1);
    feature.polygons.push_back(block.contour);
    feature.attributes = {static_cast<std::int64_t>(block.id.value), block.source_id,
                          area_m2(block.contour), street_edges, street_length};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

geodata::Layer street_layer(const streets::StreetNetwork& network,
                            const geodata::LocalFrame& frame) {
  geodata::Layer layer{"streets",
                       geodata::GeometryKind::kLine,
                       frame,
                       {{"street", FieldType::kInteger},
                        {"source", FieldType::kText},
                        {"name", FieldType::kText},
                        {"class", FieldType::kText},
                        {"structure", FieldType::kText},
                        {"level", FieldType::kInteger},
                        {"from_node", FieldType::kInteger},
                        {"to_node", FieldType::kInteger},
                        {"width_m", FieldType::kReal},
                        {"width_source", FieldType::kText}},
                       {}};
  for (const streets::Street& street : network.streets) {
    geodata::Feature feature;
    feature.id = fmt::format("{}", street.id.value);
    feature.lines.push_back(street.line);
    feature.attributes = {std::int64_t{street.id.value},
                          street.source_id,
                          street.attributes.name,
                          street.attributes.street_class,
                          std::string(streets::structure_name(street.attributes.structure)),
                          std::int64_t{street.attributes.level},
                          std::int64_t{street.from},
                          std::int64_t{street.to},
                          street.width_m,
                          std::string(streets::width_source_name(street.width_source))};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

FailureLayer::FailureLayer(const geodata::LocalFrame& frame) {
  layer_.name = "failures";
  layer_.frame = frame;
  layer_.fields = {{"block_id", FieldType::kText},
                   {"strategy", FieldType::kText},
                   {"repetition", FieldType::kInteger},
                   {"code", FieldType::kText},
                   {"message", FieldType::kText}};
}

void FailureLayer::add(std::string block_id, std::string strategy, int repetition,
                       const Failure& failure, const Polygon& shape) {
  geodata::Feature feature;
  feature.id = fmt::format("{}", layer_.features.size() + 1);
  // Only what a reader can draw: a refused shape may hold anything.
  if (shape.outer.size() >= 3) feature.polygons.push_back(shape);
  feature.attributes = {std::move(block_id), std::move(strategy),
                        static_cast<std::int64_t>(repetition),
                        std::string(failure_name(failure.code)), failure.message};
  layer_.features.push_back(std::move(feature));
}

}  // namespace plat::harness
