#include "sequences/adjacency.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace plat::sequences {
namespace {

std::size_t slot_of(ElementIndex tail, Port tail_port, Port head_port) {
  return (tail * kPortCount + static_cast<std::size_t>(tail_port)) * kPortCount +
         static_cast<std::size_t>(head_port);
}

}  // namespace

Adjacency::Adjacency(const SequenceDatabase& database)
    : first_(database.elements.size() * kPortCount * kPortCount + 1, 0) {
  neighbours_.reserve(database.transitions.size() * 2);
  for (std::uint32_t t = 0; t < database.transitions.size(); ++t) {
    const Transition& stored = database.transitions[t];
    neighbours_.push_back({stored.from, stored.to, stored.from_port, stored.to_port, t});
    if (stored.from == stored.to && stored.from_port == stored.to_port) continue;
    neighbours_.push_back({stored.to, stored.from, stored.to_port, stored.from_port, t});
  }
  std::ranges::sort(neighbours_, {}, [](const Neighbour& n) {
    return std::tuple(slot_of(n.tail, n.tail_port, n.head_port), n.head, n.transition);
  });
  for (const Neighbour& n : neighbours_) ++first_[slot_of(n.tail, n.tail_port, n.head_port) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
}

std::span<const Neighbour> Adjacency::of(ElementIndex tail, Port tail_port, Port head_port) const {
  const std::size_t slot = slot_of(tail, tail_port, head_port);
  return {neighbours_.data() + first_[slot], neighbours_.data() + first_[slot + 1]};
}

}  // namespace plat::sequences
