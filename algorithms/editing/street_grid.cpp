#include "editing/street_grid.h"

#include <algorithm>
#include <cmath>

namespace plat::editing {
namespace {

/// About the length of a street between two junctions: few streets a cell, few cells a street.
constexpr double kCell_m = 64.0;

}  // namespace

template <class Visit>
void StreetGrid::for_each_cell(const Box& box, Visit visit) {
  const auto cell = [](double v) { return static_cast<std::int64_t>(std::floor(v / kCell_m)); };
  for (std::int64_t row = cell(box.min.y); row <= cell(box.max.y); ++row) {
    for (std::int64_t column = cell(box.min.x); column <= cell(box.max.x); ++column) {
      visit((static_cast<std::uint64_t>(row) << 32U) ^
            (static_cast<std::uint64_t>(column) & 0xffffffffU));
    }
  }
}

void StreetGrid::insert(StreetId street, const Box& box) {
  for_each_cell(box, [&](std::uint64_t cell) { cells_[cell].push_back(street); });
}

void StreetGrid::erase(StreetId street, const Box& box) {
  for_each_cell(box, [&](std::uint64_t cell) {
    const auto it = cells_.find(cell);
    if (it == cells_.end()) return;
    std::erase(it->second, street);
    if (it->second.empty()) cells_.erase(it);
  });
}

std::vector<StreetId> StreetGrid::near(const Box& box) const {
  std::vector<StreetId> out;
  for_each_cell(box, [&](std::uint64_t cell) {
    const auto it = cells_.find(cell);
    if (it != cells_.end()) out.insert(out.end(), it->second.begin(), it->second.end());
  });
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace plat::editing
