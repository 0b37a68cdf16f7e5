#include "harness/network_report.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace plat::harness {
namespace {

using nlohmann::json;
using streets::NetworkMeasures;

json nodes_of(const NetworkMeasures& measures, Point origin) {
  json out = json::array();
  for (std::size_t v = 0; v < measures.graph.nodes.size(); ++v) {
    const Point place = origin + measures.graph.nodes[v];
    out.push_back({{"x", place.x},
                   {"y", place.y},
                   {"degree", measures.node_degree[v]},
                   {"betweenness", measures.routes.betweenness[v]}});
  }
  return out;
}

json edges_of(const NetworkMeasures& measures) {
  json out = json::array();
  for (const streets::NetworkGraph::Edge& edge : measures.graph.edges)
    out.push_back({{"from", edge.from}, {"to", edge.to}, {"length_m", edge.length_m}});
  return out;
}

json faces_of(const NetworkMeasures& measures) {
  json out = json::array();
  for (std::size_t f = 0; f < measures.block_area_m2.size(); ++f) {
    out.push_back({{"area_m2", measures.block_area_m2[f]},
                   {"perimeter_m", measures.block_perimeter_m[f]},
                   {"aspect_ratio", measures.block_aspect_ratio[f]},
                   {"rectangularity", measures.block_rectangularity[f]}});
  }
  return out;
}

json routes_of(const NetworkMeasures& measures) {
  json out = json::array();
  for (const streets::Route& route : measures.routes.routes) {
    out.push_back({{"from", route.from},
                   {"to", route.to},
                   {"network_m", route.network_m},
                   {"straight_m", route.straight_m}});
  }
  return out;
}

}  // namespace

json network_report(const NetworkMeasures& measures, const geodata::LocalFrame& frame) {
  json out;
  for (const streets::NetworkScalar& scalar : streets::network_scalars()) {
    const std::optional<double> value = scalar.value(measures);
    out["scalars"][std::string(scalar.name)] = value ? json(*value) : json();
  }
  for (const streets::NetworkSample& sample : streets::network_samples())
    out["samples"][std::string(sample.name)] = sample.values(measures);
  out["nodes"] = nodes_of(measures, frame.origin);
  out["edges"] = edges_of(measures);
  out["faces"] = faces_of(measures);
  out["sources"] = measures.routes.sources;
  out["routes"] = routes_of(measures);
  return out;
}

}  // namespace plat::harness
