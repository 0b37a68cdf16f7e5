#include "imagery/ground_texture.h"

#include <algorithm>
#include <array>

#include "core/rng.h"

namespace plat::imagery {
namespace {

/// A running mean over the rows of a torus.
void blur_rows(std::vector<float>& values, std::size_t size, std::size_t radius) {
  std::vector<float> line(size);
  const double weight = 1.0 / static_cast<double>(2 * radius + 1);
  for (std::size_t row = 0; row < size; ++row) {
    float* first = values.data() + row * size;
    std::copy_n(first, size, line.begin());
    double sum = 0.0;
    for (std::size_t i = 0; i < 2 * radius + 1; ++i)
      sum += static_cast<double>(line[(i + size - radius) % size]);
    for (std::size_t i = 0; i < size; ++i) {
      first[i] = static_cast<float>(sum * weight);
      const std::size_t entering = i + radius + 1 < size ? i + radius + 1 : i + radius + 1 - size;
      const std::size_t leaving = i >= radius ? i - radius : i + size - radius;
      sum += static_cast<double>(line[entering]) - static_cast<double>(line[leaving]);
    }
  }
}

/// Rows become columns.
void transpose(std::vector<float>& values, std::size_t size) {
  constexpr std::size_t kBlock = 32;  // both sides of the exchange stay in the cache
  for (std::size_t r0 = 0; r0 < size; r0 += kBlock) {
    for (std::size_t c0 = r0; c0 < size; c0 += kBlock) {
      for (std::size_t r = r0; r < std::min(r0 + kBlock, size); ++r) {
        for (std::size_t c = std::max(c0, r + 1); c < std::min(c0 + kBlock, size); ++c)
          std::swap(values[r * size + c], values[c * size + r]);
      }
    }
  }
}

/// How much of each noise a material shows, and how far dry and lush ground differ in hue.
struct Weave {
  float grain, fine, medium, broad, hue;
};

constexpr std::array<Weave, static_cast<std::size_t>(Material::kCount)> kWeaves{{
    {.grain = 0.04F, .fine = 0.05F, .medium = 0.045F, .broad = 0.05F, .hue = 0.02F},     // soil
    {.grain = 0.04F, .fine = 0.04F, .medium = 0.04F, .broad = 0.045F, .hue = 0.04F},     // grass
    {.grain = 0.05F, .fine = 0.06F, .medium = 0.06F, .broad = 0.06F, .hue = 0.03F},      // meadow
    {.grain = 0.03F, .fine = 0.02F, .medium = 0.018F, .broad = 0.025F, .hue = 0.0F},     // asphalt
    {.grain = 0.03F, .fine = 0.02F, .medium = 0.02F, .broad = 0.025F, .hue = 0.0F},      // concrete
    {.grain = 0.08F, .fine = 0.04F, .medium = 0.03F, .broad = 0.03F, .hue = 0.01F},      // gravel
    {.grain = 0.03F, .fine = 0.06F, .medium = 0.05F, .broad = 0.0F, .hue = 0.0F},        // paint
    {.grain = 0.025F, .fine = 0.015F, .medium = 0.02F, .broad = 0.025F, .hue = 0.005F},  // flat
                                                                                         // roof
    {.grain = 0.05F, .fine = 0.04F, .medium = 0.02F, .broad = 0.015F, .hue = 0.01F},     // pitched
    {.grain = 0.012F, .fine = 0.01F, .medium = 0.01F, .broad = 0.04F, .hue = 0.01F},     // water
    {.grain = 0.02F, .fine = 0.0F, .medium = 0.0F, .broad = 0.0F, .hue = 0.0F},          // metal
}};

}  // namespace

NoiseField::NoiseField(std::uint64_t seed, std::size_t size_px, std::size_t blur_px)
    : size_(size_px), values_(size_px * size_px) {
  Rng rng(seed);
  for (float& v : values_) v = static_cast<float>(rng.uniform_01()) - 0.5F;
  // Three running means are close to a Gaussian.
  for (int direction = 0; direction < 2 && blur_px > 0; ++direction) {
    for (int pass = 0; pass < 3; ++pass) blur_rows(values_, size_, blur_px);
    transpose(values_, size_);
  }
  double sum = 0.0;
  double squares = 0.0;
  for (const float v : values_) {
    sum += static_cast<double>(v);
    squares += static_cast<double>(v) * static_cast<double>(v);
  }
  const auto count = static_cast<double>(values_.size());
  const double mean = sum / count;
  const double deviation = std::sqrt(squares / count - mean * mean);
  for (float& v : values_) {
    const double normal = (static_cast<double>(v) - mean) / deviation;
    v = static_cast<float>(std::clamp(normal, -2.5, 2.5));
  }
}

namespace {

std::size_t pixels(double metres, double pixel_m) {
  return static_cast<std::size_t>(std::clamp(std::round(metres / pixel_m), 0.0, 60.0));
}

}  // namespace

PictureNoise::PictureNoise(std::uint64_t seed, double pixel_m)
    : grain(derive_seed(seed, {seed_key("grain")}), 509, 0),
      fine(derive_seed(seed, {seed_key("fine")}), 601, pixels(0.25, pixel_m)),
      medium(derive_seed(seed, {seed_key("medium")}), 1021, pixels(0.8, pixel_m)),
      broad(derive_seed(seed, {seed_key("broad")}), 1531, pixels(6.0, pixel_m)) {}

void apply_texture(Canvas& canvas, const PictureNoise& noise) {
  const PixelBlock& block = canvas.block;
  for (std::size_t y = 0; y < block.height; ++y) {
    const std::int64_t row = block.row + static_cast<std::int64_t>(y);
    NoiseField::Walk grain(noise.grain, block.column, row);
    NoiseField::Walk fine(noise.fine, block.column, row);
    NoiseField::Walk mediums(noise.medium, block.column, row);
    NoiseField::Walk broads(noise.broad, block.column, row);
    for (std::size_t x = 0; x < block.width; ++x) {
      const std::size_t p = y * block.width + x;
      const Weave& weave = kWeaves[static_cast<std::size_t>(canvas.material[p])];
      const float medium = mediums.next();
      const float broad = broads.next();
      const float light = 1.0F + weave.grain * grain.next() + weave.fine * fine.next() +
                          weave.medium * medium + weave.broad * broad;
      const float dryness = weave.hue * (0.6F * broad + 0.4F * medium);
      Canvas::Pixel& c = canvas.colour[p];
      c.red *= light * (1.0F + dryness);
      c.green *= light * (1.0F + 0.25F * dryness);
      c.blue *= light * (1.0F - 0.3F * dryness);
    }
  }
}

}  // namespace plat::imagery
