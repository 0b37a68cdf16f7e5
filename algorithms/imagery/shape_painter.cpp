#include <cairo.h>

#include <algorithm>
#include <memory>

#include "core/failure.h"
#include "imagery/canvas.h"

namespace plat::imagery {
namespace {

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

/// A cairo picture of 8 bits a channel.
class Drawing {
 public:
  Drawing(const PixelBlock& block, double pixel_m, cairo_antialias_t antialias)
      : block_(block),
        pixel_m_(pixel_m),
        surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(block.width),
                                            static_cast<int>(block.height))),
        context_(cairo_create(surface_.get())) {
    expects(cairo_status(context_.get()) == CAIRO_STATUS_SUCCESS, "cairo has memory for a tile");
    cairo_set_antialias(context_.get(), antialias);
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

  /// Calls visit(index, red, green, blue) for every pixel, 0..255.
  template <class Visit>
  void for_each_pixel(Visit visit) {
    cairo_surface_flush(surface_.get());
    const unsigned char* data = cairo_image_surface_get_data(surface_.get());
    const int stride = cairo_image_surface_get_stride(surface_.get());
    for (std::size_t row = 0; row < block_.height; ++row) {
      const auto* line =
          reinterpret_cast<const std::uint32_t*>(data + row * static_cast<std::size_t>(stride));
      for (std::size_t column = 0; column < block_.width; ++column) {
        const std::uint32_t rgb = line[column];
        visit(row * block_.width + column, (rgb >> 16U) & 255U, (rgb >> 8U) & 255U, rgb & 255U);
      }
    }
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

}  // namespace

void paint_shapes(Canvas& canvas, const Scene& scene) {
  Drawing colours(canvas.block, canvas.pixel_m, CAIRO_ANTIALIAS_GRAY);
  Drawing codes(canvas.block, canvas.pixel_m, CAIRO_ANTIALIAS_NONE);
  colours.fill(scene.ground().tint);
  codes.fill(coded(scene.ground()));
  for (const std::uint32_t i : scene.shapes_near(canvas.block.box(canvas.pixel_m))) {
    const Shape& shape = scene.shapes()[i];
    colours.draw(shape, shape.tint);
    codes.draw(shape, coded(shape));
  }
  colours.for_each_pixel([&](std::size_t p, std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    canvas.colour[p] = {static_cast<float>(r) / 255.0F, static_cast<float>(g) / 255.0F,
                        static_cast<float>(b) / 255.0F};
  });
  codes.for_each_pixel([&](std::size_t p, std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    canvas.material[p] = static_cast<Material>(r);
    canvas.height_m[p] = static_cast<float>(g * 256U + b) / static_cast<float>(kHeightSteps);
  });
}

}  // namespace plat::imagery
