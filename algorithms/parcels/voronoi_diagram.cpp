#include "parcels/voronoi_diagram.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace plat::parcels {
namespace {

// EPICK: the triangulation's topology is exact; its dual's vertices are rounded, and then put on
// the grid anyway.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

/// The part of the line from + t * along, t in [t0, t1], inside the window (Liang and Barsky).
std::optional<Segment> clip(Point from, Point along, double t0, double t1, const Box& window) {
  const auto against = [&](double direction, double room) {
    if (direction == 0.0) return room >= 0.0;
    const double t = room / direction;
    if (direction < 0.0) {
      t0 = std::max(t0, t);
    } else {
      t1 = std::min(t1, t);
    }
    return t0 <= t1;
  };
  if (!against(-along.x, from.x - window.min.x) || !against(along.x, window.max.x - from.x) ||
      !against(-along.y, from.y - window.min.y) || !against(along.y, window.max.y - from.y)) {
    return std::nullopt;
  }
  return Segment{from + t0 * along, from + t1 * along};
}

Point circumcenter(const Delaunay& triangulation, Delaunay::Face_handle face) {
  const auto c = triangulation.circumcenter(face);
  return {c.x(), c.y()};
}

}  // namespace

std::vector<VoronoiEdge> voronoi_edges(std::span<const Point> sites, const Box& window) {
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> points;
  points.reserve(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i)
    points.emplace_back(Kernel::Point_2(sites[i].x, sites[i].y), i);
  const Delaunay triangulation(points.begin(), points.end());

  constexpr double kUnlimited = 1e300;
  std::vector<VoronoiEdge> out;
  for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end();
       ++edge) {
    const auto [face, index] = *edge;
    const auto a = face->vertex(Delaunay::ccw(index))->info();
    const auto b = face->vertex(Delaunay::cw(index))->info();
    const Point along = perpendicular(sites[b] - sites[a]);
    std::optional<Segment> segment;
    if (triangulation.dimension() == 1) {
      segment = clip(midpoint(sites[a], sites[b]), along, -kUnlimited, kUnlimited, window);
    } else {
      const auto opposite = face->neighbor(index);
      const bool has_face = !triangulation.is_infinite(face);
      const bool has_opposite = !triangulation.is_infinite(opposite);
      if (has_face && has_opposite) {
        const Point c = circumcenter(triangulation, face);
        segment = clip(c, circumcenter(triangulation, opposite) - c, 0.0, 1.0, window);
      } else {
        // A ray away from the third vertex of the one finite face. In a face, vertices ccw(i),
        // cw(i) see it on their left, so that the outside is to the right of a -> b.
        const Point c = circumcenter(triangulation, has_face ? face : opposite);
        segment = clip(c, has_face ? -along : along, 0.0, kUnlimited, window);
      }
    }
    if (segment) out.push_back({*segment, a, b});
  }
  return out;
}

}  // namespace plat::parcels
