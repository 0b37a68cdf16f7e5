#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/box.h"

namespace plat::tiles {

/// Boxes by the cells of a square grid that they meet.
class CellIndex {
 public:
  CellIndex(std::vector<Box> boxes, double cell_m) : boxes_(std::move(boxes)), cell_m_(cell_m) {
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
      for_each_cell(boxes_[i], [&](Cell cell) { entries_.emplace_back(cell, i); });
    std::ranges::sort(entries_);
  }

  /// The boxes that meet `box`, ascending.
  [[nodiscard]] std::vector<std::uint32_t> near(const Box& box) const {
    std::vector<std::uint32_t> out;
    for_each_cell(box, [&](Cell cell) {
      for (auto it = std::ranges::lower_bound(entries_, std::pair{cell, 0U});
           it != entries_.end() && it->first == cell; ++it) {
        if (boxes_[it->second].intersects(box)) out.push_back(it->second);
      }
    });
    std::ranges::sort(out);
    const auto twice = std::ranges::unique(out);
    out.erase(twice.begin(), twice.end());
    return out;
  }

 private:
  using Cell = std::pair<std::int32_t, std::int32_t>;

  template <class Visit>
  void for_each_cell(const Box& box, Visit visit) const {
    if (box.is_empty()) return;
    const auto cell = [&](double metres) {
      return static_cast<std::int32_t>(std::floor(metres / cell_m_));
    };
    for (std::int32_t x = cell(box.min.x); x <= cell(box.max.x); ++x) {
      for (std::int32_t y = cell(box.min.y); y <= cell(box.max.y); ++y) visit(Cell{x, y});
    }
  }

  std::vector<Box> boxes_;
  double cell_m_;
  std::vector<std::pair<Cell, std::uint32_t>> entries_;
};

}  // namespace plat::tiles
