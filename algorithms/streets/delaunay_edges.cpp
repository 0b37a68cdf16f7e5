#include "streets/delaunay_edges.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

namespace plat::streets {
namespace {

// EPICK: nothing is constructed, and its predicates are exact.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

}  // namespace

std::vector<DelaunayEdge> delaunay_edges(std::span<const Point> places) {
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> points;
  points.reserve(places.size());
  for (std::uint32_t i = 0; i < places.size(); ++i)
    points.emplace_back(Kernel::Point_2(places[i].x, places[i].y), i);
  const Delaunay triangulation(points.begin(), points.end());
  std::vector<DelaunayEdge> out;
  for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end();
       ++edge) {
    const auto [face, index] = *edge;
    const std::uint32_t a = face->vertex(Delaunay::ccw(index))->info();
    const std::uint32_t b = face->vertex(Delaunay::cw(index))->info();
    out.push_back({std::min(a, b), std::max(a, b)});
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace plat::streets
