#include "imagery/pixel_coverage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plat::imagery::detail {

using geodata::PixelWindow;
using geodata::RasterGrid;

CoverageScan::CoverageScan(const Polygon& polygon, const RasterGrid& grid,
                           const PixelWindow& window)
    : grid_(grid) {
  const PixelWindow met = geodata::window_of(grid, box_of(polygon));
  first_row_ = std::max(window.row, met.row);
  end_row_ = std::min(window.row + window.height, met.row + met.height);
  first_column_ = std::max(window.column, met.column);
  end_column_ = std::min(window.column + window.width, met.column + met.width);
  if (end_row_ <= first_row_ || end_column_ <= first_column_) {
    end_row_ = first_row_;
    return;
  }
  for_each_edge(polygon, [&](const Segment& edge) {
    if (edge.a.y == edge.b.y) return;
    edges_.push_back(edge.a.y < edge.b.y ? edge : Segment{edge.b, edge.a});
  });
}

void CoverageScan::count_span(double from_m, double to_m) {
  const double subpixel_m = grid_.pixel_m / static_cast<double>(kSubpixels);
  const auto first = static_cast<double>(first_column_ * kSubpixels);
  const auto end = static_cast<double>(end_column_ * kSubpixels);
  // Sample point k lies at (k + 1/2) subpixels.
  const auto at = [&](double x_m) {
    return std::clamp(std::ceil((x_m - grid_.left_m) / subpixel_m - 0.5), first, end);
  };
  auto k = static_cast<std::size_t>(at(from_m));
  const auto stop = static_cast<std::size_t>(at(to_m));
  while (k < stop) {
    const std::size_t pixel = k / kSubpixels;
    const std::size_t until = std::min(stop, (pixel + 1) * kSubpixels);
    std::uint8_t& count = covered_.cover[pixel - first_column_];
    count = static_cast<std::uint8_t>(count + (until - k));
    k = until;
  }
}

void CoverageScan::scan_line(double y_m) {
  crossings_m_.clear();
  for (const Segment& edge : edges_) {
    if (y_m < edge.a.y || y_m >= edge.b.y) continue;
    crossings_m_.push_back(edge.a.x +
                           (y_m - edge.a.y) / (edge.b.y - edge.a.y) * (edge.b.x - edge.a.x));
  }
  std::sort(crossings_m_.begin(), crossings_m_.end());
  for (std::size_t i = 0; i + 1 < crossings_m_.size(); i += 2)
    count_span(crossings_m_[i], crossings_m_[i + 1]);
}

const CoveredRow& CoverageScan::scan(std::size_t row) {
  covered_.row = row;
  covered_.column = first_column_;
  covered_.cover.assign(end_column_ - first_column_, 0);
  for (std::size_t i = 0; i < kSubpixels; ++i) {
    const double down =
        static_cast<double>(row) + (static_cast<double>(i) + 0.5) / static_cast<double>(kSubpixels);
    scan_line(grid_.top_m - down * grid_.pixel_m);
  }
  if (std::all_of(covered_.cover.begin(), covered_.cover.end(), [](auto c) { return c == 0; }))
    covered_.cover.clear();
  return covered_;
}

}  // namespace plat::imagery::detail
