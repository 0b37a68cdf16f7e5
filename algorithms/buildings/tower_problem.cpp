#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "buildings/problem_resources_internal.h"
#include "core/failure.h"

namespace plat::buildings {
namespace {

using sequences::ElementIndex;
using SequencePort = sequences::Port;

constexpr const char* kFloorArea = "floor_area_m2";
/// Floors that have one stand on the ground, or end a tower.
constexpr const char* kPodiums = "podiums";
constexpr const char* kCrowns = "crowns";

bool has_floor_with(const PartDatabase& database, const char* name) {
  return std::ranges::any_of(database.parts(), [&](const Part& part) {
    return part.shape.part_class == PartClass::kFloor && attribute(part, name) > 0.0;
  });
}

}  // namespace

BuildingProblem tower_problem(const TowerDesign& tower, const PartDatabase& database,
                              const AttributeSteps& steps, const Preferences& preferences) {
  const detail::ExtraCost extra(preferences);
  detail::Resources resources(database, steps);
  std::vector<AttributeBound> bounds = tower.bounds;
  const double area = tower.floor_area_ratio * tower.ground_area_m2;
  bounds.push_back({"height_m", tower.height_m, tower.height_m});
  const double area_step = step_of(steps, kFloorArea);
  const double rounded = area_step * std::round(area / area_step);
  bounds.push_back({kFloorArea, rounded, rounded});
  resources.add_all(bounds);

  BuildingProblem out;
  sequences::SequenceDatabase elements;
  const bool has_podiums = has_floor_with(database, kPodiums);
  const bool has_crowns = has_floor_with(database, kCrowns);
  for (std::size_t p = 0; p < database.parts().size(); ++p) {
    const Part& part = database.parts()[p];
    if (part.shape.part_class != PartClass::kFloor) continue;
    elements.elements.push_back({part.name,
                                 {std::string(name_of(PartClass::kFloor))},
                                 resources.uses_of(part),
                                 {},
                                 true,
                                 !has_podiums || attribute(part, kPodiums) > 0.0,
                                 !has_crowns || attribute(part, kCrowns) > 0.0});
    out.parts.emplace_back(p);
  }
  if (out.parts.empty())
    throw InputError(fmt::format("\"{}\" has no floors", database.info().name));
  for (ElementIndex from = 0; from < out.parts.size(); ++from) {
    const Part& below = database.parts()[*out.parts[from]];
    if (attribute(below, kCrowns) > 0.0) continue;
    for (ElementIndex to = 0; to < out.parts.size(); ++to) {
      const Part& above = database.parts()[*out.parts[to]];
      if (attribute(above, kPodiums) > 0.0) continue;
      const PortRef top{*out.parts[from], *find_port(below, PortRole::kTop)};
      const PortRef bottom{*out.parts[to], *find_port(above, PortRole::kBottom)};
      if (!database.may_meet(top, bottom)) continue;
      elements.transitions.push_back(
          {from,
           to,
           SequencePort::kRight,
           SequencePort::kLeft,
           database.cost(top, bottom) + extra.between(below.name, above.name),
           {}});
    }
  }
  elements.resources = resources.all();
  elements.cost_step = kCostStep_m2;
  out.problem = sequences::plain_sequence(std::move(elements), resources.bounds_of(bounds));
  return out;
}

}  // namespace plat::buildings
