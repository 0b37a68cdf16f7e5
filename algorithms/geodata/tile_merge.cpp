#include "geodata/tile_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>

#include "core/failure.h"
#include "geodata/gdal_internal.h"
#include "geodata/ogr_geometry_internal.h"

namespace plat::geodata {
namespace {

constexpr double kHalfWorld_m = 20037508.342789244;
/// Clipping computes border coordinates anew in each tile.
constexpr double kOnBorder_m = 1e-3;
/// A tile has 4096 units: where ends of the two sides can lie apart.
constexpr double kTileUnits = 4096.0;

double tile_size_m(int zoom) { return 2.0 * kHalfWorld_m / std::exp2(zoom); }

/// A layer's pieces, tile by tile, with one schema.
struct Pieces {
  Layer layer;
  std::vector<std::size_t> tile_of;  ///< per feature
  double tile_size_m = 0.0;
};

FieldType wider(FieldType a, FieldType b) {
  if (a == b) return a;
  return a == FieldType::kText || b == FieldType::kText ? FieldType::kText : FieldType::kReal;
}

Attribute as_type(const Attribute& value, FieldType type) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    if (type == FieldType::kReal) return static_cast<double>(*whole);
    if (type == FieldType::kText) return std::to_string(*whole);
  }
  if (const auto* real = std::get_if<double>(&value); real != nullptr && type == FieldType::kText)
    return fmt::format("{}", *real);
  return value;
}

bool has_parts(const Feature& feature) {
  return !feature.polygons.empty() || !feature.lines.empty() || !feature.points.empty();
}

/// The tile border that a coordinate lies on, counted from the pyramid's corner.
std::optional<std::int64_t> border_at(double coordinate, double tile_size) {
  const double line = (coordinate + kHalfWorld_m) / tile_size;
  const double nearest = std::round(line);
  if (std::abs(line - nearest) * tile_size > kOnBorder_m) return std::nullopt;
  return static_cast<std::int64_t>(nearest);
}

/// The two sides of a border must meet in it, to the last bit, to be united.
void move_onto_borders(Feature& feature, double tile_size) {
  const auto move = [&](double& coordinate) {
    if (const auto line = border_at(coordinate, tile_size))
      coordinate = static_cast<double>(*line) * tile_size - kHalfWorld_m;
  };
  const auto move_all = [&](std::vector<Point>& points) {
    for (Point& p : points) {
      move(p.x);
      move(p.y);
    }
  };
  for (Polygon& polygon : feature.polygons) {
    move_all(polygon.outer);
    for (Ring& hole : polygon.holes) move_all(hole);
  }
  for (Polyline& line : feature.lines) move_all(line);
}

Pieces read_pieces(std::span<const std::string> files, const std::string& name, GeometryKind kind) {
  const LocalFrame mercator{detail::wkt_of(*detail::reference_from_epsg(3857)), {}};
  std::vector<Layer> tiles;
  std::vector<std::size_t> index;
  Pieces out;
  for (std::size_t i = 0; i < files.size(); ++i) {
    out.tile_size_m = tile_size_m(parse_tile_name(files[i]).zoom);
    const std::vector<LayerInfo> infos = list_layers(files[i]);
    const bool has_layer = std::any_of(infos.begin(), infos.end(), [&](const LayerInfo& info) {
      return info.name == name && info.feature_count != 0;
    });
    if (!has_layer) continue;
    tiles.push_back(read_layer({files[i], name}, {.frame = mercator, .kind = kind}));
    index.push_back(i);
  }
  if (tiles.empty()) throw InputError(fmt::format("no tile has a layer \"{}\"", name));
  std::vector<FieldSchema>& fields = out.layer.fields;
  const auto find = [&](const std::string& field) {
    return std::find_if(fields.begin(), fields.end(),
                        [&](const FieldSchema& known) { return known.name == field; });
  };
  for (const Layer& tile : tiles) {
    for (const FieldSchema& field : tile.fields) {
      const auto known = find(field.name);
      if (known == fields.end()) {
        fields.push_back(field);
      } else {
        known->type = wider(known->type, field.type);
      }
    }
  }
  fields.push_back({"tile", FieldType::kText});
  out.layer.name = name;
  out.layer.kind = kind;
  out.layer.frame = mercator;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    for (Feature& feature : tiles[t].features) {
      if (!has_parts(feature)) continue;
      std::vector<Attribute> attributes(fields.size());
      for (std::size_t i = 0; i < tiles[t].fields.size(); ++i) {
        const auto to = find(tiles[t].fields[i].name);
        attributes[static_cast<std::size_t>(to - fields.begin())] =
            as_type(feature.attributes[i], to->type);
      }
      attributes.back() = std::filesystem::path(files[index[t]]).stem().string();
      feature.attributes = std::move(attributes);
      move_onto_borders(feature, out.tile_size_m);
      out.layer.features.push_back(std::move(feature));
      out.tile_of.push_back(index[t]);
    }
  }
  return out;
}

