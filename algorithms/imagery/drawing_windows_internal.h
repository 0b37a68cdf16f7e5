#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"
#include "geodata/raster_io.h"

/// Images that are drawn window by window, so that a city is never held in memory.
namespace plat::imagery::detail {

/// Side of the windows that are composed at once, pixels: a canvas of 16 MB; changes no pixel.
inline constexpr std::size_t kDrawingWindow = 1024;

/// Whether two windows have a pixel in common.
inline bool meets(const geodata::PixelWindow& a, const geodata::PixelWindow& b) {
  return a.column < b.column + b.width && b.column < a.column + a.width &&
         a.row < b.row + b.height && b.row < a.row + a.height;
}

inline std::vector<geodata::PixelWindow> drawing_windows(const geodata::PixelWindow& window) {
  std::vector<geodata::PixelWindow> windows;
  for (std::size_t row = 0; row < window.height; row += kDrawingWindow) {
    for (std::size_t column = 0; column < window.width; column += kDrawingWindow) {
      windows.push_back({window.column + column, window.row + row,
                         std::min(kDrawingWindow, window.width - column),
                         std::min(kDrawingWindow, window.height - row)});
    }
  }
  return windows;
}

/// @param draw  Raster(const PixelWindow&), called from several threads
template <class Draw>
geodata::Raster draw_windows(const geodata::RasterGrid& grid, const geodata::PixelWindow& window,
                             Jobs jobs, const Draw& draw) {
  geodata::Raster image = geodata::empty_raster(grid, window);
  const std::vector<geodata::PixelWindow> windows = drawing_windows(window);
  parallel_for(windows.size(), jobs, [&](std::size_t i) {
    const geodata::PixelWindow& part = windows[i];
    const geodata::Raster drawn = draw(part);
    for (std::size_t r = 0; r < part.height; ++r) {
      std::copy_n(drawn.pixels.begin() + static_cast<std::ptrdiff_t>(r * part.width), part.width,
                  &image.at(part.column - window.column, part.row - window.row + r));
    }
  });
  return image;
}

/// The whole grid into a GeoTIFF, strip by strip. @throws InputError as RasterWriter
template <class Draw>
void write_windows(const std::string& path, const geodata::RasterGrid& grid,
                   const geodata::RasterWriteOptions& options, Jobs jobs, Progress::Style style,
                   const Draw& draw) {
  geodata::RasterWriter writer(path, grid, options);
  Progress progress("imagery", (grid.height + kDrawingWindow - 1) / kDrawingWindow, style);
  for (std::size_t row = 0; row < grid.height; row += kDrawingWindow) {
    const std::size_t rows = std::min(kDrawingWindow, grid.height - row);
    writer.write(draw_windows(grid, {0, row, grid.width, rows}, jobs, draw));
    progress.step();
  }
  writer.finish();
}

}  // namespace plat::imagery::detail
