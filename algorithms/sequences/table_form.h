#pragma once

#include <cstdint>
#include <vector>

#include "sequences/min_plus.h"
#include "sequences/search_graph.h"

namespace plat::sequences {

/// The arcs of a transition table as the min-plus kernels want them.
template <class Value>
struct TableForm {
  bool is_dense = false;       ///< relaxed as a full matrix, of parallel arcs the cheapest
  std::vector<Value> panels;   ///< if dense, for `product`
  std::vector<Value> columns;  ///< if dense, for `row`
  std::vector<Value> costs;    ///< for `gather`: by arc
  std::vector<std::uint32_t>
      source_of;  ///< for `gather`: by arc its head, or itself if it has uses
  // The arcs by head, to follow them backwards where nothing is consumed.
  std::vector<std::uint32_t> first_in;  ///< n + 1 offsets
  std::vector<std::uint32_t> arc_in;
  std::vector<std::uint32_t> tail_in;

  explicit TableForm(const TransitionTable& table);
};

}  // namespace plat::sequences
