#include "geodata/layer_io.h"

#include <filesystem>

#include "geodata/gdal_internal.h"

namespace plat::geodata {

LayerSource parse_layer_source(std::string_view text) {
  const std::string whole(text);
  if (std::filesystem::exists(whole)) return {whole, std::nullopt};
  const std::size_t colon = whole.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == whole.size() ||
      whole.find('/', colon) != std::string::npos) {
    return {whole, std::nullopt};
  }
  return {whole.substr(0, colon), whole.substr(colon + 1)};
}

std::string to_string(const LayerSource& source) {
  return source.layer ? source.file + ":" + *source.layer : source.file;
}

std::string_view kind_name(GeometryKind kind) {
  switch (kind) {
    case GeometryKind::kPolygon:
      return "polygon";
    case GeometryKind::kLine:
      return "line";
    case GeometryKind::kPoint:
      return "point";
  }
  return "";
}

std::vector<LayerInfo> list_layers(const std::string& file) {
  const detail::QuietGdal quiet;
  const GDALDatasetUniquePtr data = detail::open_vector(file);
  std::vector<LayerInfo> out;
  for (OGRLayer* layer : data->GetLayers()) {
    LayerInfo info;
    info.name = layer->GetName();
    info.kind = detail::kind_of(layer->GetGeomType());
    info.feature_count = layer->GetFeatureCount(FALSE);
    if (const OGRSpatialReference* reference = layer->GetSpatialRef()) {
      const char* name = reference->GetName();
      info.crs_name = name == nullptr ? "" : name;
    }
    const OGRFeatureDefn& schema = *layer->GetLayerDefn();
    for (int i = 0; i < schema.GetFieldCount(); ++i) {
      const OGRFieldDefn& field = *schema.GetFieldDefn(i);
      info.fields.push_back({field.GetNameRef(), detail::type_of(field)});
    }
    out.push_back(std::move(info));
  }
  return out;
}

}  // namespace plat::geodata
