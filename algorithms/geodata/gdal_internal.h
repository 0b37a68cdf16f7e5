#pragma once

// GDAL stays in this stage: only its .cpp files include this header.
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <optional>
#include <string>

#include "geodata/layer.h"

namespace plat::geodata::detail {

/// While it lives, GDAL prints nothing on this thread and its messages are kept.
class QuietGdal {
 public:
  QuietGdal();
  ~QuietGdal();
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  void clear() { message_.clear(); }
  [[nodiscard]] bool has_failed() const { return !message_.empty(); }
  /// " (GDAL: ...)" on one line, or nothing.
  [[nodiscard]] std::string reason() const;

 private:
  static void CPL_STDCALL keep(CPLErr level, CPLErrorNum number, const char* text);

  std::string message_;
};

/// A GDAL option set on this thread while it lives.
class ScopedConfig {
 public:
  ScopedConfig(const char* key, const char* value);
  ~ScopedConfig();
  ScopedConfig(const ScopedConfig&) = delete;
  ScopedConfig& operator=(const ScopedConfig&) = delete;

 private:
  std::string key_;
  std::optional<std::string> before_;
};

/// Opens vector data read-only. @throws InputError
GDALDatasetUniquePtr open_vector(const std::string& file);

/// The kind of a declared type; nullopt for "any", collections and none.
std::optional<GeometryKind> kind_of(OGRwkbGeometryType type);

/// Whole numbers, reals, and text for everything else (dates, lists).
FieldType type_of(const OGRFieldDefn& field);

using SpatialReference = std::unique_ptr<OGRSpatialReference>;

/// From WKT, with axes in the order east, north. Pre: valid, not empty.
SpatialReference reference_from_wkt(const std::string& wkt);
SpatialReference reference_from_epsg(int code);
/// WKT2 of the horizontal part.
std::string wkt_of(const OGRSpatialReference& reference);

}  // namespace plat::geodata::detail
