#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/box.h"
#include "geodata/layer.h"

namespace plat::geodata {

/// A colour of 8 bits a channel; alpha 0 where nothing was seen.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t alpha = 255;

  friend bool operator==(const Colour&, const Colour&) = default;
};

/// An image in the local frame, north up: pixel (column, row) covers the square whose upper left
/// corner is (left_m + column * pixel_m, top_m - row * pixel_m).
struct Raster {
  LocalFrame frame;
  double left_m = 0.0;
  double top_m = 0.0;
  double pixel_m = 1.0;
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<Colour> pixels;  ///< row by row, width * height

  [[nodiscard]] const Colour& at(std::size_t column, std::size_t row) const {
    return pixels[row * width + column];
  }
  [[nodiscard]] Colour& at(std::size_t column, std::size_t row) {
    return pixels[row * width + column];
  }
  [[nodiscard]] Box box() const {
    return {{left_m, top_m - static_cast<double>(height) * pixel_m},
            {left_m + static_cast<double>(width) * pixel_m, top_m}};
  }
};

}  // namespace plat::geodata
