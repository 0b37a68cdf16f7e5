#include "buildings/building_synthesis.h"

#include <map>
#include <nlohmann/json.hpp>

#include "core/failure.h"

namespace plat::buildings {
namespace {

using nlohmann::ordered_json;

PreparedBuilding prepare_skeleton(BuildingSkeleton skeleton, const PartDatabase& database,
                                  const BuildingDesign& design) {
  SkeletonPlan plan = plan_of(skeleton);
  PreparedBuilding out{with_corners(database, plan), std::move(skeleton), std::move(plan), {}, {}};
  out.problem =
      skeleton_problem(out.skeleton, *out.plan, out.database, design.steps, design.preferences);
  out.compiled = sequences::compile(out.problem.problem);
  return out;
}

ordered_json surface_json(const Mesh& mesh) {
  const SurfaceReport report = inspect_surface(mesh);
  return {{"is_watertight", report.is_watertight()},
          {"faces", report.face_count},
          {"shells", report.shell_count},
          {"unmatched_edges", report.unmatched_edge_count},
          {"edges_shared_by_shells", report.shared_edge_count},
          {"volume_m3", report.volume_m3}};
}

ordered_json names_of(const BuildingProblem& problem,
                      const std::vector<sequences::ElementIndex>& elements) {
  ordered_json out = ordered_json::array();
  for (const auto element : elements)
    out.push_back(problem.problem.database.elements[element].name);
  return out;
}

/// What the parts have together, by attribute.
ordered_json attributes_json(const PreparedBuilding& prepared,
                             const std::vector<sequences::ElementIndex>& elements) {
  std::map<std::string, double> sums;
  for (const auto element : elements) {
    const Part& part = prepared.database.parts()[*prepared.problem.parts[element]];
    for (const auto& [name, amount] : part.attributes) sums[name] += amount;
  }
  return sums;
}

ordered_json rows_json(const PreparedBuilding& prepared, const Building& building) {
  ordered_json out = ordered_json::array();
  for (std::size_t r = 0; r < building.by_place.segments.size(); ++r) {
    ordered_json row;
    if (prepared.plan) {
      const SkeletonRow& planned = prepared.plan->rows[r];
      const RowRounding rounded = rounding(planned);
      row["edges"] = planned.edges;
      row["from_m"] = {planned.start.x, planned.start.y};
      row["to_m"] = {planned.end.x, planned.end.y};
      row["length_m"] = rounded.length_m;
      row["quantised_m"] = rounded.quantised_m;
      row["stretched_by"] = rounded.factor;
    }
    row["parts"] = names_of(prepared.problem, building.by_place.segments[r]);
    row["attributes"] = attributes_json(prepared, building.by_place.segments[r]);
    out.push_back(std::move(row));
  }
  return out;
}

ordered_json key_points_json(const PreparedBuilding& prepared, const Building& building) {
  ordered_json out = ordered_json::array();
  for (std::size_t k = 0; k < building.by_place.key_points.size(); ++k) {
    const auto element = building.by_place.key_points[k];
    out.push_back({{"node", prepared.plan->key_points[k].node},
                   {"part", prepared.problem.problem.database.elements[element].name}});
  }
  return out;
}

ordered_json joints_json(const PlacedBuilding& placed) {
  ordered_json out = ordered_json::array();
  for (const Joint& joint : placed.joints) {
    if (!joint.after) continue;
    const auto& [origin, across, up, outward] = joint.plane;
    out.push_back(
        {{"at", {origin.x, origin.y, origin.z}}, {"along", {outward.x, outward.y, outward.z}}});
  }
  return out;
}

}  // namespace

PreparedBuilding prepare(const BuildingDesign& design, const PartDatabase& database) {
  if (const auto* tower = std::get_if<TowerDesign>(&design.shape)) {
    PreparedBuilding out{database, {}, std::nullopt, {}, {}};
    out.problem = tower_problem(*tower, database, design.steps, design.preferences);
    out.compiled = sequences::compile(out.problem.problem);
    return out;
  }
  if (const auto* contour = std::get_if<ContourDesign>(&design.shape))
    return prepare_skeleton(skeleton_of(*contour), database, design);
  return prepare_skeleton(std::get<BuildingSkeleton>(design.shape), database, design);
}

Building realise(const PreparedBuilding& prepared, const sequences::SequencePath& path) {
  Building out;
  out.arrangement = sequences::arrangement(prepared.compiled, prepared.problem.problem, path);
  if (prepared.plan) {
    out.by_place = sequences::by_part(prepared.problem.problem.structure, out.arrangement);
    out.placed = place(prepared.problem, *prepared.plan, prepared.database, out.by_place);
  } else {
    auto& floors = out.by_place.segments.emplace_back();
    for (const auto& placement : out.arrangement.placements) floors.push_back(placement.element);
    out.placed = stack(prepared.problem, prepared.database, floors);
  }
  out.assembled = assemble(out.placed, prepared.database);
  return out;
}

std::string report_of(const PreparedBuilding& prepared, const Building& building,
                      const std::string& name) {
  const auto& database = prepared.problem.problem.database;
  ordered_json out;
  out["name"] = name;
  out["parts"] = prepared.database.info().name;
  out["parts_origin"] = prepared.database.info().origin;
  out["cost_m2"] = static_cast<double>(building.arrangement.cost) * database.cost_step;
  out["wall_area_m2"] = building.assembled.wall_area_m2;
  for (std::size_t r = 0; r < database.resources.size(); ++r) {
    out["resources"][database.resources[r].name] =
        static_cast<double>(building.arrangement.consumed[r]) * database.resources[r].step;
  }
  out["surface"] = surface_json(building.assembled.mesh);
  out["key_points"] = key_points_json(prepared, building);
  out["rows"] = rows_json(prepared, building);
  out["joints"] = joints_json(building.placed);
  return out.dump(1) + "\n";
}

}  // namespace plat::buildings
