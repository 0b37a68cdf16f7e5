#include <cairo.h>

#include <algorithm>
#include <memory>

#include "core/failure.h"
#include "imagery/canvas.h"

namespace plat::imagery {
namespace {

/// Where a shape leaves the surface, cairo's smoothing samples the whole row otherwise, which would
/// be seen as seams. So nothing is smoothed: colours are drawn this much finer, and averaged.
constexpr std::size_t kFiner = 3;
/// cairo rounds to 1/256 pixel: done here, in the world's pixels, so that all tiles round alike.
constexpr double kSubpixels = 256.0;
/// Steps of the height that is drawn beside the material, per metre: 16 bits reach 511 m.
constexpr double kHeightSteps = 128.0;
constexpr double kLargestHeight_m = 65535.0 / kHeightSteps;

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDeleter {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};

/// A cairo picture of 8 bits a channel, `finer` times as fine as the block.
class Drawing {
 public:
  Drawing(const PixelBlock& block, double pixel_m, std::size_t finer)
      : block_{block.column * static_cast<std::int64_t>(finer),
               block.row * static_cast<std::int64_t>(finer), block.width * finer,
               block.height * finer},
        pixel_m_(pixel_m / static_cast<double>(finer)),
        surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(block_.width),
                                            static_cast<int>(block_.height))),
        context_(cairo_create(surface_.get())) {
    expects(cairo_status(context_.get()) == CAIRO_STATUS_SUCCESS, "cairo has memory for a tile");
    cairo_set_antialias(context_.get(), CAIRO_ANTIALIAS_NONE);
    cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
    // The default lets a curve be off by a tenth of a pixel; joins are the only curves.
    cairo_set_tolerance(context_.get(), 0.1);
  }

  void fill(const Tint& tint) {
    cairo_set_source_rgb(context_.get(), tint.red, tint.green, tint.blue);
    cairo_paint(context_.get());
  }

  void draw(const Shape& shape, const Tint& tint) {
    cairo_t* context = context_.get();
    cairo_new_path(context);
    for (const Ring& ring : shape.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const double x = local(ring[i].x, block_.column);
        const double y = local(-ring[i].y, block_.row);
        if (i == 0) {
          cairo_move_to(context, x, y);
        } else {
          cairo_line_to(context, x, y);
        }
      }
      if (shape.line_width_m == 0.0) cairo_close_path(context);
    }
    cairo_set_source_rgb(context, tint.red, tint.green, tint.blue);
    if (shape.line_width_m == 0.0) {
      cairo_fill(context);
    } else {
      cairo_set_line_width(context, shape.line_width_m / pixel_m_);
      cairo_stroke(context);
    }
  }

  void finish() { cairo_surface_flush(surface_.get()); }
  /// The pixels of a row, 0x00RRGGBB.
  [[nodiscard]] const std::uint32_t* row(std::size_t row) const {
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()));
    return reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface_.get()) +
                                                  row * stride);
  }

 private:
  [[nodiscard]] double local(double metres, std::int64_t first_pixel) const {
    const double rounded = std::round(metres / pixel_m_ * kSubpixels);
    return (rounded - static_cast<double>(first_pixel) * kSubpixels) / kSubpixels;
  }

  PixelBlock block_;
  double pixel_m_;
  std::unique_ptr<cairo_surface_t, SurfaceDeleter> surface_;
  std::unique_ptr<cairo_t, ContextDeleter> context_;
};

/// Material and height as a colour.
Tint coded(const Shape& shape) {
  const auto steps = static_cast<std::uint32_t>(
      std::round(std::clamp(shape.height_m, 0.0, kLargestHeight_m) * kHeightSteps));
  return {static_cast<double>(shape.material) / 255.0, static_cast<double>(steps >> 8U) / 255.0,
          static_cast<double>(steps & 255U) / 255.0};
}

/// The mean of the finer pixels. Two channels of a pixel are summed at once, in halves of a word.
void read_colours(Canvas& canvas, const Drawing& colours, std::size_t row) {
  constexpr float kScale = 1.0F / (255.0F * static_cast<float>(kFiner * kFiner));
  for (std::size_t column = 0; column < canvas.block.width; ++column) {
    std::uint32_t red_blue = 0;
    std::uint32_t green = 0;
    for (std::size_t y = 0; y < kFiner; ++y) {
      const std::uint32_t* line = colours.row(row * kFiner + y) + column * kFiner;
      for (std::size_t x = 0; x < kFiner; ++x) {
        red_blue += line[x] & 0xFF00FFU;
        green += line[x] & 0x00FF00U;
      }
    }
    canvas.colour[row * canvas.block.width + column] = {
        kScale * static_cast<float>(red_blue >> 16U), kScale * static_cast<float>(green >> 8U),
        kScale * static_cast<float>(red_blue & 0xFFFFU)};
  }
}

void read_codes(Canvas& canvas, const Drawing& codes, std::size_t row) {
  const std::uint32_t* line = codes.row(row);
  for (std::size_t column = 0; column < canvas.block.width; ++column) {
    const std::size_t p = row * canvas.block.width + column;
    canvas.material[p] = static_cast<Material>(line[column] >> 16U & 255U);
    canvas.height_m[p] =
        static_cast<float>(line[column] & 0xFFFFU) / static_cast<float>(kHeightSteps);
  }
}

}  // namespace

void paint_shapes(Canvas& canvas, const Scene& scene) {
  Drawing colours(canvas.block, canvas.pixel_m, kFiner);
  Drawing codes(canvas.block, canvas.pixel_m, 1);
  colours.fill(scene.ground().tint);
  codes.fill(coded(scene.ground()));
  for (const std::uint32_t i : scene.shapes_near(canvas.block.box(canvas.pixel_m))) {
    const Shape& shape = scene.shapes()[i];
    colours.draw(shape, shape.tint);
    codes.draw(shape, coded(shape));
  }
  colours.finish();
  codes.finish();
  for (std::size_t row = 0; row < canvas.block.height; ++row) {
    read_colours(canvas, colours, row);
    read_codes(canvas, codes, row);
  }
}

}  // namespace plat::imagery
