#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sequences/sequence_database.h"

namespace plat::sequences {

/// Two elements that may touch, seen from `tail`.
struct Neighbour {
  ElementIndex tail = 0;
  ElementIndex head = 0;
  Port tail_port = Port::kRight;
  Port head_port = Port::kLeft;
  std::uint32_t transition = 0;  ///< index into `SequenceDatabase::transitions`
};

/// The transitions of a database, found from both of their elements.
///
/// Guarantees: 1. a transition is found once from each of its two ends, in whichever order it names
/// them.
class Adjacency {
 public:
  explicit Adjacency(const SequenceDatabase& database);
  /// What touches `tail_port` of `tail` with its `head_port`, by (head, transition).
  [[nodiscard]] std::span<const Neighbour> of(ElementIndex tail, Port tail_port,
                                              Port head_port) const;

 private:
  std::vector<Neighbour> neighbours_;
  std::vector<std::size_t> first_;  // by (tail, tail port, head port), one more at the end
};

}  // namespace plat::sequences
