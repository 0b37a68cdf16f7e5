#pragma once

#include <cstdint>
#include <vector>

#include "core/box.h"

namespace plat::imagery {

/// Finds boxes near a place: cells of a uniform grid, each listing the boxes that meet it.
class BoxGrid {
 public:
  BoxGrid() = default;
  explicit BoxGrid(std::vector<Box> boxes);

  /// Those that meet `box`, in ascending order.
  [[nodiscard]] std::vector<std::uint32_t> near(const Box& box) const;

 private:
  struct Cells {
    std::int64_t first_column, last_column, first_row, last_row;
  };
  [[nodiscard]] Cells cells_of(const Box& box) const;

  std::vector<Box> boxes_;
  Box bounds_;
  std::int64_t columns_ = 0;
  std::int64_t rows_ = 0;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace plat::imagery
