#include "imagery/image_mosaic.h"

#include <algorithm>
#include <utility>

#include "core/failure.h"
#include "imagery/image_warp.h"

namespace plat::imagery {
namespace {

using geodata::PixelWindow;
using geodata::Raster;
using geodata::RasterGrid;

/// Side of the windows that are composed at once, pixels: a canvas of 16 MB; changes no pixel.
constexpr std::size_t kTile = 1024;

/// Bilinear samples reach one source pixel further, and a target pixel's area reaches further
/// still where the image is made smaller.
double source_margin_m(const RasterGrid& target, const RasterGrid& source) {
  return 2.0 * source.pixel_m + target.pixel_m;
}

bool meets(const PixelWindow& a, const PixelWindow& b) {
  return a.column < b.column + b.width && b.column < a.column + a.width &&
         a.row < b.row + b.height && b.row < a.row + a.height;
}

/// Where the targets lie, in pixels of the grid.
std::vector<PixelWindow> windows_of(const MosaicInput& input, const RasterGrid& grid) {
  std::vector<PixelWindow> windows;
  for (const ParcelShape& target : input.targets)
    windows.push_back(geodata::window_of(grid, box_of(target.polygon)));
  return windows;
}

void copy_into(Raster& image, const PixelWindow& whole, const Raster& tile,
               const PixelWindow& window) {
  for (std::size_t r = 0; r < window.height; ++r) {
    std::copy_n(tile.pixels.begin() + static_cast<std::ptrdiff_t>(r * window.width), window.width,
                &image.at(window.column - whole.column, window.row - whole.row + r));
  }
}

Raster draw_tile(const MosaicInput& input, const std::vector<PixelWindow>& places,
                 const RasterGrid& grid, const PixelWindow& window) {
  CoverageCanvas canvas(grid, window);
  for (std::size_t i = 0; i < input.targets.size(); ++i) {
    if (!input.plan[i] || !meets(places[i], window)) continue;
    const ParcelImage& image = *input.plan[i];
    const SharedImage& file = *input.images[image.example];
    const Raster source = file.read(source_box(image.grid, source_margin_m(grid, file.grid())));
    if (source.width == 0 || source.height == 0) continue;
    draw_parcel(input.targets[i].polygon, WarpMap(image.grid), source, canvas);
  }
  return canvas.over(input.ground(window));
}

std::vector<PixelWindow> tiles_of(const PixelWindow& window) {
  std::vector<PixelWindow> tiles;
  for (std::size_t row = 0; row < window.height; row += kTile) {
    for (std::size_t column = 0; column < window.width; column += kTile) {
      tiles.push_back({window.column + column, window.row + row,
                       std::min(kTile, window.width - column),
                       std::min(kTile, window.height - row)});
    }
  }
  return tiles;
}

Raster draw(const MosaicInput& input, const std::vector<PixelWindow>& places,
            const RasterGrid& grid, const PixelWindow& window, Jobs jobs) {
  Raster image = geodata::empty_raster(grid, window);
  const std::vector<PixelWindow> tiles = tiles_of(window);
  parallel_for(tiles.size(), jobs, [&](std::size_t i) {
    copy_into(image, window, draw_tile(input, places, grid, tiles[i]), tiles[i]);
  });
  return image;
}

}  // namespace

SharedImage::SharedImage(std::string file, const geodata::RasterReadOptions& options)
    : file_(std::move(file)), options_(options) {
  idle_.push_back(std::make_unique<geodata::RasterReader>(file_, options_));
  grid_ = idle_.front()->grid();
  description_ = idle_.front()->description();
}

Raster SharedImage::read(const Box& box) const {
  const PixelWindow window = geodata::window_of(grid_, box);
  if (window.width == 0 || window.height == 0) return {};
  std::unique_ptr<geodata::RasterReader> reader;
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      reader = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!reader) reader = std::make_unique<geodata::RasterReader>(file_, options_);
  Raster pixels = reader->read(window);
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(reader));
  return pixels;
}

GroundPainter plain_ground(const RasterGrid& grid, geodata::Colour colour) {
  return [grid, colour](const PixelWindow& window) {
    Raster ground = geodata::empty_raster(grid, window);
    std::fill(ground.pixels.begin(), ground.pixels.end(), colour);
    return ground;
  };
}

Raster draw_mosaic(const MosaicInput& input, const RasterGrid& grid, const PixelWindow& window,
                   Jobs jobs) {
  return draw(input, windows_of(input, grid), grid, window, jobs);
}

void write_mosaic(const std::string& path, const MosaicInput& input, const RasterGrid& grid,
                  const geodata::RasterWriteOptions& options, Jobs jobs, Progress::Style style) {
  expects(input.plan.size() == input.targets.size(), "the plan has an entry per target");
  geodata::RasterWriter writer(path, grid, options);
  const std::vector<PixelWindow> places = windows_of(input, grid);
  Progress progress("imagery", (grid.height + kTile - 1) / kTile, style);
  for (std::size_t row = 0; row < grid.height; row += kTile) {
    writer.write(
        draw(input, places, grid, {0, row, grid.width, std::min(kTile, grid.height - row)}, jobs));
    progress.step();
  }
  writer.finish();
}

}  // namespace plat::imagery
