#include <algorithm>

#include "blocks/geos_internal.h"
#include "core/working_grid.h"

namespace plat::blocks::detail {
namespace {

/// A mitre longer than this many times the distance is cut off: only at needles.
constexpr double kMitreLimit = 5.0;

Ring ring_from(GEOSContextHandle_t context, const GEOSGeometry* shape) {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context, shape);
  unsigned size = 0;
  GEOSCoordSeq_getSize_r(context, sequence, &size);
  Ring ring;
  for (unsigned i = 0; i + 1 < size; ++i) {  // closed there
    Point p;
    GEOSCoordSeq_getXY_r(context, sequence, i, &p.x, &p.y);
    ring.push_back(p);
  }
  return ring;
}

void orient(Ring& ring, bool counter_clockwise) {
  if ((signed_area_m2(ring) > 0.0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
}

GEOSGeometry* linear_ring(GEOSContextHandle_t context, const Ring& ring) {
  GEOSCoordSequence* sequence =
      GEOSCoordSeq_create_r(context, static_cast<unsigned>(ring.size() + 1), 2);
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const Point p = ring[i % ring.size()];
    GEOSCoordSeq_setXY_r(context, sequence, static_cast<unsigned>(i), p.x, p.y);
  }
  return GEOSGeom_createLinearRing_r(context, sequence);
}

}  // namespace

Geos::Geos() : context_(GEOS_init_r()) {}
Geos::~Geos() { GEOS_finish_r(context_); }

GeosShape Geos::from(const Polygon& polygon) const {
  if (polygon.outer.size() < 3) return own(nullptr);
  std::vector<GEOSGeometry*> holes;
  for (const Ring& hole : polygon.holes) {
    if (hole.size() >= 3) holes.push_back(linear_ring(context_, hole));
  }
  return own(GEOSGeom_createPolygon_r(context_, linear_ring(context_, polygon.outer), holes.data(),
                                      static_cast<unsigned>(holes.size())));
}

std::vector<Polygon> Geos::polygons_of(const GEOSGeometry* shape) const {
  std::vector<Polygon> out;
  if (shape == nullptr) return out;
  const int type = GEOSGeomTypeId_r(context_, shape);
  if (type == GEOS_POLYGON) {
    if (GEOSisEmpty_r(context_, shape) != 0) return out;
    Polygon polygon;
    polygon.outer = ring_from(context_, GEOSGetExteriorRing_r(context_, shape));
    orient(polygon.outer, true);
    for (int i = 0; i < GEOSGetNumInteriorRings_r(context_, shape); ++i) {
      polygon.holes.push_back(ring_from(context_, GEOSGetInteriorRingN_r(context_, shape, i)));
      orient(polygon.holes.back(), false);
    }
    out.push_back(std::move(polygon));
  } else if (type == GEOS_MULTIPOLYGON || type == GEOS_GEOMETRYCOLLECTION) {
    for (int i = 0; i < GEOSGetNumGeometries_r(context_, shape); ++i) {
      for (Polygon& part : polygons_of(GEOSGetGeometryN_r(context_, shape, i)))
        out.push_back(std::move(part));
    }
    std::sort(out.begin(), out.end(), [](const Polygon& a, const Polygon& b) {
      return *std::min_element(a.outer.begin(), a.outer.end()) <
             *std::min_element(b.outer.begin(), b.outer.end());
    });
  }
  return out;
}

GeosShape Geos::buffer(const GEOSGeometry* shape, double distance_m) const {
  if (shape == nullptr) return own(nullptr);
  return own(GEOSBufferWithStyle_r(context_, shape, distance_m, 8, GEOSBUF_CAP_FLAT,
                                   GEOSBUF_JOIN_MITRE, kMitreLimit));
}

GeosShape Geos::union_of(std::vector<GeosShape> shapes) const {
  std::vector<GEOSGeometry*> parts;
  for (GeosShape& shape : shapes) {
    if (shape) parts.push_back(shape.release());
  }
  const GeosShape all = own(GEOSGeom_createCollection_r(
      context_, GEOS_GEOMETRYCOLLECTION, parts.data(), static_cast<unsigned>(parts.size())));
  return own(GEOSUnaryUnion_r(context_, all.get()));
}

GeosShape Geos::difference(const GEOSGeometry* a, const GEOSGeometry* b) const {
  if (a == nullptr || b == nullptr) return own(nullptr);
  return own(GEOSDifferencePrec_r(context_, a, b, kGridStep_m));
}

GeosShape Geos::simplified(const GEOSGeometry* shape, double tolerance_m) const {
  if (shape == nullptr) return own(nullptr);
  return own(GEOSTopologyPreserveSimplify_r(context_, shape, tolerance_m));
}

}  // namespace plat::blocks::detail
