#include "imagery/rendered_orthophoto.h"

#include <algorithm>
#include <cmath>

#include "core/failure.h"
#include "imagery/canvas.h"
#include "imagery/ground_texture.h"
#include "imagery/tree_painter.h"

namespace plat::imagery {
namespace {

/// The lens spreads a point over its neighbours: the share that each of two neighbours gets.
constexpr float kBlur = 0.16F;
constexpr std::size_t kBlurMargin_px = 1;
/// The sensor's grain, one standard deviation, of 255.
constexpr float kGrain = 2.2F;
/// The air between camera and ground, and how much of it is seen.
constexpr Canvas::Pixel kHaze{.red = 0.62F, .green = 0.68F, .blue = 0.76F};
constexpr float kHaze_01 = 0.05F;
/// Pixels beyond a shadow's reach that are painted for rounding's sake.
constexpr double kReachSlack_px = 3.0;

std::uint8_t developed(float light, float haze, float grain) {
  const float seen = light + kHaze_01 * (haze - light);
  return static_cast<std::uint8_t>(
      std::clamp(std::floor(seen * 255.0F + kGrain * grain + 0.5F), 0.0F, 255.0F));
}

}  // namespace

class RenderedOrthophoto::Painter {
 public:
  Painter(const MapLayers& layers, const OrthophotoOptions& options, std::uint64_t seed)
      : frame_(layers.frame),
        options_(options),
        sun_{options.sun_azimuth_rad, options.sun_elevation_rad},
        noise_(derive_seed(seed, {seed_key("picture noise")}), options.pixel_m),
        map_(make_scene(layers, {.style = {options.climate, options.roofs},
                                 .missing = options.missing,
                                 .sun = sun_,
                                 .seed = seed})) {}

  [[nodiscard]] const MapScene& map() const { return map_; }

  [[nodiscard]] PixelBlock block_of(const Box& window) const {
    expects(!window.is_empty(), "a window has a size");
    const auto first = [&](double v) { return static_cast<std::int64_t>(std::floor(v)); };
    const auto last = [&](double v) { return static_cast<std::int64_t>(std::ceil(v)); };
    const double pixel = options_.pixel_m;
    const std::int64_t column = first(window.min.x / pixel);
    const std::int64_t row = first(-window.max.y / pixel);
    return {
        column, row,
        static_cast<std::size_t>(std::max(last(window.max.x / pixel) - column, std::int64_t{1})),
        static_cast<std::size_t>(std::max(last(-window.min.y / pixel) - row, std::int64_t{1}))};
  }

  [[nodiscard]] geodata::RasterGrid grid_of(const PixelBlock& block) const {
    const Box box = block.box(options_.pixel_m);
    return {frame_, box.min.x, box.max.y, options_.pixel_m, block.width, block.height};
  }

  [[nodiscard]] std::size_t tile_px() const { return options_.tile_px; }

  /// Rows [first, first + count) of the block, its tiles painted in parallel.
  [[nodiscard]] geodata::Raster strip(const PixelBlock& block, std::size_t first, std::size_t count,
                                      Jobs jobs) const {
    geodata::Raster out = geodata::empty_raster(grid_of(block), {0, first, block.width, count});
    const std::size_t tiles = (block.width + options_.tile_px - 1) / options_.tile_px;
    parallel_for(tiles, jobs, [&](std::size_t i) {
      const std::size_t left = i * options_.tile_px;
      const std::size_t width = std::min(options_.tile_px, block.width - left);
      paint({block.column + static_cast<std::int64_t>(left),
             block.row + static_cast<std::int64_t>(first), width, count},
            out, left);
    });
    return out;
  }

 private:
  /// A tile with what lies around it that its pixels depend on: the lens's neighbours, and on the
  /// sunny sides whatever may throw a shadow into it.
  [[nodiscard]] PixelBlock with_surroundings(const PixelBlock& tile) const {
    const double pixel = options_.pixel_m;
    const double farthest = sun_.reach_m(map_.scene.highest_m());
    const Box around = tile.box(pixel).expanded(farthest + 2.0 * pixel);
    const double reach_px = sun_.reach_m(map_.scene.highest_m(around)) / pixel + kReachSlack_px;
    const Point to_sun = sun_.direction();
    const auto margin = [&](double towards) {
      return kBlurMargin_px + static_cast<std::size_t>(
                                  std::ceil(std::max(0.0, towards) * reach_px + kReachSlack_px));
    };
    return tile.grown(margin(-to_sun.x), margin(to_sun.x), margin(to_sun.y), margin(-to_sun.y));
  }