/// Which features are one: sets that grow.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) {
    const std::size_t root_a = find(a);
    const std::size_t root_b = find(b);
    parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// What of a feature lies on a border: the interval an edge covers, or the place of an end.
struct Contact {
  double low = 0.0;
  double high = 0.0;
  std::size_t feature = 0;
};
/// By axis (0: x is fixed) and number of the border.
using Contacts = std::map<std::pair<int, std::int64_t>, std::vector<Contact>>;

void add_contact(Contacts& contacts, const Segment& s, std::size_t feature, double tile_size) {
  const auto add = [&](int axis, double a, double b, double from, double to) {
    const auto line = border_at(a, tile_size);
    if (!line || border_at(b, tile_size) != line) return;
    contacts[{axis, *line}].push_back({std::min(from, to), std::max(from, to), feature});
  };
  add(0, s.a.x, s.b.x, s.a.y, s.b.y);
  add(1, s.a.y, s.b.y, s.a.x, s.b.x);
}

bool are_alike(const Pieces& pieces, std::size_t a, std::size_t b) {
  if (pieces.tile_of[a] == pieces.tile_of[b]) return false;
  const auto& fields = pieces.layer.fields;
  for (std::size_t i = 0; i + 1 < fields.size(); ++i) {
    // Ids are numbers within a tile for areas, and the way's for lines.
    if (fields[i].name == "mvt_id" && pieces.layer.kind == GeometryKind::kPolygon) continue;
    if (pieces.layer.features[a].attributes[i] != pieces.layer.features[b].attributes[i])
      return false;
  }
  return true;
}

template <class Meets>
void unite_across(Contacts& contacts, const Pieces& pieces, Groups& groups, Meets meets) {
  for (auto& [line, row] : contacts) {
    std::sort(row.begin(), row.end(), [](const Contact& a, const Contact& b) {
      return std::tie(a.low, a.high, a.feature) < std::tie(b.low, b.high, b.feature);
    });
    const double reach = pieces.tile_size_m / kTileUnits;
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t k = i + 1; k < row.size() && row[k].low <= row[i].high + reach; ++k) {
        if (meets(row[i], row[k]) && are_alike(pieces, row[i].feature, row[k].feature))
          groups.unite(row[i].feature, row[k].feature);
      }
    }
  }
}

Groups group_polygons(const Pieces& pieces) {
  Contacts contacts;
  for (std::size_t f = 0; f < pieces.layer.features.size(); ++f) {
    for (const Polygon& polygon : pieces.layer.features[f].polygons) {
      for_each_edge(polygon,
                    [&](const Segment& s) { add_contact(contacts, s, f, pieces.tile_size_m); });
    }
  }
  Groups groups(pieces.layer.features.size());
  unite_across(contacts, pieces, groups, [](const Contact& a, const Contact& b) {
    const double common = std::min(a.high, b.high) - std::max(a.low, b.low);
    return common > 0.0 && common >= 0.5 * std::min(a.high - a.low, b.high - b.low);
  });
  return groups;
}

Groups group_lines(const Pieces& pieces) {
  Contacts contacts;
  for (std::size_t f = 0; f < pieces.layer.features.size(); ++f) {
    for (const Polyline& line : pieces.layer.features[f].lines) {
      for (const Point end : {line.front(), line.back()})
        add_contact(contacts, {end, end}, f, pieces.tile_size_m);
    }
  }
  Groups groups(pieces.layer.features.size());
  const double reach = pieces.tile_size_m / kTileUnits;
  unite_across(contacts, pieces, groups, [reach](const Contact& a, const Contact& b) {
    return std::abs(a.low - b.low) <= reach;
  });
  return groups;
}

