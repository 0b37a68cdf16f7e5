#pragma once

#include <cstdint>
#include <vector>

#include "core/failure.h"
#include "sequences/intermediate_graph_growth.h"
#include "sequences/search_graph.h"

namespace plat::sequences {

/// A state of an intermediate graph, written out.
struct GrownState {
  std::uint32_t node = 0;        ///< of the search graph
  std::vector<Amount> consumed;  ///< by dimension, its own included
  std::int64_t level = 0;        ///< consumed before it, summed over the dimensions: l of [Har]
  bool is_from_front = false;    ///< reached from an entry
  bool is_from_end = false;      ///< reached from an exit
  bool is_alive = false;         ///< on a feasible path; else a dead end that pruning takes away
  bool is_entry = false;         ///< a path may begin with it
  bool is_exit = false;          ///< a path may end with it
};

/// An intermediate graph with all its arcs and its dead ends, for pictures of small problems: the
/// strategy itself stores no arc.
struct GrownGraph {
  struct Arc {
    std::uint32_t from = 0;  ///< index into `states`
    std::uint32_t to = 0;
    Cost cost = 0;
  };
  std::vector<GrownState> states;  ///< topologically
  std::vector<Arc> arcs;           ///< by tail; between any two states, dead ends too
};

/// Grows the intermediate graph of a search graph as the strategy does, and writes it out.
///
/// Guarantees: 1. the states that are alive are those of `IntermediateGraph`;  2. paths of arcs
/// from an entry to an exit are the feasible paths.
/// @returns Failure kTooManyStates beyond `limits`
Expected<GrownGraph> grown_graph(const SearchGraph& graph, const GrowthLimits& limits);

}  // namespace plat::sequences
