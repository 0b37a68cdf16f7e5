#pragma once

#include <compare>
#include <cstdint>
#include <set>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::testing {

/// N(e, l, rc) of [Har, Sec. 3.3.1].
struct ThesisNode {
  std::uint32_t element = 0;
  std::int64_t level = 0;
  std::vector<sequences::Amount> consumed;
  friend auto operator<=>(const ThesisNode&, const ThesisNode&) = default;
};

/// How the text is read where it can be read in several ways.
struct ThesisReading {
  /// What Q_b is ordered by: the consumption up to the element, its own included, or before it.
  enum class BackwardOrder : std::uint8_t { kConsumed, kConsumedBefore };
  /// What the two sides are compared by, to stop and in l_succ <= l_ts: sums, or whole vectors.
  enum class Meeting : std::uint8_t { kLevels, kVectors };
  /// What a step expands: "only nodes that were created from the particular expansion step", or
  /// also those that the other step was at before.
  enum class Expansion : std::uint8_t { kOwnDirection, kBothDirections };
  BackwardOrder backward_order = BackwardOrder::kConsumedBefore;
  Meeting meeting = Meeting::kVectors;
  Expansion expansion = Expansion::kBothDirections;
};

/// What the construction leaves.
struct ThesisGraph {
  std::size_t created = 0;
  std::set<ThesisNode> nodes;  ///< after dead-end pruning
};

/// The construction of [Har, Function 1] and its backward twin, with maps and sets, one level at a
/// time, then dead-end pruning. For one zone, arcs without uses and maxima everywhere.
ThesisGraph thesis_construction(const sequences::SearchGraph& graph,
                                const ThesisReading& reading = {});

/// The same set from its definition: what lies on a feasible sequence.
std::set<ThesisNode> nodes_on_feasible_paths(const sequences::SearchGraph& graph);

}  // namespace plat::testing
