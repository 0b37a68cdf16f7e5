#include "street_growth/growth_maps.h"

#include <string>

namespace plat::growth {

geodata::Layer edge_map(const KnownCity& city, const Variant& variant, const GrowthConfig& config) {
  geodata::Layer layer{variant.label,
                       geodata::GeometryKind::kLine,
                       city.observed.frame,
                       {{"kind", geodata::FieldType::kText},
                        {"level", geodata::FieldType::kInteger},
                        {"length_m", geodata::FieldType::kReal}},
                       {}};
  const auto judged = judged_edges(city, variant, 0, config);
  if (!judged) return layer;
  const auto add = [&](const streets::JudgedPart& part, std::string kind) {
    if (part.chord.a == part.chord.b) return;  // a loop has no chord to draw
    geodata::Feature feature;
    feature.id = std::to_string(layer.features.size());
    feature.lines.push_back({part.chord.a, part.chord.b});
    feature.attributes = {std::move(kind), std::int64_t{part.level}, length(part.chord)};
    layer.features.push_back(std::move(feature));
  };
  for (const auto& part : judged->known) add(part, part.matched > 0.0 ? "recovered" : "missing");
  for (const auto& part : judged->grown) {
    if (!(part.matched > 0.0)) add(part, "false");
  }
  return layer;
}

}  // namespace plat::growth
