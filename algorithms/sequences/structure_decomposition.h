#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sequences/sequence_problem.h"

namespace plat::sequences {

/// A segment and the end at which it is entered.
struct DirectedSegment {
  std::uint32_t segment = 0;
  bool is_forward = true;  ///< walked from `from` to `to`
  friend bool operator==(const DirectedSegment&, const DirectedSegment&) = default;
};

/// One of the hierarchical set of structures of [Har, Fig. 3.3]: segments that follow one another.
struct StructurePath {
  std::vector<DirectedSegment> segments;
  std::optional<std::uint32_t> start;   ///< key point where it begins; none: at a free end
  std::optional<std::uint32_t> parent;  ///< the path that it branches off at `start`
};

/// Takes a structure apart into paths: the primary structure first, each child after its parent.
///
/// Guarantees: 1. every segment lies on exactly one path;  2. without a cycle, no path between two
/// ends of the structure is longer than the primary one;  3. with a cycle, the primary path is the
/// longest one that ends where it begins, split where the fewest copies are made;  4. a path ends
/// at an end of the structure, or where it meets a path that was there before, or itself.
/// A path is longer where the minima of its segments' first resource sum to more, then where it has
/// more segments, then where it was found first.
/// @throws InputError for more than `kMostCycles` independent cycles
/// Paper:     [Har, Sec. 3.3.4, Fig. 3.3, 3.5]
/// Deviation: "longest" is said of the primary resource; the split is chosen (ADR 0023)
std::vector<StructurePath> decompose(const Structure& structure);
inline constexpr std::size_t kMostCycles = 6;

/// A segment as the one path through the whole structure meets it.
struct Visit {
  DirectedSegment directed;
  std::optional<std::uint32_t> start;  ///< the key point that is left
  std::optional<std::uint32_t> end;    ///< the key point that is arrived at
  bool is_end_placed = false;          ///< the end has its element already: a cycle is closed
  /// The key points whose element must be the same before and after this segment, ascending: each
  /// choice of their elements is a context, and gets a copy of the segment.
  std::vector<std::uint32_t> remembered;
};

/// The order in which one path meets all segments: a child is walked when its branching element has
/// been placed, then the parent goes on [Har, Fig. 3.4].
std::vector<Visit> visit_order(const Structure& structure, const std::vector<StructurePath>& paths);

/// How often segments are copied in all, each once per context.
double copy_count(const Structure& structure, const std::vector<Visit>& visits);

}  // namespace plat::sequences
