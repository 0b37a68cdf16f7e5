#pragma once

#include <span>
#include <vector>

#include "core/box.h"
#include "core/point.h"

namespace plat {

/// A closed chain of points, first point not repeated.
using Ring = std::vector<Point>;
/// An open chain of at least two points.
using Polyline = std::vector<Point>;

/// A region with holes: `outer` counter-clockwise, `holes` clockwise, none closed.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;

  friend bool operator==(const Polygon&, const Polygon&) = default;
};

/// m2, positive for a counter-clockwise ring. Summed about the first point, so that it does not
/// lose digits far from the origin.
double signed_area_m2(std::span<const Point> ring);
double area_m2(const Polygon& polygon);

double length_m(std::span<const Point> polyline);
double perimeter_m(std::span<const Point> ring);
/// Length of all rings, holes included, metres.
double perimeter_m(const Polygon& polygon);

/// The turn at a vertex, radians in (-pi, pi]: positive to the left.
double turn_rad(std::span<const Point> ring, std::size_t vertex);

/// Centre of mass of the region; the mean of the vertices where the area is zero.
Point centroid(const Polygon& polygon);

Box box_of(const Polygon& polygon);

enum class Side { kInside, kBoundary, kOutside };

/// Where `p` lies; even-odd rule, exact on the working grid.
Side locate(std::span<const Point> ring, Point p);
Side locate(const Polygon& polygon, Point p);

/// A point strictly inside the region, as far from its boundary as a scan of a few lines finds one.
/// Pre: area > 0.
Point interior_point(const Polygon& polygon);

/// Distance from `p` to the nearest point of the boundary, metres.
double boundary_distance_m(const Polygon& polygon, Point p);

/// The convex hull, counter-clockwise, without collinear points. Fewer than three points if
/// degenerate.
Ring convex_hull(std::span<const Point> points);

/// Calls `visit(Segment)` for every edge, outer ring first, in ring order.
template <class Visit>
void for_each_edge(const Polygon& polygon, Visit visit) {
  const auto walk = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      visit(Segment{ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]});
    }
  };
  walk(polygon.outer);
  for (const Ring& hole : polygon.holes) walk(hole);
}

}  // namespace plat
