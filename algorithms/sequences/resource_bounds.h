#pragma once

#include <limits>
#include <span>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// The cost where there is no way.
inline constexpr Cost kNoWay = std::numeric_limits<Cost>::max();

/// What paths can have consumed and paid at each node of a search graph, and what they may have so
/// that they still end well. Each dimension is looked at for itself and amounts are as a zone
/// remembers them (`add_amount`): the bounds are those of a relaxation, and safe.
///
/// Rows are nodes x dimensions, and amounts hold the node's own uses. A dimension that a later zone
/// resets only looks ahead to the reset, and back to the last one.
///
/// Guarantees: 1. a path from an entry that has kept all maxima has consumed between `least` and
/// `most` at each of its nodes;  2. one that goes on to an exit and keeps all bounds has consumed
/// between `floor` and `ceiling` there;  3. it has paid `cost_from_entry` at least, and will pay
/// `cost_to_exit` at least;  4. costs are attained where resources are not looked at.
struct ResourceBounds {
  std::uint32_t dimension_count = 0;
  std::vector<Amount> least;          ///< kUnbounded where no path from an entry comes
  std::vector<Amount> most;           ///< -1 where none comes; the largest amount after a circle
  std::vector<Amount> floor;          ///< kUnbounded where no exit can be reached
  std::vector<Amount> ceiling;        ///< -1 where none can be reached; kUnbounded: no maximum
  std::vector<Cost> cost_from_entry;  ///< by node; kNoWay: none
  std::vector<Cost> cost_to_exit;     ///< by node, with the exit's cost; kNoWay: none

  /// Whether a path that has consumed this much at `node` may still end, as far as the bounds tell.
  [[nodiscard]] bool may_end(std::uint32_t node, std::span<const Amount> consumed) const;
};

/// Complexity: O(d (m log n)) for n nodes, m arcs and links, d dimensions
ResourceBounds resource_bounds(const SearchGraph& graph);

}  // namespace plat::sequences
