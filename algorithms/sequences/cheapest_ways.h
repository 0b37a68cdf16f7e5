#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sequences/resource_bounds.h"
#include "sequences/state_index.h"

namespace plat::sequences {

/// The costs of the cheapest ways to each state, as many as a search follows.
///
/// Guarantees: 1. a way is refused just where as many ways to its state, none dearer, were admitted
/// before;  2. no more than the limit are taken of one state.
class CheapestWays {
 public:
  static constexpr std::size_t kNoLimit = ~std::size_t{0};

  /// @param limit   of ways to a state; kNoLimit: all are followed, and nothing is kept
  /// @param states  whose numbers are below
  CheapestWays(std::size_t limit, std::size_t states) : limit_(limit) { grow(states); }

  void grow(std::size_t states) {
    if (limit_ == 1 && costs_.size() < states) costs_.resize(states, kNoWay);
    if (limit_ > 1 && limit_ != kNoLimit && ways_.size() < states) ways_.resize(states);
  }
  void prefetch(StateIndex::Id state) const {
    if (limit_ == 1) __builtin_prefetch(&costs_[state]);
  }
  /// Whether a way at this cost may be among the cheapest; counts it if so.
  bool admit(StateIndex::Id state, Cost cost) {
    if (limit_ == 1) {
      if (cost >= costs_[state]) return false;
      states_ += costs_[state] == kNoWay ? 1 : 0;
      costs_[state] = cost;
      return true;
    }
    if (limit_ == kNoLimit) return ++states_ > 0;
    auto& costs = ways_[state].costs;
    if (costs.size() == limit_) {
      if (cost >= costs.front()) return false;
      std::ranges::pop_heap(costs);
      costs.pop_back();
    }
    states_ += costs.empty() ? 1 : 0;
    costs.push_back(cost);
    std::ranges::push_heap(costs);
    return true;
  }
  /// Whether an admitted way is still among the cheapest when its turn comes.
  bool take(StateIndex::Id state, Cost cost) {
    if (limit_ == 1) return cost == costs_[state];
    return limit_ == kNoLimit || ways_[state].taken++ < limit_;
  }
  /// How many states a way was admitted to; with no limit, how many ways.
  [[nodiscard]] std::size_t states() const { return states_; }
  [[nodiscard]] std::size_t bytes_held() const {
    std::size_t bytes = costs_.capacity() * sizeof(Cost) + ways_.capacity() * sizeof(Ways);
    for (const Ways& ways : ways_) bytes += ways.costs.capacity() * sizeof(Cost);
    return bytes;
  }

 private:
  struct Ways {
    std::vector<Cost> costs;  ///< a heap, the dearest first
    std::size_t taken = 0;
  };
  std::size_t limit_;
  std::size_t states_ = 0;
  std::vector<Cost> costs_;  ///< by state, where only one way is followed
  std::vector<Ways> ways_;   ///< by state, where several are
};

}  // namespace plat::sequences
