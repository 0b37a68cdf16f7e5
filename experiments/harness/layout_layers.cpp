#include "harness/layout_layers.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "harness/build_info.h"
#include "harness/city_layers.h"
#include "parcels/parcel_measures.h"
#include "streets/intersection_point_layer.h"

namespace plat::harness {
namespace {

using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;
using synthesis::Layout;
using synthesis::LayoutBlock;

std::int64_t number(std::size_t value) { return static_cast<std::int64_t>(value); }

/// The points as they can be read again (plat exemplar), and whether a grown street reached each.
Layer points_layer(const Layout& layout, const geodata::LocalFrame& frame) {
  Layer layer = streets::intersection_point_layer(layout.points, frame);
  layer.fields.push_back({"is_reached", FieldType::kInteger});
  for (Feature& feature : layer.features) feature.attributes.emplace_back(std::int64_t{1});
  for (const std::uint32_t point : layout.left_alone)
    layer.features[point].attributes.back() = std::int64_t{0};
  return layer;
}

Layer streets_layer(const Layout& layout, const geodata::LocalFrame& frame) {
  Layer layer = street_layer(layout.network, frame);
  layer.fields.push_back({"hierarchy", FieldType::kInteger});
  layer.fields.push_back({"chain", FieldType::kInteger});
  layer.fields.push_back({"is_existing", FieldType::kInteger});
  for (std::size_t s = 0; s < layer.features.size(); ++s) {
    auto& attributes = layer.features[s].attributes;
    const auto& segment = layout.segments[s];
    attributes.resize(layer.fields.size());
    if (segment) {
      attributes[attributes.size() - 3] = std::int64_t{segment->hierarchy};
      attributes[attributes.size() - 2] = std::int64_t{segment->street};
    }
    attributes.back() = std::int64_t{s < layout.existing_count ? 1 : 0};
  }
  return layer;
}

Layer blocks_layer(const Layout& layout, const geodata::LocalFrame& frame) {
  std::vector<blocks::Block> blocks;
  for (const LayoutBlock& block : layout.blocks) blocks.push_back(block.block);
  Layer layer = block_layer(blocks, frame);
  for (const auto& [name, type] :
       {std::pair("is_existing", FieldType::kInteger), std::pair("parcels", FieldType::kInteger),
        std::pair("wanted_parcels", FieldType::kInteger),
        std::pair("wanted_area_m2", FieldType::kReal),
        std::pair("wanted_deviation_m2", FieldType::kReal),
        std::pair("style_source", FieldType::kText), std::pair("strategy", FieldType::kText),
        std::pair("options", FieldType::kText), std::pair("seed", FieldType::kText)})
    layer.fields.push_back({name, type});
  for (std::size_t b = 0; b < layer.features.size(); ++b) {
    const LayoutBlock& block = layout.blocks[b];
    auto& attributes = layer.features[b].attributes;
    attributes.emplace_back(std::int64_t{block.is_existing ? 1 : 0});
    attributes.emplace_back(number(block.parcels ? block.parcels->size() : 0));
    if (block.style_source == synthesis::StyleSource::kNone) {
      attributes.resize(attributes.size() + 3);
    } else {
      attributes.emplace_back(number(block.style.count));
      attributes.emplace_back(block.style.area_mean_m2);
      attributes.emplace_back(block.style.area_deviation_m2);
    }
    attributes.emplace_back(std::string(synthesis::style_source_name(block.style_source)));
    attributes.emplace_back(block.strategy);
    attributes.emplace_back(to_string(block.options));
    attributes.emplace_back(fmt::format("{}", block.seed));
  }
  return layer;
}

Layer parcels_layer(const Layout& layout, const geodata::LocalFrame& frame, Jobs jobs) {
  using Measures = std::vector<parcels::ParcelMeasures>;
  const auto measures = parallel_map<Measures>(layout.blocks.size(), jobs, [&](std::size_t b) {
    const LayoutBlock& block = layout.blocks[b];
    std::vector<Polygon> shapes;
    if (block.parcels) {
      for (const parcels::Parcel& parcel : *block.parcels) shapes.push_back(parcel.shape);
    }
    return parcels::measure_parcels(block.block, shapes);
  });
  ParcelLayer layer("parcels", frame);
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const LayoutBlock& block = layout.blocks[b];
    if (!block.parcels) continue;
    for (std::size_t i = 0; i < block.parcels->size(); ++i) {
      const parcels::Parcel& parcel = (*block.parcels)[i];
      layer.add(block.block.id, fmt::format("{}", parcel.id.value), 0, block.strategy, parcel.shape,
                measures[b][i]);
    }
  }
  return layer.layer();
}

Layer failures_layer(const Layout& layout, const geodata::LocalFrame& frame) {
  Layer layer{"failures",
              GeometryKind::kPolygon,
              frame,
              {{"stage", FieldType::kText},
               {"feature", FieldType::kText},
               {"code", FieldType::kText},
               {"message", FieldType::kText},
               {"x", FieldType::kReal},
               {"y", FieldType::kReal}},
              {}};
  for (const synthesis::LayoutFailure& row : layout.failures) {
    Feature feature;
    feature.id = fmt::format("{}", layer.features.size() + 1);
    if (row.shape.outer.size() >= 3) feature.polygons.push_back(row.shape);
    const Point place = frame.origin + row.place;
    feature.attributes = {std::string(synthesis::stage_name(row.stage)),
                          row.feature,
                          std::string(failure_name(row.failure.code)),
                          row.failure.message,
                          place.x,
                          place.y};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

/// One point at the frame's origin.
Layer origin_layer(const LayoutOrigin& origin, const geodata::LocalFrame& frame) {
  Layer layer{"synthesis",
              GeometryKind::kPoint,
              frame,
              {{"seed", FieldType::kText},
               {"grower", FieldType::kText},
               {"grower_options", FieldType::kText},
               {"subdivider", FieldType::kText},
               {"subdivider_options", FieldType::kText},
               {"script", FieldType::kText},
               {"built_from", FieldType::kText}},
              {}};
  Feature feature;
  feature.id = "1";
  feature.points.push_back({});
  feature.attributes = {fmt::format("{}", origin.seed),
                        origin.grower,
                        to_string(origin.grower_options),
                        origin.subdivider,
                        to_string(origin.subdivider_options),
                        origin.script,
                        build_info().dump()};
  layer.features.push_back(std::move(feature));
  return layer;
}

}  // namespace

std::vector<Layer> layout_layers(const Layout& layout, const geodata::LocalFrame& frame,
                                 const LayoutOrigin& origin, Jobs jobs) {
  return {points_layer(layout, frame),   streets_layer(layout, frame),
          blocks_layer(layout, frame),   parcels_layer(layout, frame, jobs),
          failures_layer(layout, frame), origin_layer(origin, frame)};
}

}  // namespace plat::harness
