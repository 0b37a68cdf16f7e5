#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "imagery/canvas.h"

namespace plat::imagery {

/// Smooth noise that repeats: white noise blurred on a torus, mean 0, standard deviation 1.
class NoiseField {
 public:
  /// @param blur_px  about the radius of its blobs, 0 = white
  NoiseField(std::uint64_t seed, std::size_t size_px, std::size_t blur_px);

  [[nodiscard]] float at(std::int64_t column, std::int64_t row) const {
    return values_[wrapped(row) * size_ + wrapped(column)];
  }

  /// Goes along a row, pixel by pixel: at() without its divisions.
  class Walk {
   public:
    Walk(const NoiseField& field, std::int64_t column, std::int64_t row)
        : line_(field.values_.data() + field.wrapped(row) * field.size_),
          size_(field.size_),
          column_(field.wrapped(column)) {}
    float next() {
      const float value = line_[column_];
      column_ = column_ + 1 == size_ ? 0 : column_ + 1;
      return value;
    }

   private:
    const float* line_;
    std::size_t size_;
    std::size_t column_;
  };

 private:
  [[nodiscard]] std::size_t wrapped(std::int64_t i) const {
    const auto size = static_cast<std::int64_t>(size_);
    const std::int64_t rest = i % size;
    return static_cast<std::size_t>(rest < 0 ? rest + size : rest);
  }

  std::size_t size_;
  std::vector<float> values_;
};

/// The noise of a picture, of four sizes with periods that have no common divisor, so that it does
/// not show a pattern. Anchored to the world's pixels: tiles of a picture fit together.
struct PictureNoise {
  PictureNoise(std::uint64_t seed, double pixel_m);

  NoiseField grain;   ///< from pixel to pixel
  NoiseField fine;    ///< blades, stains: 0.3 m
  NoiseField medium;  ///< tufts, patches of tar: 1.2 m
  NoiseField broad;   ///< damp and dry ground: 8 m
};

/// Gives every pixel the texture of its material.
void apply_texture(Canvas& canvas, const PictureNoise& noise);

}  // namespace plat::imagery
