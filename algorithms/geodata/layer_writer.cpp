#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/failure.h"
#include "geodata/gdal_internal.h"
#include "geodata/layer_io.h"
#include "geodata/ogr_geometry_internal.h"
#include "geodata/partial_file_internal.h"

namespace plat::geodata {
namespace {

using detail::QuietGdal;
using detail::ScopedConfig;
using detail::SpatialReference;
namespace fs = std::filesystem;

/// GeoPackage notes when each layer changed: a fixed time, so that the same layers give the same
/// bytes.
constexpr const char* kWrittenAt = "2000-01-01T00:00:00.000Z";

class Writer {
 public:
  Writer(const std::string& target, const char* driver, const std::string& path)
      : target_(target), is_geojson_(std::string_view(driver) == "GeoJSON") {
    GDALDriver* found = GetGDALDriverManager()->GetDriverByName(driver);
    if (found == nullptr)
      throw InputError(fmt::format("GDAL has no {} driver; reinstall it", driver));
    data_.reset(found->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (data_ == nullptr) refuse("the file cannot be created; does its folder exist?");
  }

  void add(const Layer& layer) {
    OGRLayer& out = create(layer);
    const std::vector<GIntBig> ids = feature_ids(layer);
    if (data_->TestCapability(ODsCTransactions) != FALSE) data_->StartTransaction();
    for (std::size_t i = 0; i < layer.features.size(); ++i) {
      OGRFeature row(out.GetLayerDefn());
      row.SetFID(ids[i]);
      set_attributes(layer, layer.features[i], row);
      if (auto geometry = geometry_of(layer, layer.features[i])) row.SetGeometry(geometry.get());
      if (out.CreateFeature(&row) != OGRERR_NONE)
        refuse(fmt::format("feature {} of layer {}", layer.features[i].id, layer.name));
    }
    if (data_->TestCapability(ODsCTransactions) != FALSE &&
        data_->CommitTransaction() != OGRERR_NONE)
      refuse("the data cannot be committed; is the disk full?");
  }

  void close() {
    quiet_.clear();
    data_.reset();
    if (quiet_.has_failed()) refuse("the file cannot be finished; is the disk full?");
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: cannot be written: {}{}", target_, what, quiet_.reason()));
  }

  OGRLayer& create(const Layer& layer) {
    is_multi_ = std::any_of(layer.features.begin(), layer.features.end(), [](const Feature& f) {
      return f.polygons.size() + f.lines.size() + f.points.size() > 1;
    });
    SpatialReference reference;
    if (!layer.frame.crs_wkt.empty()) reference = detail::reference_from_wkt(layer.frame.crs_wkt);
    if (is_geojson_ && reference == nullptr)
      refuse("GeoJSON is WGS 84, and the layer's place on Earth is not known; write a .gpkg");
    CPLStringList options;
    if (is_geojson_) {
      options.SetNameValue("RFC7946", "YES");
      options.SetNameValue("COORDINATE_PRECISION", "9");  // 0.1 mm
    } else {
      options.SetNameValue("GEOMETRY_NAME", "geom");
      options.SetNameValue("SPATIAL_INDEX", "YES");
    }
    OGRLayer* out = data_->CreateLayer(layer.name.c_str(), reference.get(), type_of(layer.kind),
                                       options.List());
    if (out == nullptr) refuse(fmt::format("layer {}", layer.name));
    for (const FieldSchema& field : layer.fields) {
      OGRFieldDefn defn(field.name.c_str(), field_type(field.type));
      if (out->CreateField(&defn) != OGRERR_NONE)
        refuse(fmt::format("field {} of layer {}", field.name, layer.name));
    }
    return *out;
  }

  [[nodiscard]] OGRwkbGeometryType type_of(GeometryKind kind) const {
    switch (kind) {
      case GeometryKind::kPolygon:
        return is_multi_ ? wkbMultiPolygon : wkbPolygon;
      case GeometryKind::kLine:
        return is_multi_ ? wkbMultiLineString : wkbLineString;
      case GeometryKind::kPoint:
        return is_multi_ ? wkbMultiPoint : wkbPoint;
    }
    return wkbUnknown;
  }

  static OGRFieldType field_type(FieldType type) {
    switch (type) {
      case FieldType::kInteger:
        return OFTInteger64;
      case FieldType::kReal:
        return OFTReal;
      case FieldType::kText:
        return OFTString;
    }
    return OFTString;
  }

  static std::vector<GIntBig> feature_ids(const Layer& layer) {
    std::vector<GIntBig> ids;
    std::set<GIntBig> seen;
    for (const Feature& feature : layer.features) {
      GIntBig id = -1;
      const char* end = feature.id.data() + feature.id.size();
      const auto read = std::from_chars(feature.id.data(), end, id);
      if (read.ec != std::errc() || read.ptr != end || id < 0 || !seen.insert(id).second) break;
      ids.push_back(id);
    }
    if (ids.size() == layer.features.size()) return ids;
    ids.clear();
    ids.reserve(layer.features.size());
    for (std::size_t i = 0; i < layer.features.size(); ++i)
      ids.push_back(static_cast<GIntBig>(i) + 1);
    return ids;
  }

  static void set_attributes(const Layer& layer, const Feature& feature, OGRFeature& row) {
    expects(feature.attributes.size() == layer.fields.size(), "one attribute per field");
    for (std::size_t i = 0; i < layer.fields.size(); ++i) {
      const int column = static_cast<int>(i);
      const Attribute& value = feature.attributes[i];
      if (const auto* number = std::get_if<std::int64_t>(&value)) {
        row.SetField(column, static_cast<GIntBig>(*number));
      } else if (const auto* real = std::get_if<double>(&value)) {
        row.SetField(column, *real);
      } else if (const auto* text = std::get_if<std::string>(&value)) {
        row.SetField(column, text->c_str());
      } else {
        row.SetFieldNull(column);
      }
    }
  }

  static bool is_finite(const Feature& feature) {
    const auto finite = [](std::span<const Point> points) {
      return std::all_of(points.begin(), points.end(),
                         [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); });
    };
    return finite(feature.points) &&
           std::all_of(feature.lines.begin(), feature.lines.end(), finite) &&
           std::all_of(feature.polygons.begin(), feature.polygons.end(), [&](const Polygon& p) {
             return finite(p.outer) && std::all_of(p.holes.begin(), p.holes.end(), finite);
           });
  }

