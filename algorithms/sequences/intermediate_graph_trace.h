#pragma once

#include <cstdint>
#include <vector>

#include "core/failure.h"
#include "sequences/intermediate_graph_growth.h"
#include "sequences/search_graph.h"

namespace plat::sequences {

/// A state as growth left it.
struct TracedState {
  /// From which end the state was created; both where the two sides met.
  enum class Side : std::uint8_t { kFront, kBack, kBoth };
  std::uint32_t node = 0;        ///< of the search graph
  std::int64_t level = 0;        ///< what was consumed before it, summed over the dimensions
  std::vector<Amount> consumed;  ///< its own uses included
  Side side = Side::kFront;
  bool is_entry = false;
  bool is_exit = false;
  bool is_pruned = false;  ///< a dead end
};

struct TracedArc {
  std::uint32_t from = 0;  ///< index of a state
  std::uint32_t to = 0;
  Cost cost = 0;
};

/// An intermediate graph with its dead ends, to be looked at.
struct IntermediateGraphTrace {
  std::vector<TracedState> states;  ///< by zone, then consumed vector, then node
  std::vector<TracedArc> arcs;      ///< among them, by (from, as in the table), links last
};

/// Grows the graph of a small problem and keeps everything [Har, Fig. 3.1].
///
/// Guarantees: 1. the states that are not pruned are those of `IntermediateGraph`;  2. every arc
/// between two created states is there.
/// @returns Failure kTooManyStates beyond the limits
Expected<IntermediateGraphTrace> trace_intermediate_graph(const SearchGraph& graph,
                                                          const GrowthLimits& limits = {});

}  // namespace plat::sequences
