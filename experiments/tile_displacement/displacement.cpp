#include "tile_displacement/displacement.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/box.h"
#include "tiles/mesh_warp.h"
#include "tiles/settling.h"
#include "tiles/tile_reach.h"

namespace plat::displacement {
namespace {

using tiles::Corner;
using tiles::Tile;
using tiles::TileGraph;
using tiles::TileLayout;

/// Controls of a warp that do not move: enough for a frame around what does, few enough to solve.
constexpr std::size_t kMostFixedControls = 400;

std::vector<Point> rest_ring(const Tile& tile) {
  std::vector<Point> out;
  for (const Corner& corner : tile.rings.front()) out.push_back(corner.rest);
  return out;
}

/// Corners of what is moved, and middles of what stays, as many as are evenly kept.
std::vector<tiles::ControlPoint> controls_of(const TileLayout& layout, const TileGraph& graph,
                                             const Displacement& displacement) {
  std::map<Point, Point> moved;
  std::vector<Point> fixed;
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    const Tile& tile = layout.tiles[i];
    if (displacement.roles[i] == Role::kHeld)
      fixed.push_back(tile.placement(graph.tiles[i].centroid));
    if (displacement.roles[i] != Role::kMoved) continue;
    for (const Corner& corner : tile.rings.front())
      moved.emplace(tile.placement(corner.rest), displacement.targets[i](corner.rest));
  }
  const std::size_t each = 1 + fixed.size() / kMostFixedControls;
  for (std::size_t i = 0; i < fixed.size(); i += each) moved.emplace(fixed[i], fixed[i]);
  std::vector<tiles::ControlPoint> out;
  for (const auto& [from, to] : moved) out.push_back({from, to});
  return out;
}

/// A picture is warped as a whole, tiles that are to stay with it.
/// @returns the outer rings, warped; every tile's map is fitted to its own
Expected<Outcome> warped(const TileLayout& layout, const TileGraph& graph,
                         const Displacement& displacement) {
  const auto warp = tiles::MeshWarp::make(controls_of(layout, graph, displacement));
  if (!warp) return tl::unexpected(warp.error());
  Outcome out;
  std::vector<Affine> maps;
  for (const Tile& tile : layout.tiles) {
    auto& ring = out.outer.emplace_back();
    for (const Corner& corner : tile.rings.front())
      ring.push_back((*warp)(layout.vertices[corner.vertex].at));
    maps.push_back(tiles::fitted_affine(rest_ring(tile), ring).map);
  }
  // Whatever is at one place stays at one place: the warp asks for no role.
  out.joint_gaps_m.assign(graph.joints.size(), 0.0);
  out.solution = tiles::measure_placements(graph, std::move(maps), {});
  return out;
}

Outcome placed(const TileLayout& layout, tiles::LayoutSolution solution) {
  TileLayout moved = layout;
  for (std::size_t i = 0; i < moved.tiles.size(); ++i)
    moved.tiles[i].placement = solution.placements[i];
  Outcome out;
  out.outer = outer_rings(tiles::settled(std::move(moved)));
  out.joint_gaps_m = solution.gaps_m;
  out.solution = std::move(solution);
  return out;
}

Expected<Outcome> solved(const TileLayout& layout, const TileGraph& graph,
                         const Displacement& displacement, const tiles::SolverOptions& options) {
  std::vector<std::uint32_t> held;
  std::vector<Affine> targets;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    if (displacement.roles[i] == Role::kFree) continue;
    held.push_back(i);
    targets.push_back(displacement.targets[i]);
  }
  const auto solver = tiles::LayoutSolver::make(graph, std::move(held), options);
  if (!solver) return tl::unexpected(solver.error());
  auto solution = solver->solve(targets, displacement.targets);
  if (!solution) return tl::unexpected(solution.error());
  return placed(layout, *std::move(solution));
}

/// Of joints that touch a free tile.
void add_gaps(const TileGraph& graph, const std::vector<Role>& roles, const Outcome& outcome,
              Errors& out) {
  double property = 0.0;
  double street = 0.0;
  for (std::size_t j = 0; j < graph.joints.size(); ++j) {
    const tiles::Joint& joint = graph.joints[j];
    if (roles[joint.a] != Role::kFree && roles[joint.b] != Role::kFree) continue;
    const bool is_street = joint.kind == tiles::JointKind::kStreet;
    (is_street ? out.street_gap_m : out.property_gap_m) += outcome.joint_gaps_m[j];
    ++(is_street ? street : property);
  }
  out.gap_m = (out.property_gap_m + out.street_gap_m) / std::max(property + street, 1.0);
  out.property_gap_m /= std::max(property, 1.0);
  out.street_gap_m /= std::max(street, 1.0);
}

