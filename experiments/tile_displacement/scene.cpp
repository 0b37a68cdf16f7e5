#include "tile_displacement/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/atomic_file.h"
#include "geodata/layer_io.h"
#include "harness/build_info.h"
#include "harness/config_reader_internal.h"
#include "harness/observed_tiles.h"
#include "tiles/tile_graph.h"

namespace plat::displacement {
namespace {

using harness::ObjectReader;
using nlohmann::json;
using tiles::Tile;
using tiles::TileGraph;
using tiles::TileLayout;

std::optional<double> length_at(ObjectReader& reader, std::string_view key,
                                const std::string& where) {
  const json* value = reader.find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number() || !(value->get<double>() >= 0.0))
    throw InputError(fmt::format("{}.{}: must be a number of metres, at least 0", where, key));
  return value->get<double>();
}

Region read_region(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  Region out;
  if (const json* box = reader.find("box_m")) {
    if (!box->is_array() || box->size() != 2)
      throw InputError(where + ".box_m: must be two corners");
    out.box.emplace();
    for (const json& corner : *box) out.box->add(read_pair(corner, where + ".box_m"));
    out.center_m = out.box->center();
  } else if (const json* center = reader.find("center_m")) {
    out.center_m = read_pair(*center, where + ".center_m");
    out.from_m = length_at(reader, "from_m", where).value_or(0.0);
    out.to_m = length_at(reader, "to_m", where);
  } else {
    throw InputError(where + ": needs \"box_m\" or \"center_m\"");
  }
  reader.expect_nothing_else();
  return out;
}

Piece read_piece(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  Piece out;
  const json* region = reader.find("where");
  if (region == nullptr) throw InputError(where + ": \"where\" is missing");
  out.where = read_region(*region, where + ".where");
  if (const json* shift = reader.find("shift_m")) out.shift_m = read_pair(*shift, where);
  if (const json* turn = reader.find("turn_deg")) {
    if (!turn->is_number()) throw InputError(where + ".turn_deg: must be a number");
    out.turn_rad = turn->get<double>() * std::numbers::pi / 180.0;
  }
  constexpr std::int64_t kMostTiles = 1000000;
  if (reader.find("held_tiles") != nullptr)
    out.held_tiles = static_cast<std::size_t>(reader.whole("held_tiles", 1, 0, kMostTiles));
  reader.expect_nothing_else();
  return out;
}

/// Carries a piece, but for tiles that another one has.
void carry(const Piece& piece, const TileGraph& graph, Point origin, std::vector<char>& is_carried,
           Displacement& out) {
  const Point center = piece.where.center_m - origin;
  const Affine motion =
      Affine::translation(piece.shift_m) * Affine::rotation(piece.turn_rad, center);
  std::vector<std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < graph.tiles.size(); ++i) {
    const Point middle = graph.tiles[i].centroid;
    if (is_carried[i] != 0 || !piece.where.holds(middle + origin)) continue;
    is_carried[i] = 1;
    out.targets[i] = motion * out.targets[i];
    nearest.emplace_back(distance(middle, center), i);
  }
  std::ranges::sort(nearest);
  if (piece.held_tiles) nearest.resize(std::min(nearest.size(), *piece.held_tiles));
  for (const auto& [away_m, tile] : nearest) out.roles[tile] = Role::kMoved;
}

/// The scene's displacement; the first piece that holds a tile has it.
Displacement displacement_of(const Scene& scene, const TileLayout& layout, const TileGraph& graph,
                             Point origin) {
  Displacement out = undisplaced(layout);
  std::vector<char> is_carried(layout.tiles.size(), 0);
  for (const Piece& piece : scene.pieces) carry(piece, graph, origin, is_carried, out);
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    const Point middle = graph.tiles[i].centroid + origin;
    const bool is_held =
        std::ranges::any_of(scene.held, [&](const Region& region) { return region.holds(middle); });
    if (is_held && out.roles[i] == Role::kFree) out.roles[i] = Role::kHeld;
  }
  if (scene.reach_m) hold_beyond(layout, *scene.reach_m, out);
  return out;
}

geodata::Layer layer_named(std::string name, const geodata::LocalFrame& frame) {
  using geodata::FieldType;
  geodata::Layer out{std::move(name), geodata::GeometryKind::kPolygon, frame, {}, {}};
  out.fields = {{"source_id", FieldType::kText},   {"zone", FieldType::kText},
                {"block", FieldType::kInteger},    {"role", FieldType::kText},
                {"deformation", FieldType::kReal}, {"size", FieldType::kReal},
                {"xx", FieldType::kReal},          {"xy", FieldType::kReal},
                {"yx", FieldType::kReal},          {"yy", FieldType::kReal},
                {"shift_x_m", FieldType::kReal},   {"shift_y_m", FieldType::kReal}};
  return out;
}

