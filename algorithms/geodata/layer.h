#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/polygon.h"

namespace plat::geodata {

/// Where local coordinates are on Earth: metres east and north of `origin` in a projected, metric
/// CRS. Degrees and projections stay in this stage (DESIGN, decision 4).
struct LocalFrame {
  std::string
      crs_wkt;   ///< WKT2 of the projected CRS, axes east and north, metres; empty if unknown
  Point origin;  ///< of the local frame, in that CRS; whole metres

  friend bool operator==(const LocalFrame&, const LocalFrame&) = default;
};

/// A field's value; monostate where the feature has none.
using Attribute = std::variant<std::monostate, std::int64_t, double, std::string>;

enum class FieldType { kInteger, kReal, kText };
struct FieldSchema {
  std::string name;
  FieldType type = FieldType::kText;
};

/// One feature in the local frame; multi-part geometries have several entries of one kind.
/// Coordinates are as observed: no snapping, no repair. Rings are not closed; orientation is as
/// Polygon wants it.
struct Feature {
  std::string id;  ///< the feature id in the file, or the id that the writer gives
  std::vector<Polygon> polygons;
  std::vector<Polyline> lines;
  std::vector<Point> points;
  std::vector<Attribute> attributes;  ///< one per field of the layer
};

enum class GeometryKind { kPolygon, kLine, kPoint };

struct Layer {
  std::string name;
  GeometryKind kind = GeometryKind::kPolygon;
  LocalFrame frame;
  std::vector<FieldSchema> fields;
  std::vector<Feature> features;
};

}  // namespace plat::geodata