double deformation_of(const Affine& map) { return std::hypot(map.xx - map.yy, map.xy + map.yx); }

void add_free_tiles(const TileLayout& layout, const std::vector<Role>& roles,
                    const Outcome& outcome, Errors& out) {
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    if (roles[i] != Role::kFree) continue;
    ++out.free_tiles;
    const double deformation = outcome.solution.deformations[i];
    out.deformation += deformation;
    out.largest_deformation = std::max(out.largest_deformation, deformation);
    out.size_change += std::abs(std::log(size_of(outcome.solution.placements[i])));
    const tiles::AffineFit fit = tiles::fitted_affine(rest_ring(layout.tiles[i]), outcome.outer[i]);
    out.closed_deformation += deformation_of(fit.map);
    out.non_affine_m += fit.residual_m;
  }
  const double count = std::max(static_cast<double>(out.free_tiles), 1.0);
  for (double* mean :
       {&out.deformation, &out.size_change, &out.closed_deformation, &out.non_affine_m})
    *mean /= count;
}

/// What happens to tiles that are to stay: a warp knows none, closing gaps moves their corners.
void add_held_tiles(const TileLayout& layout, const std::vector<Role>& roles,
                    const Outcome& outcome, Errors& out) {
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    if (roles[i] != Role::kHeld) continue;
    ++out.held_tiles;
    const Tile& tile = layout.tiles[i];
    const std::vector<Point>& ring = outcome.outer[i];
    out.held_deformation += deformation_of(tiles::fitted_affine(rest_ring(tile), ring).map);
    double sum_m = 0.0;
    for (std::size_t c = 0; c < ring.size(); ++c) {
      const double off_m = distance(ring[c], tile.placement(tile.rings.front()[c].rest));
      sum_m += off_m;
      out.largest_held_off_m = std::max(out.largest_held_off_m, off_m);
    }
    out.held_off_m += sum_m / static_cast<double>(ring.size());
  }
  const double count = std::max(static_cast<double>(out.held_tiles), 1.0);
  out.held_deformation /= count;
  out.held_off_m /= count;
}

}  // namespace

std::string_view role_name(Role role) {
  constexpr std::string_view kNames[] = {"moved", "held", "free"};
  return kNames[static_cast<std::size_t>(role)];
}

Displacement undisplaced(const TileLayout& layout) {
  Displacement out;
  out.roles.assign(layout.tiles.size(), Role::kFree);
  for (const Tile& tile : layout.tiles) out.targets.push_back(tile.placement);
  return out;
}

void hold_beyond(const TileLayout& layout, double reach_m, Displacement& displacement) {
  std::vector<Box> around;
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    if (displacement.roles[i] != Role::kMoved) continue;
    around.push_back(tiles::box_of(layout, layout.tiles[i]));
    around.push_back(tiles::box_at(layout.tiles[i], displacement.targets[i]));
  }
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    if (displacement.roles[i] != Role::kFree) continue;
    const Box box = tiles::box_of(layout, layout.tiles[i]);
    if (layout.tiles[i].is_pinned || !tiles::is_within_reach(box, around, reach_m))
      displacement.roles[i] = Role::kHeld;
  }
}

Expected<Outcome> displaced(const TileLayout& layout, const TileGraph& graph,
                            const Displacement& displacement, const Way& way) {
  if (way.method == Method::kWarp) return warped(layout, graph, displacement);
  if (way.method == Method::kSolver) return solved(layout, graph, displacement, way.solver);
  return placed(layout, tiles::measure_placements(graph, displacement.targets, way.solver));
}

Errors errors_of(const TileLayout& layout, const TileGraph& graph, const std::vector<Role>& roles,
                 const Outcome& outcome) {
  Errors out;
  add_gaps(graph, roles, outcome, out);
  add_free_tiles(layout, roles, outcome, out);
  add_held_tiles(layout, roles, outcome, out);
  return out;
}

double size_of(const Affine& map) { return 0.5 * std::hypot(map.xx + map.yy, map.yx - map.xy); }

std::vector<std::vector<Point>> outer_rings(const TileLayout& layout) {
  std::vector<std::vector<Point>> out;
  for (const Tile& tile : layout.tiles) {
    auto& ring = out.emplace_back();
    for (const Corner& corner : tile.rings.front())
      ring.push_back(layout.vertices[corner.vertex].at);
  }
  return out;
}

}  // namespace plat::displacement
