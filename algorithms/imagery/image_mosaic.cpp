#include "imagery/image_mosaic.h"

#include <algorithm>
#include <utility>

#include "core/failure.h"
#include "imagery/drawing_windows_internal.h"
#include "imagery/image_warp.h"

namespace plat::imagery {
namespace {

using geodata::PixelWindow;
using geodata::Raster;
using geodata::RasterGrid;

/// Bilinear samples reach one source pixel further, and a target pixel's area reaches further
/// still where the image is made smaller.
double source_margin_m(const RasterGrid& target, const RasterGrid& source) {
  return 2.0 * source.pixel_m + target.pixel_m;
}

/// Where the targets lie, in pixels of the grid.
std::vector<PixelWindow> windows_of(const MosaicInput& input, const RasterGrid& grid) {
  std::vector<PixelWindow> windows;
  for (const ParcelShape& target : input.targets)
    windows.push_back(geodata::window_of(grid, box_of(target.polygon)));
  return windows;
}

Raster draw_tile(const MosaicInput& input, const std::vector<PixelWindow>& places,
                 const RasterGrid& grid, const PixelWindow& window) {
  CoverageCanvas canvas(grid, window);
  for (std::size_t i = 0; i < input.targets.size(); ++i) {
    if (!input.plan[i] || !detail::meets(places[i], window)) continue;
    const ParcelImage& image = *input.plan[i];
    const SharedImage& file = *input.images[image.example];
    const Raster source = file.read(source_box(image.grid, source_margin_m(grid, file.grid())));
    if (source.width == 0 || source.height == 0) continue;
    draw_parcel(input.targets[i].polygon, WarpMap(image.grid), source, canvas);
  }
  return canvas.over(input.ground(window));
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
  const std::vector<PixelWindow> places = windows_of(input, grid);
  return detail::draw_windows(grid, window, jobs, [&](const PixelWindow& part) {
    return draw_tile(input, places, grid, part);
  });
}

void write_mosaic(const std::string& path, const MosaicInput& input, const RasterGrid& grid,
                  const geodata::RasterWriteOptions& options, Jobs jobs, Progress::Style style) {
  expects(input.plan.size() == input.targets.size(), "the plan has an entry per target");
  const std::vector<PixelWindow> places = windows_of(input, grid);
  detail::write_windows(path, grid, options, jobs, style, [&](const PixelWindow& part) {
    return draw_tile(input, places, grid, part);
  });
}

}  // namespace plat::imagery
