#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/failure.h"

namespace plat::sequences {

/// A priority queue for searches in which no key is below the last one taken: a radix heap, which
/// moves an entry towards the front once per bit that it differs in.
///
/// Guarantees: 1. keys come in ascending order;  2. the order of equal keys depends on nothing but
/// the sequence of calls, and what is pushed at the key just taken comes next.
/// Complexity: O(1) to push, O(log of the largest key) amortised to pop
/// Paper:      [AMOT90]
template <class Value>
class MonotoneQueue {
 public:
  struct Entry {
    std::uint64_t key = 0;
    Value value = {};
  };

  void push(std::uint64_t key, Value value) {
    expects(key >= last_, "keys do not go back");
    buckets_[bucket_of(key)].push_back({key, std::move(value)});
    ++size_;
  }

  /// Takes an entry of the least key. Precondition: not empty.
  Entry pop() {
    if (buckets_[0].empty()) advance();
    Entry entry = std::move(buckets_[0].back());
    buckets_[0].pop_back();
    --size_;
    return entry;
  }

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes_held() const {
    std::size_t entries = 0;
    for (const auto& bucket : buckets_) entries += bucket.capacity();
    return entries * sizeof(Entry);
  }

 private:
  /// By the highest bit in which the key differs from the last one taken.
  [[nodiscard]] std::size_t bucket_of(std::uint64_t key) const {
    return static_cast<std::size_t>(std::bit_width(key ^ last_));
  }

  void advance() {
    std::size_t from = 1;
    while (buckets_[from].empty()) ++from;
    std::vector<Entry> moving = std::move(buckets_[from]);
    buckets_[from].clear();
    last_ = moving.front().key;
    for (const Entry& entry : moving)
      if (entry.key < last_) last_ = entry.key;
    for (Entry& entry : moving) buckets_[bucket_of(entry.key)].push_back(std::move(entry));
  }

  std::array<std::vector<Entry>, 65> buckets_;
  std::uint64_t last_ = 0;
  std::size_t size_ = 0;
};

}  // namespace plat::sequences
