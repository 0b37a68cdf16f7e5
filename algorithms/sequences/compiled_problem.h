#pragma once

#include <cstdint>
#include <vector>

#include "sequences/search_graph.h"
#include "sequences/sequence_path.h"
#include "sequences/sequence_problem.h"

namespace plat::sequences {

/// Where an element stands in the structure.
struct Placement {
  enum class Place : std::uint8_t { kSegment, kKeyPoint };
  ElementIndex element = 0;
  Place place = Place::kSegment;
  std::uint32_t index = 0;  ///< of the segment or the key point
  friend bool operator==(const Placement&, const Placement&) = default;
};

/// What one dimension of the search graph counts.
struct DimensionMeaning {
  std::uint32_t resource = 0;
  bool is_local = false;  ///< per segment rather than over the whole
};

/// A problem as a search graph, with what its nodes stand for.
struct CompiledProblem {
  SearchGraph graph;
  std::vector<DimensionMeaning> dimensions;
  /// By node: what it places, or nothing at the virtual duplicates of [Har, Fig. 3.4, 3.5], which
  /// consume nothing.
  std::vector<std::optional<Placement>> placements;
};

/// Compiles a problem: plain sequences to one zone, structures by unrolling (ADR 0017, 0023). Only
/// resources that some bound limits become dimensions.
///
/// Guarantees: 1. `validate` holds for the graph;  2. the paths of the graph are one to one the
/// arrangements of the problem, with the same costs.
/// @throws InputError for a problem that makes no sense: an index out of range, a key point with
///         more than three segments, bounds that are not min <= max, a circle without a cost
CompiledProblem compile(const SequenceProblem& problem);

/// One arrangement, as a user reads it: the elements in the order of the path.
struct Arrangement {
  Cost cost = 0;
  std::vector<Placement> placements;
  std::vector<std::int64_t> consumed;  ///< by resource, over the whole
};

/// What a path of the compiled graph places.
Arrangement arrangement(const CompiledProblem& compiled, const SequenceProblem& problem,
                        const SequencePath& path);

}  // namespace plat::sequences
