#include "harness/city_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "harness/tile_document.h"

namespace plat::harness {
namespace {

using geodata::Attribute;
using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;

std::int64_t number(std::uint32_t value) { return std::int64_t{value}; }

void add(Layer& layer, Feature feature) {
  feature.id = fmt::format("{}", layer.features.size() + 1);
  layer.features.push_back(std::move(feature));
}

/// One point at the frame's origin, so that the frame is read back from it.
Layer document_layer(const editing::City& city, const geodata::LocalFrame& frame) {
  Layer layer{"document",
              GeometryKind::kPoint,
              frame,
              {{"seed", FieldType::kText},
               {"strategy", FieldType::kText},
               {"options", FieldType::kText},
               {"matching", FieldType::kText},
               {"next_node", FieldType::kInteger},
               {"next_street", FieldType::kInteger},
               {"next_block", FieldType::kInteger},
               {"next_parcel", FieldType::kInteger},
               {"next_tile", FieldType::kInteger}},
              {}};
  const editing::CityOptions& options = city.options();
  const editing::IdCounters& ids = city.counters();
  Feature feature;
  feature.points.push_back({});
  feature.attributes = {fmt::format("{}", options.seed),
                        options.style.strategy,
                        to_string(options.style.options),
                        std::string(parcels::matching_name(options.matching)),
                        number(ids.node),
                        number(ids.street),
                        number(ids.block),
                        number(ids.parcel),
                        {}};
  if (city.tiles()) feature.attributes.back() = number(city.tiles()->next_id);
  add(layer, std::move(feature));
  return layer;
}

Layer streets_layer(const editing::City& city, const geodata::LocalFrame& frame) {
  Layer layer{"streets",
              GeometryKind::kLine,
              frame,
              {{"street", FieldType::kInteger},
               {"from_node", FieldType::kInteger},
               {"to_node", FieldType::kInteger},
               {"name", FieldType::kText},
               {"class", FieldType::kText},
               {"width_m", FieldType::kReal},
               {"width_source", FieldType::kText},
               {"source", FieldType::kText},
               {"control1_x", FieldType::kReal},
               {"control1_y", FieldType::kReal},
               {"control2_x", FieldType::kReal},
               {"control2_y", FieldType::kReal}},
              {}};
  city.streets().for_each([&](StreetId id, const editing::CityStreet& street) {
    Feature feature;
    feature.lines.push_back(street.line);
    feature.attributes = {number(id.value),
                          number(street.from.value),
                          number(street.to.value),
                          street.name,
                          street.street_class,
                          street.width_m,
                          std::string(streets::width_source_name(street.width_source)),
                          street.source_id};
    feature.attributes.resize(layer.fields.size());
    if (street.curve) {
      const Point first = frame.origin + street.curve->first;
      const Point second = frame.origin + street.curve->second;
      feature.attributes[8] = first.x;
      feature.attributes[9] = first.y;
      feature.attributes[10] = second.x;
      feature.attributes[11] = second.y;
    }
    add(layer, std::move(feature));
  });
  return layer;
}

Layer blocks_layer(const editing::City& city, const geodata::LocalFrame& frame) {
  Layer layer{"blocks",
              GeometryKind::kPolygon,
              frame,
              {{"block", FieldType::kInteger},
               {"strategy", FieldType::kText},
               {"options", FieldType::kText},
               {"seed", FieldType::kText},
               {"parcels", FieldType::kInteger},
               {"code", FieldType::kInteger},
               {"message", FieldType::kText}},
              {}};
  city.blocks().for_each([&](BlockId id, const editing::CityBlock& block) {
    Feature feature;
    feature.polygons.push_back(block.block.contour);
    feature.attributes = {number(id.value), block.style.strategy, to_string(block.style.options),
                          fmt::format("{}", block.seed),
                          static_cast<std::int64_t>(block.parcels.size())};
    feature.attributes.resize(layer.fields.size());
    if (block.failure) {
      feature.attributes[5] = static_cast<std::int64_t>(block.failure->code);
      feature.attributes[6] = block.failure->message;
    }
    add(layer, std::move(feature));
  });
  return layer;
}

Layer parcels_layer(const editing::City& city, const geodata::LocalFrame& frame) {
  Layer layer{"parcels",
              GeometryKind::kPolygon,
              frame,
              {{"block", FieldType::kInteger},
               {"parcel", FieldType::kInteger},
               {"predecessor", FieldType::kInteger},
               {"attributes", FieldType::kText},
               {"area_m2", FieldType::kReal}},
              {}};
  city.blocks().for_each([&](BlockId id, const editing::CityBlock& block) {
    for (std::size_t i = 0; i < block.parcels.size(); ++i) {
      const editing::ParcelRecord& record = block.records[i];
      Feature feature;
      feature.polygons.push_back(block.parcels[i].shape);
      feature.attributes = {number(id.value), number(block.parcels[i].id.value), std::monostate{},
                            std::monostate{}, area_m2(block.parcels[i].shape)};
      if (record.predecessor) feature.attributes[2] = number(record.predecessor->value);
      if (!record.attributes.empty())
        feature.attributes[3] = nlohmann::json(record.attributes).dump();
      add(layer, std::move(feature));
    }
  });
  return layer;
}

Layer failures_layer(const editing::City& city, const geodata::LocalFrame& frame) {
  Layer layer{
      "failures",
      GeometryKind::kPolygon,
      frame,
      {{"feature", FieldType::kText}, {"code", FieldType::kText}, {"message", FieldType::kText}},
      {}};
  const auto add_row = [&](std::string what, const Failure& failure, const Polygon& shape) {
    Feature feature;
    if (shape.outer.size() >= 3) feature.polygons.push_back(shape);
    feature.attributes = {std::move(what), std::string(failure_name(failure.code)),
                          failure.message};
    add(layer, std::move(feature));
  };
  city.blocks().for_each([&](BlockId id, const editing::CityBlock& block) {
    if (block.failure)
      add_row(fmt::format("block {}", id.value), *block.failure, block.block.contour);
  });
  // Faces by their lowest half-edge, not by an id that a file does not keep.
  std::map<HalfEdge, const editing::Walk*> faces;
  city.walks().for_each([&](editing::WalkId, const editing::Walk& walk) {
    faces.emplace(walk.half_edges.front(), &walk);
  });
  for (const auto& [first, face] : faces) {
    for (const blocks::RefusedRegion& region : face->refused)
      add_row(fmt::format("street {}", edge_of(first)), region.failure, region.shape);
  }
  return layer;
}

}  // namespace

std::vector<Layer> city_layers(const editing::City& city, const geodata::LocalFrame& frame) {
  std::vector<Layer> out{document_layer(city, frame), streets_layer(city, frame),
                         blocks_layer(city, frame), parcels_layer(city, frame)};
  if (city.tiles()) {
    for (Layer& layer : tile_document_layers(*city.tiles(), frame)) out.push_back(std::move(layer));
  }
  out.push_back(failures_layer(city, frame));
  return out;
}

}  // namespace plat::harness
