#include "tile_displacement/displacement_experiment.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "core/rng.h"
#include "geodata/dataset_catalogue.h"
#include "harness/observed_tiles.h"
#include "tiles/reconfiguration.h"
#include "tiles/tile_graph.h"

namespace plat::displacement {
namespace {

using tiles::TileGraph;
using tiles::TileLayout;

struct LoadedCity {
  TileLayout layout;
  TileGraph graph;
};

/// A group of tiles and the direction that it is moved in: the same for every displacement and way.
struct Group {
  std::vector<std::uint32_t> tiles;
  Point direction;
};

LoadedCity load(const CityChoice& choice, std::size_t city, Jobs jobs, CityRow& row) {
  const geodata::Dataset& dataset = geodata::dataset(choice.dataset);
  harness::ObservedTiles observed =
      harness::load_tiles(dataset, {choice.tiles, choice.near}, {}, jobs);
  LoadedCity out;
  out.layout = std::move(observed.tiles.layout);
  out.graph = tiles::graph_of(out.layout);
  std::set<std::uint32_t> blocks;
  for (const tiles::Tile& tile : out.layout.tiles) blocks.insert(tile.block);
  row = {city,
         out.layout.tiles.size(),
         blocks.size(),
         out.graph.joints.size(),
         out.layout.links.size(),
         observed.tiles.failures.size()};
  return out;
}

Group drawn_group(const LoadedCity& city, const DisplacementConfig& config,
                  const std::string& dataset, int number) {
  Rng rng(derive_seed(config.seed,
                      {seed_key(dataset), seed_key("group"), static_cast<std::uint64_t>(number)}));
  const auto center = city.graph.tiles[rng.index(city.graph.tiles.size())].centroid;
  const double angle_rad = rng.uniform(0.0, 2.0 * std::numbers::pi);
  Group out;
  out.direction = {std::cos(angle_rad), std::sin(angle_rad)};
  for (std::uint32_t i = 0; i < city.graph.tiles.size(); ++i) {
    if (distance(city.graph.tiles[i].centroid, center) <= config.group_radius_m)
      out.tiles.push_back(i);
  }
  return out;
}

Displacement moved(const LoadedCity& city, const Group& group, double displacement_m,
                   double reach_m) {
  Displacement out = undisplaced(city.layout);
  const Affine motion = Affine::translation(displacement_m * group.direction);
  for (const std::uint32_t tile : group.tiles) {
    out.roles[tile] = Role::kMoved;
    out.targets[tile] = motion * out.targets[tile];
  }
  hold_beyond(city.layout, reach_m, out);
  return out;
}

void solve_row(const LoadedCity& city, const Group& group, const Way& way, double reach_m,
               DisplacementRow& row) {
  const Displacement displacement = moved(city, group, row.displacement_m, reach_m);
  const auto outcome = displaced(city.layout, city.graph, displacement, way);
  if (!outcome) {
    row.status = failure_name(outcome.error().code);
    return;
  }
  row.errors = errors_of(city.layout, city.graph, displacement.roles, *outcome);
  row.objective = outcome->solution.objective;
}

/// Roles of the tiles of a layout that an operation has changed: those that have come are free.
std::vector<Role> roles_after(const TileLayout& before, const std::vector<Role>& roles,
                              const TileLayout& after) {
  std::map<tiles::TileId, Role> known;
  for (std::size_t i = 0; i < before.tiles.size(); ++i) known.emplace(before.tiles[i].id, roles[i]);
  std::vector<Role> out;
  for (const tiles::Tile& tile : after.tiles) {
    const auto found = known.find(tile.id);
    out.push_back(found == known.end() ? Role::kFree : found->second);
  }
  return out;
}

void replace_row(const LoadedCity& city, const Group& group, const Way& way,
                 const DisplacementConfig& config, DisplacementRow& row) {
  const ReplacementChoice& choice = *config.replacement;
  tiles::ReconfigurationOptions options;
  options.solver = way.solver;
  options.reach_m = choice.reach_m;
  if (!row.similarity.empty()) {
    options.similarity = row.similarity;
    tiles::ReplacementOptions replacement;
    replacement.deformation_threshold = choice.deformation_threshold;
    replacement.gap_threshold_m = choice.gap_threshold_m;
    replacement.candidates = choice.candidates;
    replacement.max_rounds = choice.max_rounds;
    options.replacement = replacement;
  }
  std::vector<tiles::TileId> ids;
  for (const std::uint32_t tile : group.tiles) ids.push_back(city.layout.tiles[tile].id);
  const Affine motion = Affine::translation(row.displacement_m * group.direction);
  const auto result = tiles::move_tiles(city.layout, ids, motion, options);
  if (!result) {
    row.status = failure_name(result.error().code);
    return;
  }
  const TileGraph graph = tiles::graph_of(result->layout);
  std::vector<Affine> placements;
  for (const tiles::Tile& tile : result->layout.tiles) placements.push_back(tile.placement);
  Outcome outcome;
  outcome.solution = tiles::measure_placements(graph, std::move(placements), way.solver);
  outcome.joint_gaps_m = outcome.solution.gaps_m;
  outcome.outer = outer_rings(result->layout);
  const auto before = moved(city, group, row.displacement_m, choice.reach_m).roles;
  row.errors =
      errors_of(result->layout, graph, roles_after(city.layout, before, result->layout), outcome);
  row.objective = outcome.solution.objective;
  row.replacements = result->report.replacements;
  row.replacements_refused = result->report.replacements_refused;
  row.rounds = result->report.rounds;
}

/// The rows of a city, not yet filled in.
std::vector<DisplacementRow> rows_of(const DisplacementConfig& config, std::size_t city) {
  std::vector<DisplacementRow> out;
  for (int group = 0; group < config.groups; ++group) {
    for (const double displacement_m : config.displacements_m) {
      const auto add = [&](const std::string& way, const std::string& similarity) {
        DisplacementRow& row = out.emplace_back();
        row.city = city;
        row.group = group;
        row.displacement_m = displacement_m;
        row.way = way;
        row.similarity = similarity;
      };
      for (const Way& way : config.ways) add(way.name, "");
      if (!config.replacement || group >= config.replacement->groups) continue;
      const auto& chosen = config.replacement->displacements_m;
      if (std::ranges::find(chosen, displacement_m) == chosen.end()) continue;
      add("operation", "");
      for (const std::string& name : config.replacement->similarities) add("replacement", name);
    }
  }
  return out;
}

}  // namespace

const std::vector<Measure>& measures() {
  using R = DisplacementRow;
  static const std::vector<Measure> kMeasures{
      {"gap_m", "m", [](const R& r) { return r.errors.gap_m; }},
      {"property_gap_m", "m", [](const R& r) { return r.errors.property_gap_m; }},
      {"street_gap_m", "m", [](const R& r) { return r.errors.street_gap_m; }},
      {"deformation", "", [](const R& r) { return r.errors.deformation; }},
      {"largest_deformation", "", [](const R& r) { return r.errors.largest_deformation; }},
      {"size_change", "", [](const R& r) { return r.errors.size_change; }},
      {"closed_deformation", "", [](const R& r) { return r.errors.closed_deformation; }},
      {"non_affine_m", "m", [](const R& r) { return r.errors.non_affine_m; }},
      {"held_deformation", "", [](const R& r) { return r.errors.held_deformation; }},
      {"held_off_m", "m", [](const R& r) { return r.errors.held_off_m; }},
      {"largest_held_off_m", "m", [](const R& r) { return r.errors.largest_held_off_m; }},
      {"objective", "m2", [](const R& r) { return r.objective; }},
      {"replacements", "", [](const R& r) { return static_cast<double>(r.replacements); }}};
  return kMeasures;
}

DisplacementResult run_displacements(const DisplacementConfig& config, Jobs jobs) {
  DisplacementResult out;
  for (std::size_t c = 0; c < config.cities.size(); ++c) {
    const LoadedCity city = load(config.cities[c], c, jobs, out.cities.emplace_back());
    std::vector<Group> groups;
    for (int g = 0; g < config.groups; ++g)
      groups.push_back(drawn_group(city, config, config.cities[c].dataset, g));
    std::vector<DisplacementRow> rows = rows_of(config, c);
    parallel_for(rows.size(), jobs, [&](std::size_t i) {
      DisplacementRow& row = rows[i];
      const Group& group = groups[static_cast<std::size_t>(row.group)];
      row.moved_tiles = group.tiles.size();
      const bool is_operation = row.way == "operation" || row.way == "replacement";
      const std::string& name = is_operation ? config.replacement->way : row.way;
      const Way& way = *std::ranges::find(config.ways, name, &Way::name);
      if (is_operation) {
        replace_row(city, group, way, config, row);
      } else {
        solve_row(city, group, way, config.reach_m, row);
      }
    });
    out.rows.insert(out.rows.end(), rows.begin(), rows.end());
  }
  return out;
}

}  // namespace plat::displacement
