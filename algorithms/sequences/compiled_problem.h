#pragma once

#include <cstdint>
#include <limits>
#include <optional>
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

/// Of a link that joins two nodes of one element.
inline constexpr std::uint32_t kNoTransition = std::numeric_limits<std::uint32_t>::max();

/// A problem as a search graph, with what its nodes, arcs and links stand for.
struct CompiledProblem {
  SearchGraph graph;
  std::vector<DimensionMeaning> dimensions;
  /// By node: what it places, or nothing at the virtual duplicates of [Har, Fig. 3.4, 3.5], which
  /// do not consume what their element does once more.
  std::vector<std::optional<Placement>> placements;
  std::vector<std::vector<std::uint32_t>> arc_transitions;  ///< by table, then by arc
  std::vector<std::uint32_t> link_transitions;              ///< by link, or `kNoTransition`
  std::vector<bool> is_walked_backwards;     ///< by segment: the path meets `to` before `from`
  std::vector<std::uint32_t> zone_segments;  ///< by zone: the segment that local bounds are of
};

/// Compiles a problem: plain sequences to one zone, structures by unrolling (ADR 0017, 0023). Only
/// resources that some bound limits become dimensions.
///
/// Guarantees: 1. `validate` holds for the graph;  2. the paths of the graph are one to one the
/// arrangements of the problem, with the same costs.
/// @throws InputError for a problem that makes no sense: an index out of range, two segments at one
///         port, bounds that are not min <= max, a circle without a cost; and for a structure that
///         takes too many copies
CompiledProblem compile(const SequenceProblem& problem);

/// One arrangement, as a user reads it.
///
/// Guarantees: 1. each key point is placed once;  2. a segment's elements follow one another, in
/// the order from `from` to `to`;  3. beyond that the order is that of the path.
struct Arrangement {
  Cost cost = 0;
  std::vector<Placement> placements;
  std::vector<std::int64_t> consumed;  ///< by resource, over the whole: elements and transitions
};

/// What a path of the compiled graph places.
Arrangement arrangement(const CompiledProblem& compiled, const SequenceProblem& problem,
                        const SequencePath& path);

/// An arrangement by the parts of its structure.
struct ArrangementByPart {
  std::vector<ElementIndex> key_points;             ///< by key point: its element
  std::vector<std::vector<ElementIndex>> segments;  ///< by segment: from `from` to `to`
};
ArrangementByPart by_part(const Structure& structure, const Arrangement& arrangement);

}  // namespace plat::sequences
