#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sequences/sequence_database.h"

namespace plat::sequences {

/// A place that one element of a class must take [Har, Sec. 3.3.4].
struct KeyPoint {
  std::string name;
  std::vector<ElementIndex> allowed;  ///< ascending, not empty
};

/// A row of elements between two key points, or between a key point and a free end. The elements at
/// its key points are not part of the row; they count towards its bounds with their arm at the
/// port that faces it.
struct Segment {
  std::string name;
  /// The key points at its ends; none: the end is free, and an element that `is_front` or `is_back`
  /// takes it (at a reversed segment the other way round).
  std::optional<std::uint32_t> from;
  std::optional<std::uint32_t> to;
  Port from_port = Port::kRight;  ///< the port of the key element at `from` that faces the segment
  Port to_port = Port::kLeft;     ///< the port of the key element at `to` that faces the segment
  /// Elements stand with their front on the other side: from `from` to `to` they are met from right
  /// to left.
  bool is_reversed = false;
  std::vector<Bounds> bounds;  ///< by resource, on this segment alone
  /// Whether the key elements at the two ends may touch, with no element between them. A segment
  /// with a free end always has an element.
  bool may_be_empty = true;
};

/// What is to be filled [Har, Sec. 3.3.4, Fig. 3.2]: a connected graph of key points (one segment
/// at most at each of their three ports) and segments; a segment may lead from a key point back to
/// it. A single segment with free ends is a plain sequence.
struct Structure {
  std::vector<KeyPoint> key_points;
  std::vector<Segment> segments;
};

/// Find the k cheapest arrangements that keep all bounds [Har, Eq. 3.2].
struct SequenceProblem {
  SequenceDatabase database;
  std::vector<Bounds> bounds;  ///< by resource, on the whole; every element counts once with `uses`
  Structure structure;
};

/// A plain sequence over `database`: one segment with free ends.
SequenceProblem plain_sequence(SequenceDatabase database, std::vector<Bounds> bounds);

}  // namespace plat::sequences
