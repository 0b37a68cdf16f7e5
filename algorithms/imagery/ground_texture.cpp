#include "imagery/ground_texture.h"

#include <algorithm>
#include <array>

#include "core/rng.h"

namespace plat::imagery {
namespace {

/// One pass of a running mean over a torus; `stride` 1 blurs rows, `size` columns.
void blur_lines(std::vector<float>& values, std::size_t size, std::size_t radius, bool is_rows) {
  std::vector<float> line(size);
  const std::size_t step = is_rows ? 1 : size;
  const float weight = 1.0F / static_cast<float>(2 * radius + 1);
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t first = is_rows ? k * size : k;
    double sum = 0.0;
    for (std::size_t i = 0; i < 2 * radius + 1; ++i)
      sum += static_cast<double>(values[first + ((i + size - radius) % size) * step]);
    for (std::size_t i = 0; i < size; ++i) {
      line[i] = static_cast<float>(sum) * weight;
      sum += static_cast<double>(values[first + ((i + radius + 1) % size) * step]) -
             static_cast<double>(values[first + ((i + size - radius) % size) * step]);
    }
    for (std::size_t i = 0; i < size; ++i) values[first + i * step] = line[i];
  }
}

/// How much of each noise a material shows, and how far dry and lush ground differ in hue.
struct Weave {
  float grain, fine, medium, broad, hue;
};

constexpr std::array<Weave, static_cast<std::size_t>(Material::kCount)> kWeaves{{
    {.grain = 0.04F, .fine = 0.05F, .medium = 0.045F, .broad = 0.05F, .hue = 0.02F},     // soil
    {.grain = 0.04F, .fine = 0.04F, .medium = 0.04F, .broad = 0.045F, .hue = 0.04F},     // grass
    {.grain = 0.05F, .fine = 0.06F, .medium = 0.06F, .broad = 0.06F, .hue = 0.05F},      // meadow
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
  for (int pass = 0; pass < 3 && blur_px > 0; ++pass) {
    blur_lines(values_, size_, blur_px, true);
    blur_lines(values_, size_, blur_px, false);
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
    for (std::size_t x = 0; x < block.width; ++x) {
      const std::int64_t column = block.column + static_cast<std::int64_t>(x);
      const std::size_t p = y * block.width + x;
      const Weave& weave = kWeaves[static_cast<std::size_t>(canvas.material[p])];
      const float medium = noise.medium.at(column, row);
      const float broad = noise.broad.at(column, row);
      const float light = 1.0F + weave.grain * noise.grain.at(column, row) +
                          weave.fine * noise.fine.at(column, row) + weave.medium * medium +
                          weave.broad * broad;
      const float dryness = weave.hue * (0.6F * broad + 0.4F * medium);
      Canvas::Pixel& c = canvas.colour[p];
      c.red *= light * (1.0F + dryness);
      c.green *= light * (1.0F + 0.25F * dryness);
      c.blue *= light * (1.0F - 0.3F * dryness);
    }
  }
}

}  // namespace plat::imagery
