#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// A set of local node indices of one zone, 64 to a word.
using NodeBits = std::span<const std::uint64_t>;

/// Calls `visit(index)` for every member, ascending.
template <class Visit>
void for_each_bit(NodeBits bits, Visit visit) {
  for (std::size_t word = 0; word < bits.size(); ++word)
    for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1)
      visit(static_cast<std::uint32_t>(word * 64) +
            static_cast<std::uint32_t>(std::countr_zero(rest)));
}

inline bool has_bit(NodeBits bits, std::uint32_t index) {
  return (bits[index / 64] >> (index % 64) & 1) != 0;
}

/// Numbers the groups of states: a group is all states of one zone that have consumed the same
/// vector. So that the states of a group share what is looked up, and a node of [Har, Sec. 3.3.1]
/// is a group and one bit.
///
/// Guarantees: 1. (zone, vector) has at most one number;  2. numbers are given in the order of
/// insertion, from zero.
class StateGroups {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  explicit StateGroups(std::uint32_t dimension_count);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(zones_.size()); }
  [[nodiscard]] std::uint32_t zone(std::uint32_t group) const { return zones_[group]; }
  /// Valid until the next `insert`.
  [[nodiscard]] std::span<const Amount> consumed(std::uint32_t group) const {
    return {consumed_.data() + std::size_t{group} * dimension_count_, dimension_count_};
  }
  /// The group's number, or `kNone`.
  [[nodiscard]] std::uint32_t find(std::uint32_t zone, std::span<const Amount> consumed) const;
  /// The group's number, a new one where there was none.
  std::uint32_t insert(std::uint32_t zone, std::span<const Amount> consumed);
  /// By zone, then lexicographically: a topological order of groups.
  [[nodiscard]] bool precedes(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  [[nodiscard]] bool is_group(std::uint32_t group, std::uint32_t zone,
                              std::span<const Amount> consumed) const;
  [[nodiscard]] std::size_t slot_of(std::uint32_t zone, std::span<const Amount> consumed) const;
  void grow();

  std::uint32_t dimension_count_;
  std::vector<std::uint32_t> zones_;
  std::vector<Amount> consumed_;      ///< groups x dimensions
  std::vector<std::uint32_t> slots_;  ///< a power of two, at most half full
};

}  // namespace plat::sequences
