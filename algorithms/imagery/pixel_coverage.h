#pragma once

#include <cstddef>
#include <vector>

#include "core/polygon.h"
#include "geodata/raster_io.h"

namespace plat::imagery {

/// Coverage is counted on this many sample points per side of a pixel.
inline constexpr std::size_t kSubpixels = 4;
inline constexpr std::uint8_t kFullCover = kSubpixels * kSubpixels;

/// Pixels of one row that a polygon covers: those from `column` on, each with the number of its
/// sample points inside, 0 to kFullCover.
struct CoveredRow {
  std::size_t row = 0;
  std::size_t column = 0;
  std::vector<std::uint8_t> cover;
};

/// Calls visit(CoveredRow) for every row of `window` that the polygon meets, top to bottom; rows,
/// columns of the whole grid.
///
/// A sample point belongs to the polygon by the even-odd rule, half open, and an edge is met at the
/// same place whichever way it runs: polygons that share their edges share no sample point and miss
/// none.
template <class Visit>
void for_each_covered_row(const Polygon& polygon, const geodata::RasterGrid& grid,
                          const geodata::PixelWindow& window, Visit visit);

namespace detail {

/// Counts of one row of pixels after the other.
class CoverageScan {
 public:
  CoverageScan(const Polygon& polygon, const geodata::RasterGrid& grid,
               const geodata::PixelWindow& window);

  [[nodiscard]] std::size_t first_row() const { return first_row_; }
  [[nodiscard]] std::size_t end_row() const { return end_row_; }
  /// The row's counts, valid until the next call; empty where the polygon misses it.
  const CoveredRow& scan(std::size_t row);

 private:
  void scan_line(double y_m);
  void count_span(double from_m, double to_m);

  const geodata::RasterGrid& grid_;
  std::vector<Segment> edges_;  // the southern end first
  std::size_t first_row_ = 0;
  std::size_t end_row_ = 0;
  std::size_t end_column_ = 0;
  std::size_t first_column_ = 0;
  std::vector<double> crossings_m_;
  CoveredRow covered_;
};

}  // namespace detail

template <class Visit>
void for_each_covered_row(const Polygon& polygon, const geodata::RasterGrid& grid,
                          const geodata::PixelWindow& window, Visit visit) {
  detail::CoverageScan scan(polygon, grid, window);
  for (std::size_t row = scan.first_row(); row < scan.end_row(); ++row) {
    const CoveredRow& covered = scan.scan(row);
    if (!covered.cover.empty()) visit(covered);
  }
}

}  // namespace plat::imagery
