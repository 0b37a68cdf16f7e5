#include "core/validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/working_grid.h"

namespace plat {
namespace {

struct Edge {
  Point a;
  Point b;
  std::size_t ring = 0;
  std::size_t index = 0;
  std::size_t ring_size = 0;
};

int sign(double x) { return (x > 0.0) - (x < 0.0); }

bool is_between(Point a, Point b, Point p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

enum class Contact { kNone, kTouch, kCross };

/// kTouch: the closed segments share a single point that is an end of at least one of them.
Contact contact(const Edge& e, const Edge& f) {
  const int fa = sign(orientation(e.a, e.b, f.a));
  const int fb = sign(orientation(e.a, e.b, f.b));
  const int ea = sign(orientation(f.a, f.b, e.a));
  const int eb = sign(orientation(f.a, f.b, e.b));
  if (fa == 0 && fb == 0) {  // collinear: cross if they overlap in more than a point
    const bool along_x = std::abs(e.b.x - e.a.x) >= std::abs(e.b.y - e.a.y);
    const auto key = [&](Point p) { return along_x ? p.x : p.y; };
    const double low = std::max(std::min(key(e.a), key(e.b)), std::min(key(f.a), key(f.b)));
    const double high = std::min(std::max(key(e.a), key(e.b)), std::max(key(f.a), key(f.b)));
    return low < high ? Contact::kCross : (low == high ? Contact::kTouch : Contact::kNone);
  }
  if (fa * fb < 0 && ea * eb < 0) return Contact::kCross;
  if ((fa == 0 && is_between(e.a, e.b, f.a)) || (fb == 0 && is_between(e.a, e.b, f.b)) ||
      (ea == 0 && is_between(f.a, f.b, e.a)) || (eb == 0 && is_between(f.a, f.b, e.b))) {
    return Contact::kTouch;
  }
  return Contact::kNone;
}

bool are_neighbours(const Edge& e, const Edge& f) {
  if (e.ring != f.ring) return false;
  const std::size_t d = e.index > f.index ? e.index - f.index : f.index - e.index;
  return d == 1 || d + 1 == e.ring_size;
}

std::string place(const Edge& e) {
  return fmt::format("ring {} edge {} near ({:.3f}, {:.3f})", e.ring, e.index, e.a.x, e.a.y);
}

enum class HoleTouch { kForbidden, kAllowed };

std::optional<Failure> check(const Polygon& polygon, HoleTouch hole_touch) {
  std::vector<Edge> edges;
  std::size_t ring_count = 0;
  const auto add_ring = [&](const Ring& ring) -> std::optional<Failure> {
    if (ring.size() < 3)
      return Failure{FailureCode::kEmptyGeometry,
                     fmt::format("ring {} has fewer than 3 points", ring_count)};
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Edge e{ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], ring_count, i, ring.size()};
      if (e.a == e.b) return Failure{FailureCode::kNotSimple, "repeated point at " + place(e)};
      edges.push_back(e);
    }
    ++ring_count;
    return std::nullopt;
  };
  if (auto defect = add_ring(polygon.outer)) return defect;
  for (const Ring& hole : polygon.holes) {
    if (auto defect = add_ring(hole)) return defect;
  }
  if (signed_area_m2(polygon.outer) <= 0.0) {
    return Failure{FailureCode::kNotSimple, "outer ring is clockwise or without area"};
  }
  for (const Ring& hole : polygon.holes) {
    if (signed_area_m2(hole) >= 0.0)
      return Failure{FailureCode::kBadHole, "hole is counter-clockwise or without area"};
  }

  // Sweep over x: only edges whose x ranges overlap are compared.
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) {
    return std::min(e.a.x, e.b.x) < std::min(f.a.x, f.b.x);
  });
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Edge& e = edges[i];
    const double left = std::min(e.a.x, e.b.x);
    std::erase_if(active,
                  [&](std::size_t j) { return std::max(edges[j].a.x, edges[j].b.x) < left; });
    for (const std::size_t j : active) {
      const Edge& f = edges[j];
      if (std::max(e.a.y, e.b.y) < std::min(f.a.y, f.b.y) ||
          std::max(f.a.y, f.b.y) < std::min(e.a.y, e.b.y))
        continue;
      const Contact found = contact(e, f);
      if (found == Contact::kNone) continue;
      if (found == Contact::kTouch && are_neighbours(e, f)) continue;
      if (found == Contact::kTouch && e.ring != f.ring && hole_touch == HoleTouch::kAllowed)
        continue;
      const FailureCode code = e.ring == f.ring ? FailureCode::kNotSimple : FailureCode::kBadHole;
      const char* verb = found == Contact::kCross ? " crosses " : " touches ";
      return Failure{code, place(f) + verb + place(e)};
    }
    active.push_back(i);
  }

  // No edge crosses another: a hole is inside if one of its points is that is not on the other
  // ring.
  const auto side_of_ring = [](const Ring& ring, const Ring& container) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Side side = locate(std::span<const Point>(container), ring[i]);
      if (side != Side::kBoundary) return side;
    }
    return locate(std::span<const Point>(container), midpoint(ring[0], ring[1]));
  };
  for (std::size_t i = 0; i < polygon.holes.size(); ++i) {
    if (side_of_ring(polygon.holes[i], polygon.outer) == Side::kOutside) {
      return Failure{FailureCode::kBadHole, fmt::format("hole {} lies outside the outer ring", i)};
    }
    for (std::size_t j = 0; j < polygon.holes.size(); ++j) {
      if (i != j && side_of_ring(polygon.holes[i], polygon.holes[j]) == Side::kInside) {
        return Failure{FailureCode::kBadHole, fmt::format("hole {} lies inside hole {}", i, j)};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Failure> find_defect(const Polygon& polygon) {
  return check(polygon, HoleTouch::kForbidden);
}

std::optional<Failure> find_ogc_defect(const Polygon& polygon) {
  return check(polygon, HoleTouch::kAllowed);
}

Expected<Polygon> admit_polygon(const Polygon& raw, std::size_t max_vertices) {
  std::size_t vertices = 0;
  bool is_usable = true;
  for_each_edge(raw, [&](const Segment& s) {
    ++vertices;
    is_usable = is_usable && std::abs(s.a.x) <= kGridExtent_m &&
                std::abs(s.a.y) <= kGridExtent_m;  // false for NaN
  });
  if (!is_usable)
    return fail(FailureCode::kNotFinite,
                "a coordinate is not finite or farther than 2097 km from the origin");
  Polygon polygon = snap_polygon(raw);
  if (polygon.outer.empty())
    return fail(FailureCode::kEmptyGeometry, "nothing is left of the polygon on the 2^-10 m grid");
  vertices = polygon.outer.size();
  for (const Ring& hole : polygon.holes) vertices += hole.size();
  if (vertices > max_vertices) {
    return fail(FailureCode::kTooManyVertices,
                fmt::format("{} vertices, at most {} are accepted: simplify first", vertices,
                            max_vertices));
  }
  const Box box = box_of(polygon);
  if (std::max(box.width(), box.height()) > 32768.0) {
    return fail(FailureCode::kNotFinite, "wider than 32.8 km: cross products would not be exact");
  }
  if (auto defect = find_defect(polygon)) return tl::unexpected<Failure>(*std::move(defect));
  return polygon;
}

}  // namespace plat
