#pragma once

#include <cstdint>
#include <vector>

#include "sequences/intermediate_graph.h"
#include "sequences/k_shortest_walks.h"

namespace plat::sequences {

/// What it costs at least to end from each state, and how many arcs that took.
struct DistancesToEnd {
  std::vector<Cost> cost;  ///< by state, the exit's own cost included
  std::uint64_t arcs_relaxed = 0;
};

/// Shortest paths to the end, from the last group of states to the first; within a group, whose
/// arcs consume nothing and may form circles, by Dijkstra's algorithm.
DistancesToEnd distances_to_end(const IntermediateGraph& graph);

}  // namespace plat::sequences
