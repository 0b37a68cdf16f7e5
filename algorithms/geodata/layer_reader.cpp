#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "core/box.h"
#include "core/failure.h"
#include "core/options.h"
#include "geodata/gdal_internal.h"
#include "geodata/layer_io.h"
#include "geodata/ogr_geometry_internal.h"
#include "geodata/projection_internal.h"

namespace plat::geodata {
namespace {

using detail::is_finite;
using detail::Projection;
using detail::QuietGdal;
using detail::SpatialReference;

/// Calls visit(points) for every ring, line and set of points; `FeatureT` may be const.
template <class FeatureT, class Visit>
void for_each_chain(FeatureT& feature, Visit visit) {
  for (auto& polygon : feature.polygons) {
    visit(polygon.outer);
    for (auto& hole : polygon.holes) visit(hole);
  }
  for (auto& line : feature.lines) visit(line);
  if (!feature.points.empty()) visit(feature.points);
}

Box finite_box(const std::vector<Feature>& features) {
  Box box;
  for (const Feature& feature : features) {
    for_each_chain(feature, [&](const std::vector<Point>& chain) {
      for (const Point p : chain) {
        if (is_finite(p)) box.add(p);
      }
    });
  }
  return box;
}

/// "did you mean" or the whole list: what a person needs to name the layer.
std::string layer_names(GDALDataset& data) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(data.GetLayerCount()));
  for (OGRLayer* layer : data.GetLayers()) names.emplace_back(layer->GetName());
  return fmt::format("{}", fmt::join(names, ", "));
}

OGRLayer& find_layer(GDALDataset& data, const LayerSource& source) {
  if (data.GetLayerCount() == 0)
    throw InputError(fmt::format("{}: holds no vector layer", source.file));
  if (!source.layer) {
    if (data.GetLayerCount() == 1) return *data.GetLayer(0);
    throw InputError(fmt::format("{}: holds several layers ({}); name one as {}:LAYER", source.file,
                                 layer_names(data), source.file));
  }
  OGRLayer* layer = data.GetLayerByName(source.layer->c_str());
  if (layer != nullptr) return *layer;
  std::vector<std::string_view> names;
  for (OGRLayer* other : data.GetLayers()) names.emplace_back(other->GetName());
  throw InputError(fmt::format("{}: no layer \"{}\"{}; there are: {}", source.file, *source.layer,
                               did_you_mean(*source.layer, names), layer_names(data)));
}

/// Where a wanted field is: a column, or a key within `other_tags`.
struct FieldSource {
  int column = -1;
  std::string tag;  ///< not empty: looked for in `column`, an OSM hstore
};

struct Columns {
  std::vector<FieldSchema> schema;
  std::vector<FieldSource> sources;
};

Columns choose_columns(const OGRFeatureDefn& defn, const std::vector<std::string>& wanted,
                       const std::string& where_from) {
  Columns out;
  const auto add_column = [&](int i) {
    const OGRFieldDefn& field = *defn.GetFieldDefn(i);
    out.schema.push_back({field.GetNameRef(), detail::type_of(field)});
    out.sources.push_back({i, {}});
  };
  if (wanted.empty()) {
    for (int i = 0; i < defn.GetFieldCount(); ++i) add_column(i);
    return out;
  }
  const int tags = defn.GetFieldIndex("other_tags");
  for (const std::string& name : wanted) {
    if (const int i = defn.GetFieldIndex(name.c_str()); i >= 0) {
      add_column(i);
      out.schema.back().name = name;
    } else if (tags >= 0) {
      out.schema.push_back({name, FieldType::kText});
      out.sources.push_back({tags, name});
    } else {
      std::vector<std::string_view> names;
      names.reserve(static_cast<std::size_t>(defn.GetFieldCount()));
      for (int k = 0; k < defn.GetFieldCount(); ++k)
        names.emplace_back(defn.GetFieldDefn(k)->GetNameRef());
      throw InputError(fmt::format("{}: no field \"{}\"{}; there are: {}", where_from, name,
                                   did_you_mean(name, names), fmt::join(names, ", ")));
    }
  }
  return out;
}

