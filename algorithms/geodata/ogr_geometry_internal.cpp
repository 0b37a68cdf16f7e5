#include "geodata/ogr_geometry_internal.h"

#include <memory>

namespace plat::geodata::detail {
namespace {

Polyline points_of(const OGRSimpleCurve& curve) {
  Polyline out;
  out.reserve(static_cast<std::size_t>(curve.getNumPoints()));
  for (int i = 0; i < curve.getNumPoints(); ++i) out.push_back({curve.getX(i), curve.getY(i)});
  return out;
}

Ring ring_from(const OGRSimpleCurve& curve) {
  Ring ring = points_of(curve);
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

/// Takes a linear geometry apart.
void add_linear_parts(const OGRGeometry& geometry, Feature& feature) {
  if (geometry.IsEmpty()) return;
  switch (wkbFlatten(geometry.getGeometryType())) {
    case wkbPoint: {
      const OGRPoint& point = *geometry.toPoint();
      feature.points.push_back({point.getX(), point.getY()});
      return;
    }
    case wkbLineString:
      feature.lines.push_back(points_of(*geometry.toLineString()));
      return;
    case wkbPolygon:
    case wkbTriangle: {
      const OGRPolygon& region = *geometry.toPolygon();
      Polygon polygon{ring_from(*region.getExteriorRing()), {}};
      for (int i = 0; i < region.getNumInteriorRings(); ++i) {
        if (!region.getInteriorRing(i)->IsEmpty())
          polygon.holes.push_back(ring_from(*region.getInteriorRing(i)));
      }
      feature.polygons.push_back(std::move(polygon));
      return;
    }
    case wkbPolyhedralSurface:
    case wkbTIN:
      for (const OGRPolygon* patch : *geometry.toPolyhedralSurface())
        add_linear_parts(*patch, feature);
      return;
    default:
      if (OGR_GT_IsSubClassOf(geometry.getGeometryType(), wkbGeometryCollection)) {
        for (const OGRGeometry* part : *geometry.toGeometryCollection())
          add_linear_parts(*part, feature);
      }
  }
}

void add_points(std::span<const Point> points, Point origin, OGRSimpleCurve& out) {
  for (const Point p : points) out.addPoint(p.x + origin.x, p.y + origin.y);
}

}  // namespace

void add_parts(const OGRGeometry& geometry, Feature& feature) {
  if (geometry.hasCurveGeometry(FALSE) == FALSE) return add_linear_parts(geometry, feature);
  const OGRGeometryUniquePtr linear(geometry.getLinearGeometry());
  add_linear_parts(*linear, feature);
}

OGRGeometryUniquePtr to_ogr(const Polygon& polygon, Point origin) {
  auto out = std::make_unique<OGRPolygon>();
  const auto add_ring = [&](const Ring& ring) {
    auto closed = std::make_unique<OGRLinearRing>();
    add_points(ring, origin, *closed);
    if (!ring.empty()) add_points(std::span(ring).first(1), origin, *closed);
    out->addRingDirectly(closed.release());
  };
  add_ring(polygon.outer);
  for (const Ring& hole : polygon.holes) add_ring(hole);
  return OGRGeometryUniquePtr(out.release());
}

OGRGeometryUniquePtr to_ogr(std::span<const Point> line, Point origin) {
  auto out = std::make_unique<OGRLineString>();
  add_points(line, origin, *out);
  return OGRGeometryUniquePtr(out.release());
}

}  // namespace plat::geodata::detail
