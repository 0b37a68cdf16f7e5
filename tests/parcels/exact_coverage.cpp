#include "parcels/exact_coverage.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace plat::testing {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactRing = CGAL::Polygon_2<Kernel>;
using ExactPolygon = CGAL::Polygon_with_holes_2<Kernel>;
using ExactRegion = CGAL::Polygon_set_2<Kernel>;
using Number = Kernel::FT;

ExactRing exact(const Ring& ring) {
  ExactRing out;
  for (const Point p : ring) out.push_back(Kernel::Point_2(p.x, p.y));
  return out;
}

ExactPolygon exact(const Polygon& polygon) {
  ExactPolygon out(exact(polygon.outer));
  for (const Ring& hole : polygon.holes) out.add_hole(exact(hole));
  return out;
}

/// Orientation matters: holes are clockwise, so their areas are negative.
Number exact_area(const ExactPolygon& polygon) {
  Number sum = polygon.outer_boundary().area();
  for (auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole) sum += hole->area();
  return sum;
}

Number exact_area(const std::vector<ExactPolygon>& polygons) {
  Number sum = 0;
  for (const ExactPolygon& p : polygons) sum += exact_area(p);
  return sum;
}

std::vector<ExactPolygon> parts_of(const ExactRegion& region) {
  std::vector<ExactPolygon> out;
  region.polygons_with_holes(std::back_inserter(out));
  return out;
}

std::optional<std::string> find_unshared_vertex(std::span<const parcels::Parcel> parcels) {
  std::vector<Kernel::Segment_2> edges;
  std::set<Point> vertices;
  for (const parcels::Parcel& parcel : parcels) {
    for_each_edge(parcel.shape, [&](const Segment& s) {
      edges.emplace_back(Kernel::Point_2(s.a.x, s.a.y), Kernel::Point_2(s.b.x, s.b.y));
      vertices.insert(s.a);
    });
  }
  for (const Kernel::Segment_2& edge : edges) {
    const auto box = edge.bbox();
    for (auto p = vertices.lower_bound({box.xmin(), box.ymin()});
         p != vertices.end() && p->x <= box.xmax(); ++p) {
      if (p->y < box.ymin() || p->y > box.ymax()) continue;
      const Kernel::Point_2 q(p->x, p->y);
      if (q == edge.source() || q == edge.target() || !edge.has_on(q)) continue;
      return fmt::format("the vertex ({:.4f}, {:.4f}) lies inside another parcel's edge", p->x,
                         p->y);
    }
  }
  return std::nullopt;
}

std::set<Point> vertices_of(const ExactPolygon& polygon) {
  std::set<Point> out;
  const auto add = [&](const ExactRing& ring) {
    for (auto v = ring.vertices_begin(); v != ring.vertices_end(); ++v)
      out.insert({CGAL::to_double(v->x()), CGAL::to_double(v->y())});
  };
  add(polygon.outer_boundary());
  for (auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole) add(*hole);
  return out;
}

}  // namespace

std::optional<std::string> find_exact_coverage_defect(const Polygon& contour,
                                                      std::span<const parcels::Parcel> parcels,
                                                      double tolerance_m) {
  std::vector<ExactPolygon> shapes;
  for (const parcels::Parcel& parcel : parcels) shapes.push_back(exact(parcel.shape));
  ExactRegion region;
  region.join(shapes.begin(), shapes.end());
  const std::vector<ExactPolygon> joined = parts_of(region);
  if (joined.size() != 1) return fmt::format("the union has {} parts", joined.size());
  const ExactPolygon& whole = joined.front();
  if (exact_area(shapes) != exact_area(whole)) {
    return fmt::format("parcels overlap by {} m2",
                       CGAL::to_double(exact_area(shapes) - exact_area(whole)));
  }
  if (auto defect = find_unshared_vertex(parcels)) return defect;
  if (whole.number_of_holes() != contour.holes.size()) {
    return fmt::format("the union has {} holes, the block {}", whole.number_of_holes(),
                       contour.holes.size());
  }

  const std::set<Point> outline = vertices_of(whole);
  std::optional<std::string> defect;
  for_each_edge(contour, [&](const Segment& s) {
    if (!outline.contains(s.a)) {
      defect = fmt::format("the contour's vertex ({:.4f}, {:.4f}) is not on the union's outline",
                           s.a.x, s.a.y);
    }
  });
  for (const Point p : outline) {
    if (boundary_distance_m(contour, p) <= tolerance_m) continue;
    defect = fmt::format("the union's vertex ({:.4f}, {:.4f}) is off the contour", p.x, p.y);
  }
  if (defect) return defect;

  region.symmetric_difference(exact(contour));
  const double differs_m2 = CGAL::to_double(exact_area(parts_of(region)));
  if (differs_m2 > tolerance_m * perimeter_m(contour))
    return fmt::format("the union and the block differ by {} m2", differs_m2);
  return std::nullopt;
}

}  // namespace plat::testing