/// The value of `key` in an OSM hstore: "a"=>"1","b"=>"2", quotes and backslashes escaped.
Attribute tag_value(std::string_view hstore, std::string_view key) {
  std::array<std::string, 2> pair;
  std::size_t side = 0;
  for (std::size_t i = 0; i < hstore.size(); ++i) {
    if (hstore[i] != '"') continue;
    std::string text;
    for (++i; i < hstore.size() && hstore[i] != '"'; ++i) {
      if (hstore[i] == '\\' && i + 1 < hstore.size()) ++i;
      text += hstore[i];
    }
    pair[side] = std::move(text);
    if (side == 1 && pair[0] == key) return pair[1];
    side = 1 - side;
  }
  return std::monostate{};
}

Attribute attribute_of(const OGRFeature& row, const FieldSource& source, FieldType type) {
  if (row.IsFieldSetAndNotNull(source.column) == FALSE) return std::monostate{};
  if (!source.tag.empty()) return tag_value(row.GetFieldAsString(source.column), source.tag);
  switch (type) {
    case FieldType::kInteger:
      return static_cast<std::int64_t>(row.GetFieldAsInteger64(source.column));
    case FieldType::kReal:
      return row.GetFieldAsDouble(source.column);
    case FieldType::kText:
      return std::string(row.GetFieldAsString(source.column));
  }
  return std::monostate{};
}

Feature feature_of(OGRFeature& row, const Columns& columns) {
  Feature feature;
  feature.id = std::to_string(row.GetFID());
  for (std::size_t i = 0; i < columns.sources.size(); ++i)
    feature.attributes.push_back(attribute_of(row, columns.sources[i], columns.schema[i].type));
  if (const OGRGeometry* geometry = row.GetGeometryRef()) detail::add_parts(*geometry, feature);
  return feature;
}

/// Every feature of the layer, in source coordinates. Raw OSM hands out the features of all layers
/// in turn: reading one layer alone would make it hold the others back in memory and give up.
std::vector<Feature> read_features(GDALDataset& data, OGRLayer& layer, const Columns& columns) {
  std::vector<Feature> out;
  const bool is_interleaved = data.TestCapability(ODsCRandomLayerRead) != FALSE;
  if (is_interleaved) {
    data.ResetReading();
    while (true) {
      OGRLayer* from = nullptr;
      const OGRFeatureUniquePtr row(data.GetNextFeature(&from, nullptr, nullptr, nullptr));
      if (row == nullptr) break;
      if (from == &layer) out.push_back(feature_of(*row, columns));
    }
  } else {
    for (const auto& row : layer) out.push_back(feature_of(*row, columns));
  }
  return out;
}

/// Outer rings counter-clockwise, holes clockwise.
void orient(Feature& feature) {
  const auto turn = [](Ring& ring, bool is_outer) {
    const double area = signed_area_m2(ring);
    if (is_outer ? area < 0.0 : area > 0.0) std::reverse(ring.begin(), ring.end());
  };
  for (Polygon& polygon : feature.polygons) {
    turn(polygon.outer, true);
    for (Ring& hole : polygon.holes) turn(hole, false);
  }
}

bool has_kind(const Feature& feature, GeometryKind kind) {
  switch (kind) {
    case GeometryKind::kPolygon:
      return !feature.polygons.empty();
    case GeometryKind::kLine:
      return !feature.lines.empty();
    case GeometryKind::kPoint:
      return !feature.points.empty();
  }
  return false;
}

std::ptrdiff_t count_kind(const std::vector<Feature>& features, GeometryKind kind) {
  return std::count_if(features.begin(), features.end(),
                       [&](const Feature& f) { return has_kind(f, kind); });
}

constexpr std::array kKinds{GeometryKind::kPolygon, GeometryKind::kLine, GeometryKind::kPoint};

GeometryKind choose_kind(const std::vector<Feature>& features, std::optional<GeometryKind> required,
                         const std::string& name) {
  std::array<std::ptrdiff_t, kKinds.size()> counts{};
  for (std::size_t i = 0; i < kKinds.size(); ++i) counts[i] = count_kind(features, kKinds[i]);
  const auto most = static_cast<std::size_t>(
      std::distance(counts.begin(), std::max_element(counts.begin(), counts.end())));
  if (counts[most] == 0)
    throw InputError(fmt::format("{}: none of its {} features has a geometry; choose another layer",
                                 name, features.size()));
  if (!required) return kKinds[most];
  if (count_kind(features, *required) == 0) {
    throw InputError(
        fmt::format("{}: wrong geometry type: wanted {}s, its features are {}s (the first is "
                    "feature {}); choose "
                    "another layer",
                    name, kind_name(*required), kind_name(kKinds[most]), features.front().id));
  }
  return *required;
}

