#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// Numbers the states of a search: a node of a zone, and what has been consumed there as the zone
/// remembers it [Har, Sec. 3.5]. Where all states that there could be are few they have their
/// numbers from the start; else each gets the next number when it is met, from a hash table.
///
/// Guarantees: 1. two states have the same number just where node and amounts are the same;
/// 2. node and amounts can be had back.
class StateIndex {
 public:
  using Id = std::uint32_t;

  /// @param dense_limit  largest number of possible states that are numbered from the start
  StateIndex(const SearchGraph& graph, std::size_t dense_limit);

  /// The state's number.
  Id id(std::uint32_t zone, std::uint32_t node, const Amount* consumed) {
    return is_dense_ ? dense_id(zone, node, consumed) : hashed_id(node, consumed);
  }
  /// A number of its own for a state that may have others already. Not where `is_dense`.
  Id fresh_id(std::uint32_t node, const Amount* consumed);

  [[nodiscard]] bool is_dense() const { return is_dense_; }
  /// All numbers are below; grows where they are given on meeting.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The node of a state; writes its amounts.
  std::uint32_t state(Id id, std::span<Amount> consumed) const;
  [[nodiscard]] std::size_t bytes_held() const;

 private:
  /// States of a zone: base + local node + size * (amounts as digits of mixed radix).
  struct Layout {
    std::uint64_t base = 0;
    std::uint32_t first_node = 0;
    std::uint32_t size = 0;
  };

  [[nodiscard]] Id dense_id(std::uint32_t zone, std::uint32_t node, const Amount* consumed) const {
    const std::uint64_t* strides = strides_.data() + std::size_t{zone} * dimension_count_;
    std::uint64_t id = layouts_[zone].base + (node - layouts_[zone].first_node);
    for (std::uint32_t d = 0; d < dimension_count_; ++d)
      id += strides[d] * static_cast<std::uint64_t>(consumed[d]);
    return static_cast<Id>(id);
  }
  Id hashed_id(std::uint32_t node, const Amount* consumed);
  [[nodiscard]] std::size_t slot_of(std::uint32_t node, const Amount* consumed) const;
  [[nodiscard]] bool is_state(Id id, std::uint32_t node, const Amount* consumed) const;
  void grow();

  std::uint32_t dimension_count_ = 0;
  bool is_dense_ = false;
  std::size_t size_ = 0;
  std::vector<Layout> layouts_;         ///< by zone
  std::vector<std::uint64_t> strides_;  ///< zones x dimensions
  std::vector<Id> slots_;               ///< of the hash table, a power of two; kEmpty: free
  std::vector<std::uint32_t> nodes_;    ///< by state
  std::vector<Amount> consumed_;        ///< states x dimensions
};

}  // namespace plat::sequences
