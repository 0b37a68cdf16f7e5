#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/planar_graph.h"
#include "streets/growth_plane.h"
#include "streets/street_width.h"

namespace plat::streets {
namespace {

/// A part of a grown edge that becomes a street.
struct Piece {
  std::uint32_t edge = 0;
  Polyline line;
};

Polyline line_of(const GrowthPlane& plane, const GrownEdge& edge) {
  if (!edge.line.empty()) return edge.line;
  return {plane.vertices()[edge.from], plane.vertices()[edge.to]};
}

std::vector<Piece> whole_edges(const GrowthPlane& plane, std::span<const GrownEdge> edges) {
  std::vector<Piece> pieces;
  for (std::uint32_t e = 0; e < edges.size(); ++e) pieces.push_back({e, line_of(plane, edges[e])});
  return pieces;
}

/// The edges cut where they cross, in their order and running as they do.
std::vector<Piece> noded_edges(const GrowthPlane& plane, std::span<const GrownEdge> edges) {
  std::vector<Segment> segments;
  std::vector<std::uint32_t> edge_of_segment;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const Polyline line = line_of(plane, edges[e]);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      segments.push_back({line[i], line[i + 1]});
      edge_of_segment.push_back(e);
    }
  }
  const PlanarGraph graph = node_segments(segments);

  // Nodes of the network: vertices, and where different edges meet.
  std::vector<std::uint32_t> first_edge(graph.nodes.size(), 0);
  std::vector<bool> is_met(graph.nodes.size(), false);
  std::vector<bool> is_node(graph.nodes.size(), false);
  const auto meets = [&](std::uint32_t node, std::uint32_t edge) {
    if (is_met[node] && first_edge[node] != edge) is_node[node] = true;
    is_met[node] = true;
    first_edge[node] = edge;
  };
  for (const PlanarGraph::Edge& part : graph.edges) {
    meets(part.from, edge_of_segment[part.source]);
    meets(part.to, edge_of_segment[part.source]);
  }
  for (const Point p : plane.vertices()) {
    const auto it = std::lower_bound(graph.nodes.begin(), graph.nodes.end(), p);
    if (it != graph.nodes.end() && *it == p)
      is_node[static_cast<std::size_t>(it - graph.nodes.begin())] = true;
  }

  std::vector<std::uint32_t> order(graph.edges.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto along = [&](std::uint32_t i) {
    const PlanarGraph::Edge& part = graph.edges[i];
    const Segment& whole = segments[part.source];
    return std::pair(part.source, dot(graph.nodes[part.from] - whole.a, whole.b - whole.a));
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t k) { return along(i) < along(k); });

  std::vector<Piece> pieces;
  std::uint32_t end = 0;  // node at which the last piece ends
  for (const std::uint32_t i : order) {
    const PlanarGraph::Edge& part = graph.edges[i];
    const std::uint32_t edge = edge_of_segment[part.source];
    const bool goes_on =
        !pieces.empty() && pieces.back().edge == edge && end == part.from && !is_node[part.from];
    if (!goes_on) pieces.push_back({edge, {graph.nodes[part.from]}});
    pieces.back().line.push_back(graph.nodes[part.to]);
    end = part.to;
  }
  return pieces;
}

/// The network's nodes: the existing ones and the ends of the pieces, sorted; and the new number
/// of each existing one.
std::vector<std::uint32_t> number_nodes(const StreetNetwork& existing,
                                        std::span<const Piece> pieces, std::vector<Point>& nodes) {
  std::vector<std::pair<Point, std::uint32_t>> all;
  const auto kept = static_cast<std::uint32_t>(existing.nodes.size());
  for (std::uint32_t i = 0; i < kept; ++i) all.emplace_back(existing.nodes[i], i);
  for (const Piece& piece : pieces) {
    all.emplace_back(piece.line.front(), kept);
    all.emplace_back(piece.line.back(), kept);
  }
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> number(kept, 0);
  for (const auto& [place, old] : all) {
    // Existing nodes come before the ends of pieces at their place.
    if (old == kept && !nodes.empty() && nodes.back() == place) continue;
    if (old < kept) number[old] = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(place);
  }
  return number;
}

std::vector<std::uint32_t> left_alone(const GrowthSite& site, const GrowthPlane& plane,
                                      std::span<const GrownEdge> edges) {
  std::vector<bool> is_reached(plane.vertices().size(), false);
  for (const GrownEdge& edge : edges) is_reached[edge.from] = is_reached[edge.to] = true;
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < site.points.size(); ++i) {
    if (!is_reached[plane.vertex_of_point(i)]) out.push_back(i);
  }
  return out;
}

}  // namespace

Growth assemble_growth(const GrowthSite& site, const GrowthPlane& plane,
                       std::span<const GrownEdge> edges) {
  const std::vector<Piece> pieces =
      plane.has_crossings() ? noded_edges(plane, edges) : whole_edges(plane, edges);
  Growth growth;
  StreetNetwork& network = growth.network;
  const std::vector<std::uint32_t> number = number_nodes(site.existing, pieces, network.nodes);
  const auto node_at = [&](Point p) {
    return static_cast<std::uint32_t>(
        std::lower_bound(network.nodes.begin(), network.nodes.end(), p) - network.nodes.begin());
  };
  network.streets = site.existing.streets;
  for (Street& street : network.streets) {
    street.from = number[street.from];
    street.to = number[street.to];
  }
  for (const Piece& piece : pieces) {
    const GrownEdge& edge = edges[piece.edge];
    Street street;
    street.id = StreetId{static_cast<std::uint32_t>(network.streets.size())};
    street.from = node_at(piece.line.front());
    street.to = node_at(piece.line.back());
    street.line = piece.line;
    const bool has_width = edge.width_m > 0.0 && std::isfinite(edge.width_m);
    street.width_m = has_width ? edge.width_m : WidthOptions{}.default_width_m;
    street.width_source = has_width ? WidthSource::kExample : WidthSource::kAssumed;
    network.streets.push_back(std::move(street));
    growth.segments.push_back(edge.segment);
  }
  growth.left_alone = left_alone(site, plane, edges);
  return growth;
}

}  // namespace plat::streets
