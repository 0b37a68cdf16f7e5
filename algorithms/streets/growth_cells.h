#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/box.h"
#include "core/point.h"
#include "core/working_grid.h"

namespace plat::streets {

/// Finds numbered segments near a segment, while more are added: square cells, each listing what
/// passes through it or within two grid steps of it. Only cells in use are held, by hash, so that
/// coordinates may spread.
/// Complexity: adding and looking cost as many cells as the segment meets, and what they list.
class GrowthCells {
 public:
  explicit GrowthCells(double cell_m) : cell_m_(cell_m) { rehash(64); }

  void add(const Segment& segment, std::uint32_t item) {
    for_each_cell(segment, [&](std::uint64_t key) {
      std::uint32_t& head = head_of(key);
      links_.push_back({item, head});
      head = static_cast<std::uint32_t>(links_.size());
      return true;
    });
  }

  /// Calls visit(item) for the items near `segment`, some several times, until one returns false.
  /// @returns whether none did
  template <class Visit>
  bool for_each_near(const Segment& segment, Visit visit) const {
    return for_each_cell(segment, [&](std::uint64_t key) { return visit_cell(key, visit); });
  }
  template <class Visit>
  bool for_each_in(const Box& box, Visit visit) const {
    const std::int32_t right = index(box.max.x + kMargin_m);
    const std::int32_t top = index(box.max.y + kMargin_m);
    for (std::int32_t column = index(box.min.x - kMargin_m); column <= right; ++column) {
      for (std::int32_t row = index(box.min.y - kMargin_m); row <= top; ++row) {
        if (!visit_cell(key_of(column, row), visit)) return false;
      }
    }
    return true;
  }

 private:
  struct Link {
    std::uint32_t item = 0;
    std::uint32_t next = 0;  ///< number of the link plus one; 0 at the end
  };
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t head = 0;
  };
  static constexpr double kMargin_m = 2.0 * kGridStep_m;

  [[nodiscard]] std::int32_t index(double v) const {
    return static_cast<std::int32_t>(std::floor(v / cell_m_));
  }
  static std::uint64_t key_of(std::int32_t column, std::int32_t row) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32U) |
           static_cast<std::uint32_t>(row);
  }

  template <class Visit>
  bool visit_cell(std::uint64_t key, Visit& visit) const {
    for (std::uint32_t at = find_head(key); at != 0; at = links_[at - 1].next) {
      if (!visit(links_[at - 1].item)) return false;
    }
    return true;
  }

  /// The cells that the segment meets, column by column, widened by the margin.
  template <class Visit>
  bool for_each_cell(const Segment& s, Visit visit) const {
    const auto [left, right] = s.a.x <= s.b.x ? std::pair(s.a, s.b) : std::pair(s.b, s.a);
    const std::int32_t first = index(left.x - kMargin_m);
    const std::int32_t last = index(right.x + kMargin_m);
    const double slope = right.x > left.x ? (right.y - left.y) / (right.x - left.x) : 0.0;
    for (std::int32_t column = first; column <= last; ++column) {
      // What the sides of a column err by, the slope multiplies: hence the slope in `spare`.
      double low = std::min(left.y, right.y);
      double high = std::max(left.y, right.y);
      if (first != last && slope != 0.0) {
        const double x0 = std::max(left.x, column * cell_m_ - kMargin_m);
        const double x1 = std::min(right.x, (column + 1.0) * cell_m_ + kMargin_m);
        const double y0 = left.y + slope * (x0 - left.x);
        const double y1 = left.y + slope * (x1 - left.x);
        const double spare = kMargin_m * (1.0 + std::abs(slope));
        low = std::max(low, std::min(y0, y1) - spare);
        high = std::min(high, std::max(y0, y1) + spare);
      }
      const std::int32_t top = index(high + kMargin_m);
      for (std::int32_t row = index(low - kMargin_m); row <= top; ++row) {
        if (!visit(key_of(column, row))) return false;
      }
    }
    return true;
  }

  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    std::uint64_t h = key * 0x9E3779B97F4A7C15ULL;
    h ^= h >> 32U;
    std::size_t slot = h & (slots_.size() - 1);
    while (slots_[slot].head != 0 && slots_[slot].key != key)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  [[nodiscard]] std::uint32_t find_head(std::uint64_t key) const {
    return slots_[slot_of(key)].head;
  }

  /// The head of a cell's list; the caller puts a link there at once.
  std::uint32_t& head_of(std::uint64_t key) {
    if (2 * (used_ + 1) > slots_.size()) rehash(2 * slots_.size());
    Slot& slot = slots_[slot_of(key)];
    if (slot.head == 0) {
      slot.key = key;
      ++used_;
    }
    return slot.head;
  }

  void rehash(std::size_t size) {
    std::vector<Slot> old = std::move(slots_);
    slots_.assign(size, {});
    for (const Slot& slot : old) {
      if (slot.head != 0) slots_[slot_of(slot.key)] = slot;
    }
  }

  double cell_m_;
  std::vector<Slot> slots_;  ///< a power of two, at most half in use
  std::size_t used_ = 0;
  std::vector<Link> links_;
};

}  // namespace plat::streets
