#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/rng.h"
#include "streets/network_graph.h"

namespace plat::streets {

struct RouteOptions {
  int sources = 100;
  int targets = 10;
  static constexpr auto fields() {
    return std::tuple{Field{"sources", &RouteOptions::sources, 1, 1000000,
                            "Nodes drawn as starts of routes and pivots of betweenness; all where "
                            "a network has fewer."},
                      Field{"targets", &RouteOptions::targets, 1, 1000000,
                            "Nodes drawn as ends of routes, for each source."}};
  }
};

/// A shortest way between two nodes.
struct Route {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  double network_m = 0.0;   ///< along the streets
  double straight_m = 0.0;  ///< through the air

  [[nodiscard]] double ratio() const { return network_m / straight_m; }
};

/// What shortest ways say of a network.
struct RouteMeasures {
  std::vector<std::uint32_t> sources;  ///< the nodes drawn, ascending
  std::vector<Route> routes;           ///< by source, then as drawn
  std::size_t unreachable = 0;         ///< pairs drawn that no way connects
  /// Per node: the share of shortest ways between other nodes that pass through it [Bra01], over
  /// the n (n-1) / 2 pairs less those that end in it. Taken from the drawn sources as pivots and
  /// scaled by n / sources [BP07]: exact where all nodes are sources.
  std::vector<double> betweenness;
};

/// Shortest ways by length, everything drawn from `rng`. Where edges join the same two nodes the
/// shortest counts, edges from a node to itself never. Of equally long ways all count.
///
/// Guarantees: 1. the same graph and stream give the same result;  2. betweenness from all nodes is
/// networkx' betweenness_centrality with weights, normalised.
/// Complexity: O(sources n log n).
RouteMeasures measure_routes(const NetworkGraph& graph, const RouteOptions& options, Rng& rng);

}  // namespace plat::streets