void keep_kind(Feature& feature, GeometryKind kind) {
  if (kind != GeometryKind::kPolygon) feature.polygons.clear();
  if (kind != GeometryKind::kLine) feature.lines.clear();
  if (kind != GeometryKind::kPoint) feature.points.clear();
}

SpatialReference source_reference(OGRLayer& layer, const std::string& name,
                                  const std::string& file) {
  const OGRSpatialReference* found = layer.GetSpatialRef();
  // GeoPackage's two names for "not known" (srs_id 0 and -1), of which the first looks geographic.
  const bool is_undefined = found != nullptr && found->GetName() != nullptr &&
                            std::string_view(found->GetName()).starts_with("Undefined ");
  if (found == nullptr || is_undefined || found->IsEmpty() != 0 ||
      (found->IsProjected() == 0 && found->IsGeographic() == 0)) {
    throw InputError(
        fmt::format("{}: has no coordinate reference system; give it one: ogr2ogr -a_srs EPSG:CODE "
                    "fixed.gpkg {}",
                    name, file));
  }
  return detail::reference_from_wkt(detail::wkt_of(*found));
}

/// Reprojects to the given frame, or to one chosen from the data.
LocalFrame localize(std::vector<Feature>& features, const OGRSpatialReference& source,
                    const std::optional<LocalFrame>& given, const std::string& name) {
  LocalFrame frame;
  SpatialReference target;
  if (given) {
    frame = *given;
    expects(!frame.crs_wkt.empty(), "a frame to reproject into has a CRS");
    target = detail::reference_from_wkt(frame.crs_wkt);
  } else {
    const Box box = finite_box(features);
    if (box.is_empty())
      throw InputError(
          fmt::format("{}: no feature has a finite coordinate; repair the file", name));
    frame = detail::choose_frame(source, box.center(), name, "ogr2ogr");
    target = detail::reference_from_wkt(frame.crs_wkt);
  }
  const Projection project(source, *target);
  for (Feature& feature : features) {
    for_each_chain(feature, [&](std::vector<Point>& chain) {
      project.apply(chain);
      for (Point& p : chain) p = p - frame.origin;
    });
    orient(feature);
  }
  return frame;
}

}  // namespace

Layer read_layer(const LayerSource& source, const ReadOptions& options) {
  QuietGdal quiet;
  const GDALDatasetUniquePtr data = detail::open_vector(source.file);
  OGRLayer& layer = find_layer(*data, source);
  const std::string name = to_string({source.file, layer.GetName()});
  const SpatialReference reference = source_reference(layer, name, source.file);
  const Columns columns = choose_columns(*layer.GetLayerDefn(), options.fields, name);
  quiet.clear();
  // Some drivers see a bad condition at once, others only when they read.
  const auto refuse_condition = [&] {
    throw InputError(fmt::format("{}: bad condition \"{}\"{}; write it as in SQL, e.g. height > 3",
                                 name, options.where, quiet.reason()));
  };
  if (!options.where.empty() && layer.SetAttributeFilter(options.where.c_str()) != OGRERR_NONE)
    refuse_condition();
  Layer out;
  out.name = layer.GetName();
  out.fields = columns.schema;
  out.features = read_features(*data, layer, columns);
  if (quiet.has_failed()) {
    if (!options.where.empty() && out.features.empty()) refuse_condition();
    throw InputError(
        fmt::format("{}: cannot be read to its end{}; is it damaged?", name, quiet.reason()));
  }
  if (out.features.empty()) {
    throw InputError(
        options.where.empty()
            ? fmt::format("{}: the layer is empty; choose another layer", name)
            : fmt::format("{}: no feature meets the condition \"{}\"", name, options.where));
  }
  out.kind = choose_kind(out.features, options.kind, name);
  for (Feature& feature : out.features) keep_kind(feature, out.kind);
  out.frame = localize(out.features, *reference, options.frame, name);
  return out;
}

}  // namespace plat::geodata
