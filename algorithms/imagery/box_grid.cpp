#include "imagery/box_grid.h"

#include <algorithm>
#include <cmath>

namespace plat::imagery {
namespace {

/// Side of a cell: about a parcel and a house.
constexpr double kCell_m = 48.0;

}  // namespace

BoxGrid::BoxGrid(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  for (const Box& box : boxes_) bounds_.add(box);
  if (bounds_.is_empty()) return;
  columns_ = static_cast<std::int64_t>(bounds_.width() / kCell_m) + 1;
  rows_ = static_cast<std::int64_t>(bounds_.height() / kCell_m) + 1;
  cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    if (boxes_[i].is_empty()) continue;
    const Cells cells = cells_of(boxes_[i]);
    for (std::int64_t r = cells.first_row; r <= cells.last_row; ++r) {
      for (std::int64_t c = cells.first_column; c <= cells.last_column; ++c)
        cells_[static_cast<std::size_t>(r * columns_ + c)].push_back(i);
    }
  }
}

BoxGrid::Cells BoxGrid::cells_of(const Box& box) const {
  const auto cell = [](double v, double low, std::int64_t count) {
    return std::clamp(static_cast<std::int64_t>(std::floor((v - low) / kCell_m)), std::int64_t{0},
                      count - 1);
  };
  return {cell(box.min.x, bounds_.min.x, columns_), cell(box.max.x, bounds_.min.x, columns_),
          cell(box.min.y, bounds_.min.y, rows_), cell(box.max.y, bounds_.min.y, rows_)};
}

std::vector<std::uint32_t> BoxGrid::near(const Box& box) const {
  std::vector<std::uint32_t> out;
  if (bounds_.is_empty() || !bounds_.intersects(box)) return out;
  const Cells cells = cells_of(box);
  for (std::int64_t r = cells.first_row; r <= cells.last_row; ++r) {
    for (std::int64_t c = cells.first_column; c <= cells.last_column; ++c) {
      for (const std::uint32_t i : cells_[static_cast<std::size_t>(r * columns_ + c)]) {
        if (boxes_[i].intersects(box)) out.push_back(i);
      }
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace plat::imagery
