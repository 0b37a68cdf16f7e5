#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "streets/street_network.h"

namespace plat::streets {

/// A street network as a graph: what network measures count.
///
/// Its nodes are the places where the network's streets do not just go on: a dead end has degree 1,
/// an intersection 3 or more. Places where two street ends meet, because an attribute changes or a
/// street bends, are no nodes: the streets that meet there are one edge.
struct NetworkGraph {
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;  ///< >= from; may be `from`, or joined with it by several edges
    double length_m = 0.0;
    std::vector<std::uint32_t> streets;  ///< of the network, from end to end
  };

  std::vector<Point> nodes;  ///< sorted
  std::vector<Edge> edges;
};

/// The graph of a network; `kept` places stay nodes whatever meets there.
///
/// Guarantees: 1. every street is in exactly one edge;  2. every node is an end of an edge and has
/// another degree than 2, but for kept places and for one node of each ring that has no other: its
/// first;  3. splitting a street of the network in two leaves the graph as it is, up to rounding of
/// lengths.  Complexity: O(n log n).
NetworkGraph network_graph(const StreetNetwork& network, std::span<const Point> kept = {});

/// How many edge ends meet at each node: an edge from a node to itself has two there.
std::vector<std::uint32_t> node_degrees(const NetworkGraph& graph);

/// Sum of the lengths of the edges by the sum of the straight distances between their ends, as
/// osmnx's circuity_avg; edges from a node to itself are in the first sum only. 0 where the second
/// is 0.
double circuity(const NetworkGraph& graph);

enum class BearingWeight {
  kEdge,    ///< every edge counts once [Boe19]
  kLength,  ///< every edge counts by its length
};

/// Entropy of the compass bearings of the edges, nats: each edge counts in its bin and in the
/// opposite one, in 36 bins of 10 degrees of which the first holds -5 <= bearing < 5 degrees. From
/// log 2 for a single straight street and log 4 for a grid to log 36. A bearing is that of the
/// straight line between an edge's ends; north is the y axis. Edges from a node to itself have none
/// and are left out; 0 where no others are.
/// Paper: [Boe19, Sec. 2.3]
double orientation_entropy(const NetworkGraph& graph, BearingWeight weight);

}  // namespace plat::streets
