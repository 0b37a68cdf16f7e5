#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/box.h"
#include "imagery/scene.h"

namespace plat::imagery {

/// A rectangle of the world's pixels: pixel (column, row) covers [column, column + 1) x
/// (-row - 1, -row] times its side, from the frame's origin, rows going down. Every tile of every
/// picture of this resolution is a part of this one grid.
struct PixelBlock {
  std::int64_t column = 0;
  std::int64_t row = 0;
  std::size_t width = 0;
  std::size_t height = 0;

  [[nodiscard]] Box box(double pixel_m) const {
    return {{static_cast<double>(column) * pixel_m,
             -static_cast<double>(row + static_cast<std::int64_t>(height)) * pixel_m},
            {static_cast<double>(column + static_cast<std::int64_t>(width)) * pixel_m,
             -static_cast<double>(row) * pixel_m}};
  }
  /// Grown by whole pixels.
  [[nodiscard]] PixelBlock grown(std::size_t left, std::size_t right, std::size_t above,
                                 std::size_t below) const {
    return {column - static_cast<std::int64_t>(left), row - static_cast<std::int64_t>(above),
            width + left + right, height + above + below};
  }
};

/// A piece of a picture while it is painted.
struct Canvas {
  struct Pixel {
    float red = 0.0F;  ///< 0..1
    float green = 0.0F;
    float blue = 0.0F;
  };

  Canvas(const PixelBlock& place, double pixel)
      : block(place),
        pixel_m(pixel),
        colour(place.width * place.height),
        height_m(place.width * place.height, 0.0F),
        material(place.width * place.height, Material::kSoil) {}

  PixelBlock block;
  double pixel_m;
  std::vector<Pixel> colour;
  std::vector<float> height_m;  ///< of the surface above the ground
  std::vector<Material> material;
};

/// Draws the scene's shapes, without texture, light and trees.
void paint_shapes(Canvas& canvas, const Scene& scene);

}  // namespace plat::imagery
