#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// The strongly connected components of a table: within one, each node can be reached from each.
///
/// Guarantees: 1. every node is in one component;  2. arcs between components lead to one of lower
/// index.
struct StrongComponents {
  std::vector<std::uint32_t> of_node;  ///< by node: its component
  std::vector<std::uint32_t> first;    ///< components + 1 offsets into `members`
  std::vector<std::uint32_t> members;

  [[nodiscard]] std::size_t count() const { return first.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> nodes(std::size_t component) const {
    return std::span(members).subspan(first[component], first[component + 1] - first[component]);
  }
};

/// Complexity: O(n + m)
StrongComponents strong_components(const TransitionTable& table);

}  // namespace plat::sequences