  void paint(const PixelBlock& tile, geodata::Raster& out, std::size_t out_left) const {
    Canvas canvas(with_surroundings(tile), options_.pixel_m);
    paint_shapes(canvas, map_.scene);
    apply_texture(canvas, noise_);
    paint_trees(canvas, map_.scene, noise_, sun_);
    cast_shadows(canvas, sun_);
    develop(canvas, tile, out, out_left);
  }

  void develop(const Canvas& canvas, const PixelBlock& tile, geodata::Raster& out,
               std::size_t out_left) const {
    const PixelBlock& block = canvas.block;
    const auto above = static_cast<std::size_t>(tile.row - block.row);
    const auto left = static_cast<std::size_t>(tile.column - block.column);
    const auto blurred = [&](const Canvas::Pixel* row, float Canvas::Pixel::* channel) {
      return (1.0F - 2.0F * kBlur) * row[0].*channel + kBlur * (row[-1].*channel + row[1].*channel);
    };
    for (std::size_t y = 0; y < tile.height; ++y) {
      // Another part of the noise than the texture's.
      NoiseField::Walk grains(noise_.grain, tile.column + 131,
                              tile.row + static_cast<std::int64_t>(y) + 57);
      for (std::size_t x = 0; x < tile.width; ++x) {
        const Canvas::Pixel* middle = canvas.colour.data() + (above + y) * block.width + left + x;
        const auto channel = [&](float Canvas::Pixel::* c) {
          return (1.0F - 2.0F * kBlur) * blurred(middle, c) +
                 kBlur * (blurred(middle - block.width, c) + blurred(middle + block.width, c));
        };
        const float grain = grains.next();
        out.at(out_left + x, y) = {developed(channel(&Canvas::Pixel::red), kHaze.red, grain),
                                   developed(channel(&Canvas::Pixel::green), kHaze.green, grain),
                                   developed(channel(&Canvas::Pixel::blue), kHaze.blue, grain),
                                   255};
      }
    }
  }

  geodata::LocalFrame frame_;
  OrthophotoOptions options_;
  Sun sun_;
  PictureNoise noise_;
  MapScene map_;
};

RenderedOrthophoto::RenderedOrthophoto(const MapLayers& layers, const OrthophotoOptions& options,
                                       std::uint64_t seed)
    : painter_(std::make_unique<Painter>(layers, options, seed)) {}
RenderedOrthophoto::~RenderedOrthophoto() = default;
RenderedOrthophoto::RenderedOrthophoto(RenderedOrthophoto&&) noexcept = default;
RenderedOrthophoto& RenderedOrthophoto::operator=(RenderedOrthophoto&&) noexcept = default;

std::size_t RenderedOrthophoto::assumed_footprints() const {
  return painter_->map().assumed_footprints;
}
std::size_t RenderedOrthophoto::assumed_heights() const { return painter_->map().assumed_heights; }

geodata::RasterGrid RenderedOrthophoto::grid(const Box& window) const {
  return painter_->grid_of(painter_->block_of(window));
}

geodata::Raster RenderedOrthophoto::render(const Box& window, Jobs jobs) const {
  const PixelBlock block = painter_->block_of(window);
  geodata::Raster out =
      geodata::empty_raster(painter_->grid_of(block), {0, 0, block.width, block.height});
  for (std::size_t row = 0; row < block.height; row += painter_->tile_px()) {
    const std::size_t count = std::min(painter_->tile_px(), block.height - row);
    const geodata::Raster strip = painter_->strip(block, row, count, jobs);
    std::copy(strip.pixels.begin(), strip.pixels.end(),
              out.pixels.begin() + static_cast<std::ptrdiff_t>(row * block.width));
  }
  return out;
}

void RenderedOrthophoto::write(const std::string& path, const Box& window, Jobs jobs,
                               Progress::Style progress,
                               geodata::RasterCompression compression) const {
  const PixelBlock block = painter_->block_of(window);
  geodata::RasterWriter writer(path, painter_->grid_of(block),
                               {.bands = geodata::RasterBands::kOpaque,
                                .compression = compression,
                                .description = std::string(kRenderedDescription)});
  const std::size_t tile = painter_->tile_px();
  Progress bar("rendering", (block.height + tile - 1) / tile, progress);
  for (std::size_t row = 0; row < block.height; row += tile) {
    writer.write(painter_->strip(block, row, std::min(tile, block.height - row), jobs));
    bar.step();
  }
  writer.finish();
}

}  // namespace plat::imagery
