#include "buildings/joint_surface.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "core/failure.h"
#include "core/planar_graph.h"
#include "core/working_grid.h"

namespace plat::buildings {
namespace {

// Predicates are exact and nothing is constructed: the rims are noded before they are triangulated.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

/// The pieces of each rim edge, by edge of the noded graph.
std::vector<std::vector<std::uint32_t>> pieces_of(const PlanarGraph& graph, std::size_t count) {
  std::vector<std::vector<std::uint32_t>> out(count);
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) out[graph.edges[e].source].push_back(e);
  for (const auto& [edge, source] : graph.overlaps) out[source].push_back(edge);
  return out;
}

/// The nodes of a rim edge in order, walked piece by piece from its start.
std::vector<std::uint32_t> walk_pieces(const PlanarGraph& graph, std::vector<std::uint32_t> pieces,
                                       Point start) {
  std::vector<std::uint32_t> walk;
  const auto at = std::ranges::lower_bound(graph.nodes, snap(start));
  expects(at != graph.nodes.end() && *at == snap(start), "the end of a rim edge is a node");
  walk.push_back(static_cast<std::uint32_t>(at - graph.nodes.begin()));
  while (!pieces.empty()) {
    const auto next = std::ranges::find_if(pieces, [&](std::uint32_t e) {
      return graph.edges[e].from == walk.back() || graph.edges[e].to == walk.back();
    });
    expects(next != pieces.end(), "the pieces of a rim edge hang together");
    const PlanarGraph::Edge& edge = graph.edges[*next];
    walk.push_back(edge.from == walk.back() ? edge.to : edge.from);
    pieces.erase(next);
  }
  return walk;
}

/// A corner in grid units, tripled: the middle of a triangle is then a whole number, too.
struct TripledPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
};
TripledPoint tripled(Point p) { return {3 * to_grid(p.x), 3 * to_grid(p.y)}; }

/// How often the rims go round a point, counter-clockwise positive; exact.
int winding(const PlanarGraph& graph, const std::vector<int>& uses, TripledPoint p) {
  int winding = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const TripledPoint a = tripled(graph.nodes[graph.edges[e].from]);
    const TripledPoint b = tripled(graph.nodes[graph.edges[e].to]);
    const std::int64_t side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (a.y <= p.y && p.y < b.y && side > 0) winding += uses[e];
    if (b.y <= p.y && p.y < a.y && side < 0) winding -= uses[e];
  }
  return winding;
}

void add_walls(const PlanarGraph& graph, const std::vector<int>& uses, JointSurface& out) {
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> handles;
  for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
    handles.push_back(triangulation.insert({graph.nodes[n].x, graph.nodes[n].y}));
    handles.back()->info() = n;
  }
  for (const PlanarGraph::Edge& edge : graph.edges)
    triangulation.insert_constraint(handles[edge.from], handles[edge.to]);
  for (const auto face : triangulation.finite_face_handles()) {
    JointSurface::Wall wall;
    TripledPoint middle;
    for (std::size_t i = 0; i < 3; ++i) {
      wall.corners[i] = graph.nodes[face->vertex(static_cast<int>(i))->info()];
      middle.x += to_grid(wall.corners[i].x);
      middle.y += to_grid(wall.corners[i].y);
    }
    // What remains of a solid before the plane walks round its section clockwise.
    const int excess = winding(graph, uses, middle);
    wall.is_outward = excess < 0;
    out.walls.insert(out.walls.end(), static_cast<std::size_t>(std::abs(excess)), wall);
  }
}

}  // namespace

JointSurface joint_surface(std::span<const Segment> rim) {
  const PlanarGraph graph = node_segments(rim);
  const auto pieces = pieces_of(graph, rim.size());
  JointSurface out;
  std::vector<int> uses(graph.edges.size(), 0);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    if (snap(rim[i].a) == snap(rim[i].b)) {
      out.chains.push_back({snap(rim[i].a)});
      continue;
    }
    const auto walk = walk_pieces(graph, pieces[i], rim[i].a);
    auto& chain = out.chains.emplace_back();
    for (const std::uint32_t node : walk) chain.push_back(graph.nodes[node]);
    for (const std::uint32_t e : pieces[i]) {
      const auto from = std::ranges::find(walk, graph.edges[e].from);
      const bool is_along = from + 1 != walk.end() && *(from + 1) == graph.edges[e].to;
      uses[e] += is_along ? 1 : -1;
    }
  }
  if (std::ranges::any_of(uses, [](int count) { return count != 0; })) add_walls(graph, uses, out);
  return out;
}

}  // namespace plat::buildings