  /// One part as it is, several as their collection; nothing where the feature has no finite part.
  [[nodiscard]] OGRGeometryUniquePtr geometry_of(const Layer& layer, const Feature& feature) const {
    if (!is_finite(feature)) return nullptr;
    const Point origin = layer.frame.origin;
    std::vector<OGRGeometryUniquePtr> parts;
    for (const Polygon& polygon : feature.polygons)
      parts.push_back(detail::to_ogr(polygon, origin));
    for (const Polyline& line : feature.lines) {
      parts.push_back(detail::to_ogr(std::span<const Point>(line), origin));
    }
    for (const Point p : feature.points)
      parts.emplace_back(new OGRPoint(p.x + origin.x, p.y + origin.y));
    if (parts.empty()) return nullptr;
    if (!is_multi_) return std::move(parts.front());
    OGRGeometryUniquePtr collection(OGRGeometryFactory::createGeometry(type_of(layer.kind)));
    for (OGRGeometryUniquePtr& part : parts)
      collection->toGeometryCollection()->addGeometryDirectly(part.release());
    return collection;
  }

  QuietGdal quiet_;
  std::string target_;
  bool is_geojson_;
  bool is_multi_ = false;  ///< of the layer being written
  GDALDatasetUniquePtr data_;
};

}  // namespace

void write_layers(const std::string& path, std::span<const Layer> layers) {
  const std::string ending = fs::path(path).extension().string();
  const bool is_geojson = ending == ".geojson";
  if (!is_geojson && ending != ".gpkg")
    throw InputError(fmt::format("{}: the file must end in .gpkg or .geojson", path));
  if (layers.empty() || (is_geojson && layers.size() != 1)) {
    throw InputError(fmt::format(
        "{}: {} layers, but {}", path, layers.size(),
        is_geojson ? "a .geojson holds one; write a .gpkg" : "a file holds at least one"));
  }
  const ScopedConfig fixed_time("OGR_CURRENT_DATE", kWrittenAt);
  detail::PartialFile partial{fs::path(path)};
  Writer writer(path, is_geojson ? "GeoJSON" : "GPKG", partial.path());
  for (const Layer& layer : layers) writer.add(layer);
  writer.close();
  partial.commit();
}

}  // namespace plat::geodata