/// @param rings  the outer rings, one per tile
geodata::Layer layer_of(std::string name, const geodata::LocalFrame& frame,
                        const TileLayout& layout, const std::vector<Role>& roles,
                        const std::vector<Affine>& maps,
                        const std::vector<std::vector<Point>>& rings) {
  geodata::Layer out = layer_named(std::move(name), frame);
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    const Tile& tile = layout.tiles[i];
    const Affine& map = maps[i];
    geodata::Feature feature;
    feature.id = fmt::format("{}", i + 1);
    feature.polygons.push_back({rings[i], {}});
    feature.attributes = {tile.source_id,
                          tile.zone,
                          static_cast<std::int64_t>(tile.block),
                          std::string(role_name(roles[i])),
                          std::hypot(map.xx - map.yy, map.xy + map.yx),
                          size_of(map),
                          map.xx,
                          map.xy,
                          map.yx,
                          map.yy,
                          map.shift.x,
                          map.shift.y};
    out.features.push_back(std::move(feature));
  }
  return out;
}

std::vector<std::vector<Point>> placed_rings(const TileLayout& layout,
                                             const std::vector<Affine>& maps) {
  std::vector<std::vector<Point>> out;
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    auto& ring = out.emplace_back();
    for (const tiles::Corner& corner : layout.tiles[i].rings.front())
      ring.push_back(maps[i](corner.rest));
  }
  return out;
}

json json_of(const Errors& errors) {
  return {{"free_tiles", errors.free_tiles},
          {"gap_m", errors.gap_m},
          {"property_gap_m", errors.property_gap_m},
          {"street_gap_m", errors.street_gap_m},
          {"deformation", errors.deformation},
          {"largest_deformation", errors.largest_deformation},
          {"size_change", errors.size_change},
          {"closed_deformation", errors.closed_deformation},
          {"non_affine_m", errors.non_affine_m},
          {"held_tiles", errors.held_tiles},
          {"held_deformation", errors.held_deformation},
          {"held_off_m", errors.held_off_m},
          {"largest_held_off_m", errors.largest_held_off_m}};
}

}  // namespace

bool Region::holds(Point middle) const {
  if (box) return box->contains(middle);
  const double away_m = distance(middle, center_m);
  return away_m >= from_m && (!to_m || away_m <= *to_m);
}

Scene parse_scene(const json& object, const std::string& source) {
  ObjectReader reader(object, source);
  Scene out;
  const json* city = reader.find("city");
  if (city == nullptr) throw InputError(source + ": \"city\" is missing");
  out.city = read_city_choice(*city, source + ": city");
  if (const json* pieces = reader.find("pieces")) {
    for (const json& piece : *pieces)
      out.pieces.push_back(
          read_piece(piece, fmt::format("{}: pieces[{}]", source, out.pieces.size())));
  }
  if (const json* held = reader.find("held")) {
    for (const json& region : *held)
      out.held.push_back(read_region(region, fmt::format("{}: held[{}]", source, out.held.size())));
  }
  out.reach_m = length_at(reader, "reach_m", source);
  if (const json* ways = reader.find("ways")) out.ways = read_ways(*ways, source + ": ways");
  reader.expect_nothing_else();
  return out;
}

bool show_scene(const Scene& scene, const std::filesystem::path& out, Jobs jobs) {
  const harness::ObservedTiles observed = harness::load_tiles(
      geodata::dataset(scene.city.dataset), {scene.city.tiles, scene.city.near}, {}, jobs);
  const TileLayout& layout = observed.tiles.layout;
  const TileGraph graph = tiles::graph_of(layout);
  const Displacement displacement = displacement_of(scene, layout, graph, observed.frame.origin);
  std::vector<Affine> now;
  for (const Tile& tile : layout.tiles) now.push_back(tile.placement);
  std::vector<geodata::Layer> layers{
      layer_of("observed", observed.frame, layout, displacement.roles, now, outer_rings(layout))};
  json measures{{"tiles", layout.tiles.size()},
                {"observed_failures", observed.tiles.failures.size()},
                {"build", harness::build_info()}};
  bool is_good = true;
  for (const Way& way : scene.ways) {
    const auto outcome = displaced(layout, graph, displacement, way);
    if (!outcome) {
      measures["ways"][way.name] = {{"failure", outcome.error().message}};
      is_good = false;
      continue;
    }
    measures["ways"][way.name] = json_of(errors_of(layout, graph, displacement.roles, *outcome));
    const auto& maps = outcome->solution.placements;
    // A warp places no tile by a map: what it does to the corners is all there is.
    const auto placed = way.method == Method::kWarp ? outcome->outer : placed_rings(layout, maps);
    layers.push_back(layer_of(way.name, observed.frame, layout, displacement.roles, maps, placed));
    layers.push_back(layer_of(way.name + "_closed", observed.frame, layout, displacement.roles,
                              maps, outcome->outer));
  }
  std::filesystem::create_directories(out);
  geodata::write_layers((out / "tiles.gpkg").string(), layers);
  write_file(out / "measures.json", measures.dump(2) + "\n");
  return is_good;
}

}  // namespace plat::displacement