void dissolve(Feature& feature) {
  OGRMultiPolygon all;
  for (const Polygon& polygon : feature.polygons) {
    OGRGeometryUniquePtr part = detail::to_ogr(polygon, {});
    if (part->IsValid() == FALSE) part.reset(part->MakeValid());
    if (part == nullptr) continue;
    Feature valid;
    detail::add_parts(*part, valid);
    for (const Polygon& piece : valid.polygons)
      all.addGeometryDirectly(detail::to_ogr(piece, {}).release());
  }
  const OGRGeometryUniquePtr united(all.UnionCascaded());
  if (united == nullptr) return;  // the pieces stay side by side
  Feature result;
  detail::add_parts(*united, result);
  if (!result.polygons.empty()) feature.polygons = std::move(result.polygons);
}

/// Joins two lines wherever exactly two ends meet on a border.
void join_lines(Feature& feature, double tile_size) {
  std::vector<Polyline>& lines = feature.lines;
  const double reach = tile_size / kTileUnits;
  const auto is_cut = [&](Point p) {
    return border_at(p.x, tile_size).has_value() || border_at(p.y, tile_size).has_value();
  };
  const auto find_partner = [&](std::size_t i, Point end) -> std::optional<std::size_t> {
    std::optional<std::size_t> partner;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (k == i) continue;
      for (const Point other : {lines[k].front(), lines[k].back()}) {
        if (!is_cut(other) || distance(end, other) > reach) continue;
        if (partner) return std::nullopt;  // a crossing on the border: three or more ends
        partner = k;
      }
    }
    return partner;
  };
  for (std::size_t i = 0; i < lines.size();) {
    std::optional<std::size_t> partner;
    for (int side = 0; side < 2 && !partner; ++side) {
      if (is_cut(lines[i].back())) partner = find_partner(i, lines[i].back());
      if (!partner) std::reverse(lines[i].begin(), lines[i].end());
    }
    if (!partner) {
      ++i;
      continue;
    }
    Polyline& other = lines[*partner];
    if (distance(lines[i].back(), other.front()) > distance(lines[i].back(), other.back()))
      std::reverse(other.begin(), other.end());
    lines[i].insert(lines[i].end(), other.begin() + 1, other.end());
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(*partner));
    if (*partner < i) --i;
  }
}

}  // namespace

TileName parse_tile_name(const std::string& file) {
  TileName name;
  int used = 0;
  const std::string stem = std::filesystem::path(file).filename().string();
  const int read =
      std::sscanf(stem.c_str(), "%2d-%9d-%9d.mvt%n", &name.zoom, &name.column, &name.row, &used);
  if (read != 3 || static_cast<std::size_t>(used) != stem.size())
    throw InputError(fmt::format("{}: a vector tile must be named zoom-column-row.mvt", file));
  return name;
}

Layer merge_tiles(std::span<const std::string> files, const std::string& layer, GeometryKind kind) {
  const detail::QuietGdal quiet;
  Pieces pieces = read_pieces(files, layer, kind);
  Groups groups = kind == GeometryKind::kPolygon ? group_polygons(pieces) : group_lines(pieces);
  std::vector<Feature>& features = pieces.layer.features;
  std::vector<bool> is_grown(features.size());
  for (std::size_t f = 0; f < features.size(); ++f) {
    const std::size_t first = groups.find(f);
    if (first == f) continue;
    is_grown[first] = true;
    Feature& to = features[first];
    to.polygons.insert(to.polygons.end(), features[f].polygons.begin(), features[f].polygons.end());
    to.lines.insert(to.lines.end(), features[f].lines.begin(), features[f].lines.end());
    to.points.insert(to.points.end(), features[f].points.begin(), features[f].points.end());
  }
  Layer out = pieces.layer;
  out.features.clear();
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (groups.find(f) != f) continue;
    if (is_grown[f] && kind == GeometryKind::kPolygon) dissolve(features[f]);
    if (is_grown[f] && kind == GeometryKind::kLine) join_lines(features[f], pieces.tile_size_m);
    features[f].id = std::to_string(out.features.size() + 1);
    out.features.push_back(std::move(features[f]));
  }
  return out;
}

}  // namespace plat::geodata
