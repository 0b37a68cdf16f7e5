#pragma once

#include <optional>
#include <vector>

#include "sequences/resource_bounds.h"
#include "sequences/search_graph.h"
#include "sequences/sequence_path.h"

namespace plat::sequences {

/// What is left of a search graph, and where each part of it was.
struct PrunedGraph {
  SearchGraph graph;                             ///< without a zone where no path is left
  ResourceBounds bounds;                         ///< of `graph`
  std::vector<std::uint32_t> nodes;              ///< by node: the node it was
  std::vector<std::vector<std::uint32_t>> arcs;  ///< by table, by arc: the arc it was
  std::vector<std::uint32_t> entries;            ///< by entry: the entry it was
  std::vector<std::uint32_t> links;              ///< by link: the link it was

  /// Rewrites a path of `graph` as one of the graph that was pruned.
  void restore(SequencePath& path) const;
};

/// Takes away the nodes, arcs, links, entries and exits that no feasible path can use, or none that
/// costs `max_cost` at most, as far as `resource_bounds` tells, until nothing more falls away.
///
/// Guarantees: 1. the feasible paths that cost `max_cost` at most are the same, at the same costs;
/// 2. order is kept;  3. pruning again changes nothing;  4. tables that stay as they are stay
/// shared.
/// Paper: [BC89, Sec. 3], for any number of zones and for minima, too
PrunedGraph prune(const SearchGraph& graph, std::optional<Cost> max_cost = std::nullopt);

}  // namespace plat::sequences
