#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// One node of a path and the way in: the index of the entry for the first, of the link where the
/// zone changes, else of the arc in the zone's table.
struct Step {
  std::uint32_t node = 0;
  std::uint32_t arc = 0;
  friend auto operator<=>(const Step&, const Step&) = default;
};

/// A path from an entry to an exit. Two paths are the same where all their steps are: parallel arcs
/// make different paths.
struct SequencePath {
  Cost cost = 0;
  std::vector<Step> steps;
};

/// What a path breaks, in words, or an empty string for one that the graph allows at just this
/// cost. Follows the path step by step and shares no code with the strategies: the tests' judge.
std::string why_not_feasible(const SearchGraph& graph, const SequencePath& path);

}  // namespace plat::sequences
