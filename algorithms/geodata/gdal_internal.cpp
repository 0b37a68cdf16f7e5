#include "geodata/gdal_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <mutex>

#include "core/failure.h"

namespace plat::geodata::detail {

QuietGdal::QuietGdal() {
  static std::once_flag registered;
  std::call_once(registered, [] { GDALAllRegister(); });
  CPLPushErrorHandlerEx(&QuietGdal::keep, this);
}

QuietGdal::~QuietGdal() { CPLPopErrorHandler(); }

void CPL_STDCALL QuietGdal::keep(CPLErr level, CPLErrorNum /*number*/, const char* text) {
  if (level < CE_Failure) return;
  auto* self = static_cast<QuietGdal*>(CPLGetErrorHandlerUserData());
  if (self->message_.empty()) self->message_ = text;  // the first one is the cause
}

std::string QuietGdal::reason() const {
  if (message_.empty()) return {};
  std::string line = message_;
  std::replace(line.begin(), line.end(), '\n', ' ');
  return " (GDAL: " + line + ")";
}

ScopedConfig::ScopedConfig(const char* key, const char* value) : key_(key) {
  if (const char* old = CPLGetThreadLocalConfigOption(key, nullptr)) before_ = old;
  CPLSetThreadLocalConfigOption(key, value);
}

ScopedConfig::~ScopedConfig() {
  CPLSetThreadLocalConfigOption(key_.c_str(), before_ ? before_->c_str() : nullptr);
}

GDALDatasetUniquePtr open_vector(const std::string& file) {
  const QuietGdal quiet;
  std::string path = file;
  if (!file.starts_with("/vsi")) {
    if (!std::filesystem::exists(file))
      throw InputError(fmt::format("{}: no such file; check the path", file));
    // The OSM driver reads .osm and .pbf only: a compressed .osm is read through GDAL's gzip layer.
    if (file.ends_with(".osm.gz")) path = "/vsigzip/" + std::filesystem::absolute(file).string();
  }
  // GDAL would leave a note about the uncompressed size beside the user's file.
  const ScopedConfig no_side_file("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
  GDALDatasetUniquePtr data(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY,
                                              nullptr, nullptr, nullptr));
  if (data == nullptr) {
    throw InputError(
        fmt::format("{}: not a vector file that GDAL can read; `ogrinfo` must be able to open it{}",
                    file, quiet.reason()));
  }
  return data;
}

std::optional<GeometryKind> kind_of(OGRwkbGeometryType type) {
  switch (OGR_GT_GetLinear(wkbFlatten(type))) {
    case wkbPoint:
    case wkbMultiPoint:
      return GeometryKind::kPoint;
    case wkbLineString:
    case wkbMultiLineString:
      return GeometryKind::kLine;
    case wkbPolygon:
    case wkbMultiPolygon:
    case wkbTriangle:
    case wkbTIN:
    case wkbPolyhedralSurface:
      return GeometryKind::kPolygon;
    default:
      return std::nullopt;
  }
}

FieldType type_of(const OGRFieldDefn& field) {
  switch (field.GetType()) {
    case OFTInteger:
    case OFTInteger64:
      return FieldType::kInteger;
    case OFTReal:
      return FieldType::kReal;
    default:
      return FieldType::kText;
  }
}

SpatialReference reference_from_wkt(const std::string& wkt) {
  auto reference = std::make_unique<OGRSpatialReference>();
  expects(reference->importFromWkt(wkt.c_str()) == OGRERR_NONE, "a frame's CRS is valid WKT");
  reference->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

SpatialReference reference_from_epsg(int code) {
  auto reference = std::make_unique<OGRSpatialReference>();
  if (reference->importFromEPSG(code) != OGRERR_NONE)
    throw InputError(fmt::format("EPSG:{} is not known to PROJ; is its database installed?", code));
  reference->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

std::string wkt_of(const OGRSpatialReference& reference) {
  const std::unique_ptr<OGRSpatialReference> flat(reference.Clone());
  if (flat->IsCompound()) flat->StripVertical();
  flat->DemoteTo2D(nullptr);
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  flat->exportToWkt(&text, options);
  std::string out = text == nullptr ? "" : text;
  CPLFree(text);
  return out;
}

}  // namespace plat::geodata::detail
