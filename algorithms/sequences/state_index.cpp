#include "sequences/state_index.h"

#include <algorithm>

#include "core/failure.h"

namespace plat::sequences {
namespace {

constexpr StateIndex::Id kEmpty = ~StateIndex::Id{0};
constexpr std::size_t kFirstSlots = 1024;

}  // namespace

StateIndex::StateIndex(const SearchGraph& graph, std::size_t dense_limit)
    : dimension_count_(graph.dimension_count), is_dense_(true) {
  std::uint64_t next = 0;
  for (const Zone& zone : graph.zones) {
    layouts_.push_back({next, zone.first_node, zone.size});
    std::uint64_t count = zone.size;
    for (const Bounds& bounds : zone.bounds) {
      strides_.push_back(count);
      count *= static_cast<std::uint64_t>(largest_amount(bounds)) + 1;
      is_dense_ = is_dense_ && count <= dense_limit;
      if (!is_dense_) break;
    }
    next += count;
    is_dense_ = is_dense_ && next <= dense_limit;
    if (!is_dense_) break;
  }
  if (is_dense_)
    size_ = static_cast<std::size_t>(next);
  else
    slots_.assign(kFirstSlots, kEmpty);
}

std::size_t StateIndex::slot_of(std::uint32_t node, const Amount* consumed) const {
  // Multiplication by a large odd number and folding spread each word over all bits.
  constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15;
  std::uint64_t hash = node * kSpread;
  for (std::uint32_t d = 0; d < dimension_count_; ++d)
    hash = ((hash ^ (hash >> 32)) + static_cast<std::uint32_t>(consumed[d])) * kSpread;
  return static_cast<std::size_t>(hash ^ (hash >> 32)) & (slots_.size() - 1);
}

bool StateIndex::is_state(Id id, std::uint32_t node, const Amount* consumed) const {
  return nodes_[id] == node && std::equal(consumed, consumed + dimension_count_,
                                          consumed_.data() + std::size_t{id} * dimension_count_);
}

StateIndex::Id StateIndex::hashed_id(std::uint32_t node, const Amount* consumed) {
  std::size_t slot = slot_of(node, consumed);
  for (; slots_[slot] != kEmpty; slot = (slot + 1) & (slots_.size() - 1))
    if (is_state(slots_[slot], node, consumed)) return slots_[slot];
  const Id id = fresh_id(node, consumed);
  slots_[slot] = id;
  if (2 * size_ > slots_.size()) grow();
  return id;
}

StateIndex::Id StateIndex::fresh_id(std::uint32_t node, const Amount* consumed) {
  expects(!is_dense_ && size_ < kEmpty, "numbers are given on meeting, and there is one left");
  nodes_.push_back(node);
  consumed_.insert(consumed_.end(), consumed, consumed + dimension_count_);
  return static_cast<Id>(size_++);
}

void StateIndex::grow() {
  slots_.assign(2 * slots_.size(), kEmpty);
  for (Id id = 0; id < size_; ++id) {
    std::size_t slot = slot_of(nodes_[id], consumed_.data() + std::size_t{id} * dimension_count_);
    while (slots_[slot] != kEmpty) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = id;
  }
}

std::uint32_t StateIndex::state(Id id, std::span<Amount> consumed) const {
  if (!is_dense_) {
    const auto row = consumed_.begin() + static_cast<std::ptrdiff_t>(std::size_t{id}) *
                                             static_cast<std::ptrdiff_t>(dimension_count_);
    std::copy(row, row + dimension_count_, consumed.begin());
    return nodes_[id];
  }
  const auto after = std::ranges::upper_bound(layouts_, std::uint64_t{id}, {}, &Layout::base);
  const Layout& layout = *std::prev(after);
  const auto zone = static_cast<std::size_t>(after - layouts_.begin()) - 1;
  std::uint64_t rest = id - layout.base;
  for (std::uint32_t d = dimension_count_; d-- > 0;) {
    const std::uint64_t stride = strides_[zone * dimension_count_ + d];
    consumed[d] = static_cast<Amount>(rest / stride);
    rest %= stride;
  }
  return layout.first_node + static_cast<std::uint32_t>(rest);
}

std::size_t StateIndex::bytes_held() const {
  return slots_.capacity() * sizeof(Id) + nodes_.capacity() * sizeof(std::uint32_t) +
         consumed_.capacity() * sizeof(Amount);
}

}  // namespace plat::sequences
