#include "sequences/state_groups.h"

#include <algorithm>
#include <utility>

namespace plat::sequences {
namespace {

constexpr std::size_t kFirstSlots = 64;

std::uint64_t hash_of(std::uint32_t zone, std::span<const Amount> consumed) {
  constexpr std::uint64_t kOddMultiplier = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  std::uint64_t hash = zone * kOddMultiplier;
  for (const Amount amount : consumed) {
    hash = (hash ^ static_cast<std::uint32_t>(amount)) * kOddMultiplier;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace

StateGroups::StateGroups(std::uint32_t dimension_count)
    : dimension_count_(dimension_count), slots_(kFirstSlots, kNone) {}

std::size_t StateGroups::slot_of(std::uint32_t zone, std::span<const Amount> consumed) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(zone, consumed) & mask;
  while (slots_[slot] != kNone) {
    if (is_group(slots_[slot], zone, consumed)) break;
    slot = (slot + 1) & mask;
  }
  return slot;
}

/// Vectors are short: a loop is faster than a call to compare memory.
bool StateGroups::is_group(std::uint32_t group, std::uint32_t zone,
                           std::span<const Amount> consumed) const {
  if (zones_[group] != zone) return false;
  const Amount* amounts = consumed_.data() + std::size_t{group} * dimension_count_;
  for (std::uint32_t d = 0; d < dimension_count_; ++d)
    if (amounts[d] != consumed[d]) return false;
  return true;
}

std::uint32_t StateGroups::find(std::uint32_t zone, std::span<const Amount> consumed) const {
  return slots_[slot_of(zone, consumed)];
}

std::uint32_t StateGroups::insert(std::uint32_t zone, std::span<const Amount> consumed) {
  const std::size_t slot = slot_of(zone, consumed);
  if (slots_[slot] != kNone) return slots_[slot];
  const std::uint32_t group = size();
  slots_[slot] = group;
  zones_.push_back(zone);
  consumed_.insert(consumed_.end(), consumed.begin(), consumed.end());
  if (std::size_t{2} * size() > slots_.size()) grow();
  return group;
}

void StateGroups::grow() {
  slots_.assign(slots_.size() * 2, kNone);
  for (std::uint32_t group = 0; group < size(); ++group)
    slots_[slot_of(zones_[group], consumed(group))] = group;
}

bool StateGroups::precedes(std::uint32_t a, std::uint32_t b) const {
  if (zones_[a] != zones_[b]) return zones_[a] < zones_[b];
  return std::ranges::lexicographical_compare(consumed(a), consumed(b));
}

std::uint64_t StateGroups::bytes() const {
  return zones_.capacity() * sizeof(zones_[0]) + consumed_.capacity() * sizeof(Amount) +
         slots_.capacity() * sizeof(slots_[0]);
}

}  // namespace plat::sequences
