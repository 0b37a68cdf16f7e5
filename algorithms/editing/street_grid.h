#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/box.h"
#include "core/ids.h"

namespace plat::editing {

/// Finds what lies near a place while it comes and goes: cells of a fixed size, each listing the
/// ids of those whose box meets it.
template <class Key>
class IdGrid {
 public:
  void insert(Key id, const Box& box) {
    for_each_cell(box, [&](std::uint64_t cell) { cells_[cell].push_back(id); });
  }
  /// Pre: inserted with the same box.
  void erase(Key id, const Box& box) {
    for_each_cell(box, [&](std::uint64_t cell) {
      const auto it = cells_.find(cell);
      if (it == cells_.end()) return;
      std::erase(it->second, id);
      if (it->second.empty()) cells_.erase(it);
    });
  }
  /// Those whose cells meet `box`, sorted, each once.
  [[nodiscard]] std::vector<Key> near(const Box& box) const {
    std::vector<Key> out;
    for_each_cell(box, [&](std::uint64_t cell) {
      const auto it = cells_.find(cell);
      if (it != cells_.end()) out.insert(out.end(), it->second.begin(), it->second.end());
    });
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

 private:
  /// About the length of a street between two junctions: few streets a cell, few cells a street.
  static constexpr double kCell_m = 64.0;

  template <class Visit>
  static void for_each_cell(const Box& box, Visit visit) {
    const auto cell = [](double v) { return static_cast<std::int64_t>(std::floor(v / kCell_m)); };
    for (std::int64_t row = cell(box.min.y); row <= cell(box.max.y); ++row) {
      for (std::int64_t column = cell(box.min.x); column <= cell(box.max.x); ++column) {
        visit((static_cast<std::uint64_t>(row) << 32U) ^
              (static_cast<std::uint64_t>(column) & 0xffffffffU));
      }
    }
  }

  std::unordered_map<std::uint64_t, std::vector<Key>> cells_;
};

using StreetGrid = IdGrid<StreetId>;

}  // namespace plat::editing
