#pragma once

#include <ogr_geometry.h>

#include <span>

#include "geodata/layer.h"

namespace plat::geodata::detail {

/// Takes a geometry apart: curves made linear, collections opened, heights dropped, rings not
/// closed, empty parts left out.
void add_parts(const OGRGeometry& geometry, Feature& feature);

/// Closed rings, moved by `origin`.
OGRGeometryUniquePtr to_ogr(const Polygon& polygon, Point origin);
OGRGeometryUniquePtr to_ogr(std::span<const Point> line, Point origin);

}  // namespace plat::geodata::detail
