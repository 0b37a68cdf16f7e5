#include "streets/network_measures.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "streets/network_faces.h"

namespace plat::streets {
namespace {

constexpr double kSquareMetresPerSquareKilometre = 1e6;

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::optional<double> mean_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return sum_of(values) / static_cast<double>(values.size());
}

std::optional<double> per_km2(double amount, const NetworkMeasures& m) {
  if (!(m.land_area_m2 > 0.0)) return std::nullopt;
  return amount / m.land_area_m2 * kSquareMetresPerSquareKilometre;
}

std::optional<double> count_per_km2(std::size_t count, const NetworkMeasures& m) {
  return per_km2(static_cast<double>(count), m);
}

void add_graph_measures(NetworkMeasures& out) {
  const NetworkGraph& graph = out.graph;
  for (const std::uint32_t degree : node_degrees(graph)) {
    out.node_degree.push_back(degree);
    if (degree == 1) ++out.dead_ends;
    if (degree > 2) ++out.intersections;
  }
  for (const NetworkGraph::Edge& edge : graph.edges) out.edge_length_m.push_back(edge.length_m);
  out.circuity = circuity(graph);
  out.orientation_entropy_nats = orientation_entropy(graph, BearingWeight::kEdge);
  out.orientation_entropy_length_nats = orientation_entropy(graph, BearingWeight::kLength);
}

void add_face_measures(const StreetNetwork& network, NetworkMeasures& out) {
  for (const FaceShape& face : measure_faces(network)) {
    out.block_area_m2.push_back(face.area_m2);
    out.block_perimeter_m.push_back(face.perimeter_m);
    out.block_aspect_ratio.push_back(face.aspect_ratio);
    out.block_rectangularity.push_back(face.rectangularity);
  }
}

}  // namespace

NetworkMeasures measure_network(const StreetNetwork& network, const NetworkMeasureOptions& options,
                                Rng& rng) {
  NetworkMeasures out;
  out.graph = network_graph(network);
  add_graph_measures(out);
  add_face_measures(network, out);
  out.land_area_m2 = options.land_area_m2.value_or(sum_of(out.block_area_m2));
  out.streets = chains_of(network, options.chains).size();
  out.routes = measure_routes(out.graph, options.routes, rng);
  for (const Route& route : out.routes.routes) out.transport_ratio.push_back(route.ratio());
  return out;
}

std::span<const NetworkSample> network_samples() {
  using M = const NetworkMeasures&;
  using Values = const std::vector<double>&;
  static constexpr std::array kSamples{
      NetworkSample{"node_degree", "", "node degree", true,
                    [](M m) -> Values { return m.node_degree; }},
      NetworkSample{"edge_length_m", "m", "edge length", false,
                    [](M m) -> Values { return m.edge_length_m; }},
      NetworkSample{"block_area_m2", "m2", "block area", false,
                    [](M m) -> Values { return m.block_area_m2; }},
      NetworkSample{"block_perimeter_m", "m", "block perimeter", false,
                    [](M m) -> Values { return m.block_perimeter_m; }},
      NetworkSample{"block_aspect_ratio", "", "block aspect ratio", false,
                    [](M m) -> Values { return m.block_aspect_ratio; }},
      NetworkSample{"block_rectangularity", "", "block rectangularity", false,
                    [](M m) -> Values { return m.block_rectangularity; }},
      NetworkSample{"transport_ratio", "", "transport ratio", false,
                    [](M m) -> Values { return m.transport_ratio; }},
      NetworkSample{"betweenness", "", "betweenness", false,
                    [](M m) -> Values { return m.routes.betweenness; }},
  };
  return kSamples;
}

std::span<const NetworkScalar> network_scalars() {
  using M = const NetworkMeasures&;
  using Value = std::optional<double>;
  static constexpr std::array kScalars{
      NetworkScalar{"land_area_km2", "km2", "land",
                    [](M m) -> Value { return m.land_area_m2 / kSquareMetresPerSquareKilometre; }},
      NetworkScalar{"nodes", "", "nodes",
                    [](M m) -> Value { return static_cast<double>(m.node_degree.size()); }},
      NetworkScalar{"edges", "", "edges",
                    [](M m) -> Value { return static_cast<double>(m.edge_length_m.size()); }},
      NetworkScalar{"blocks", "", "blocks",
                    [](M m) -> Value { return static_cast<double>(m.block_area_m2.size()); }},
      NetworkScalar{"length_m", "m", "length of all streets",
                    [](M m) -> Value { return sum_of(m.edge_length_m); }},
      NetworkScalar{"mean_degree", "", "mean node degree",
                    [](M m) -> Value { return mean_of(m.node_degree); }},
      NetworkScalar{"mean_edge_length_m", "m", "mean edge length",
                    [](M m) -> Value { return mean_of(m.edge_length_m); }},
      NetworkScalar{"dead_end_share_01", "", "share of dead ends",
                    [](M m) -> Value {
                      if (m.node_degree.empty()) return std::nullopt;
                      return static_cast<double>(m.dead_ends) /
                             static_cast<double>(m.node_degree.size());
                    }},
      NetworkScalar{"intersections_per_km2", "1/km2", "intersections per km2",
                    [](M m) { return count_per_km2(m.intersections, m); }},
      NetworkScalar{"edges_per_km2", "1/km2", "edges per km2",
                    [](M m) { return count_per_km2(m.edge_length_m.size(), m); }},
      NetworkScalar{"streets_per_km2", "1/km2", "streets per km2",
                    [](M m) { return count_per_km2(m.streets, m); }},
      NetworkScalar{"blocks_per_km2", "1/km2", "blocks per km2",
                    [](M m) { return count_per_km2(m.block_area_m2.size(), m); }},
      NetworkScalar{"length_km_per_km2", "km/km2", "length of streets per km2",
                    [](M m) { return per_km2(sum_of(m.edge_length_m) / 1000.0, m); }},
      NetworkScalar{"circuity", "", "circuity",
                    [](M m) -> Value {
                      if (!(m.circuity > 0.0)) return std::nullopt;
                      return m.circuity;
                    }},
      NetworkScalar{"orientation_entropy_nats", "nats", "orientation entropy",
                    [](M m) -> Value { return m.orientation_entropy_nats; }},
      NetworkScalar{"orientation_entropy_length_nats", "nats", "orientation entropy by length",
                    [](M m) -> Value { return m.orientation_entropy_length_nats; }},
      NetworkScalar{"mean_transport_ratio", "", "mean transport ratio",
                    [](M m) -> Value { return mean_of(m.transport_ratio); }},
      NetworkScalar{"unreachable_01", "", "share of pairs that no way connects",
                    [](M m) -> Value {
                      const std::size_t pairs = m.routes.unreachable + m.transport_ratio.size();
                      if (pairs == 0) return std::nullopt;
                      return static_cast<double>(m.routes.unreachable) / static_cast<double>(pairs);
                    }},
      NetworkScalar{"mean_betweenness", "", "mean betweenness",
                    [](M m) -> Value { return mean_of(m.routes.betweenness); }},
      NetworkScalar{"max_betweenness", "", "largest betweenness",
                    [](M m) -> Value {
                      if (m.routes.betweenness.empty()) return std::nullopt;
                      return *std::max_element(m.routes.betweenness.begin(),
                                               m.routes.betweenness.end());
                    }},
  };
  return kScalars;
}

}  // namespace plat::streets
