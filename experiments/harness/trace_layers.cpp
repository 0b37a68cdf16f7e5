#include "harness/trace_layers.h"

#include <string>

#include "core/failure.h"

namespace plat::harness {
namespace {

using parcels::TraceStep;

geodata::Feature feature_of(const blocks::Block& block, std::uint32_t number, std::size_t order) {
  geodata::Feature feature;
  feature.id = std::to_string(order);
  feature.attributes = {static_cast<std::int64_t>(block.id.value),
                        static_cast<std::int64_t>(number), static_cast<std::int64_t>(order)};
  return feature;
}

}  // namespace

std::vector<geodata::Layer> trace_layers(std::span<const blocks::Block> blocks,
                                         std::span<const parcels::SubdivisionTrace> traces,
                                         const geodata::LocalFrame& frame) {
  expects(traces.size() == blocks.size(), "one trace per block");
  std::vector<geodata::Layer> out;
  for (std::size_t s = 0; s < parcels::kTraceSteps; ++s) {
    const auto step = static_cast<TraceStep>(s);
    const auto kind =
        parcels::is_area(step) ? geodata::GeometryKind::kPolygon : geodata::GeometryKind::kLine;
    out.push_back({std::string(parcels::trace_step_name(step)),
                   kind,
                   frame,
                   {{"block_id", geodata::FieldType::kInteger},
                    {"number", geodata::FieldType::kInteger},
                    {"order", geodata::FieldType::kInteger}},
                   {}});
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const auto& line : traces[b].lines()) {
      geodata::Layer& layer = out[static_cast<std::size_t>(line.step)];
      layer.features.push_back(feature_of(blocks[b], line.number, layer.features.size()));
      layer.features.back().lines.push_back({line.line.a, line.line.b});
    }
    for (const auto& area : traces[b].areas()) {
      geodata::Layer& layer = out[static_cast<std::size_t>(area.step)];
      layer.features.push_back(feature_of(blocks[b], area.number, layer.features.size()));
      layer.features.back().polygons.push_back({area.area, {}});
    }
  }
  return out;
}

}  // namespace plat::harness
