#include "core/polygon.h"

#include <algorithm>

namespace plat {

double signed_area_m2(std::span<const Point> ring) {
  if (ring.size() < 3) return 0.0;
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    twice += orientation(ring[0], ring[i], ring[i + 1]);
  }
  return 0.5 * twice;
}

double area_m2(const Polygon& polygon) {
  double area = std::abs(signed_area_m2(polygon.outer));
  for (const Ring& hole : polygon.holes) area -= std::abs(signed_area_m2(hole));
  return area;
}

double length_m(std::span<const Point> polyline) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i)
    sum += distance(polyline[i], polyline[i + 1]);
  return sum;
}

double perimeter_m(std::span<const Point> ring) {
  return ring.size() < 2 ? 0.0 : length_m(ring) + distance(ring.back(), ring.front());
}

double perimeter_m(const Polygon& polygon) {
  double sum = perimeter_m(std::span<const Point>(polygon.outer));
  for (const Ring& hole : polygon.holes) sum += perimeter_m(std::span<const Point>(hole));
  return sum;
}

namespace {

struct Moment {
  double twice_area = 0.0;
  Point sum;  // of triangle centroids about the origin point, weighted by twice their area, times 3
};

Moment ring_moment(const Ring& ring, Point origin, double sign) {
  Moment m;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i] - origin;
    const Point b = ring[i + 1 == ring.size() ? 0 : i + 1] - origin;
    const double c = cross(a, b);
    m.twice_area += c;
    m.sum = m.sum + c * (a + b);
  }
  const double s = (m.twice_area < 0.0 ? -1.0 : 1.0) * sign;
  return {s * m.twice_area, s * m.sum};
}

}  // namespace

double turn_rad(std::span<const Point> ring, std::size_t vertex) {
  const std::size_t n = ring.size();
  const Point in = ring[vertex] - ring[(vertex + n - 1) % n];
  const Point out = ring[(vertex + 1) % n] - ring[vertex];
  return std::atan2(cross(in, out), dot(in, out));
}

Point centroid(const Polygon& polygon) {
  if (polygon.outer.empty()) return {};
  const Point origin = polygon.outer.front();
  Moment total = ring_moment(polygon.outer, origin, 1.0);
  for (const Ring& hole : polygon.holes) {
    const Moment m = ring_moment(hole, origin, -1.0);
    total.twice_area += m.twice_area;
    total.sum = total.sum + m.sum;
  }
  if (total.twice_area <= 0.0) {
    Point mean;
    for (const Point p : polygon.outer) mean = mean + p;
    return mean / static_cast<double>(polygon.outer.size());
  }
  return origin + total.sum / (3.0 * total.twice_area);
}

Box box_of(const Polygon& polygon) { return box_of(std::span<const Point>(polygon.outer)); }

Side locate(std::span<const Point> ring, Point p) {
  bool is_inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[i + 1 == ring.size() ? 0 : i + 1];
    if ((a.y > p.y) != (b.y > p.y)) {
      const double o = a.y < b.y ? orientation(a, b, p) : orientation(b, a, p);
      if (o == 0.0) return Side::kBoundary;
      if (o > 0.0) is_inside = !is_inside;
    } else if (a == p || b == p ||
               (a.y == p.y && b.y == p.y && std::min(a.x, b.x) <= p.x &&
                p.x <= std::max(a.x, b.x))) {
      return Side::kBoundary;
    }
  }
  return is_inside ? Side::kInside : Side::kOutside;
}

Side locate(const Polygon& polygon, Point p) {
  const Side outer = locate(std::span<const Point>(polygon.outer), p);
  if (outer != Side::kInside) return outer;
  for (const Ring& hole : polygon.holes) {
    const Side side = locate(std::span<const Point>(hole), p);
    if (side == Side::kBoundary) return Side::kBoundary;
    if (side == Side::kInside) return Side::kOutside;
  }
  return Side::kInside;
}

double boundary_distance_m(const Polygon& polygon, Point p) {
  double best = std::numeric_limits<double>::infinity();
  for_each_edge(polygon, [&](const Segment& s) {
    best = std::min(best, squared_length(nearest_point(s, p) - p));
  });
  return std::sqrt(best);
}

Point interior_point(const Polygon& polygon) {
  // Horizontal scan lines between distinct vertex heights never run along an edge; on each, the
  // middle of the widest inside interval is a candidate, and the one farthest from the boundary
  // wins.
  const Box box = box_of(polygon);
  std::vector<double> heights;
  for_each_edge(polygon, [&](const Segment& s) { heights.push_back(s.a.y); });
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  std::vector<double> lines;
  if (heights.size() <= 9) {
    for (std::size_t i = 0; i + 1 < heights.size(); ++i)
      lines.push_back(0.5 * (heights[i] + heights[i + 1]));
  } else {
    for (int k = 1; k <= 8; ++k) {
      const double wanted = box.min.y + box.height() * (k / 9.0);
      const auto above = std::upper_bound(heights.begin() + 1, heights.end() - 1, wanted);
      lines.push_back(0.5 * (*(above - 1) + *above));
    }
  }
  Point best = centroid(polygon);
  double best_distance =
      locate(polygon, best) == Side::kInside ? boundary_distance_m(polygon, best) : -1.0;
  std::vector<double> crossings;
  for (const double y : lines) {
    crossings.clear();
    for_each_edge(polygon, [&](const Segment& s) {
      if ((s.a.y > y) != (s.b.y > y)) {
        crossings.push_back(s.a.x + (y - s.a.y) * (s.b.x - s.a.x) / (s.b.y - s.a.y));
      }
    });
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const Point candidate{0.5 * (crossings[i] + crossings[i + 1]), y};
      const double d = boundary_distance_m(polygon, candidate);
      if (d > best_distance) {
        best = candidate;
        best_distance = d;
      }
    }
  }
  return best;
}

Ring convex_hull(std::span<const Point> points) {
  std::vector<Point> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  Ring hull;
  hull.reserve(2 * sorted.size());
  const auto add = [&](Point p, std::size_t keep) {
    while (hull.size() >= keep + 2 && orientation(hull[hull.size() - 2], hull.back(), p) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Point p : sorted) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto it = sorted.rbegin() + 1; it != sorted.rend(); ++it) add(*it, lower);
  hull.pop_back();
  return hull;
}

}  // namespace plat
