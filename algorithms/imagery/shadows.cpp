#include "imagery/shadows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace plat::imagery {
namespace {

/// Over this height of the ray above the ground light fades to shadow: the sun is a disc, and the
/// step between two pixels would show.
constexpr float kPenumbra_m = 0.35F;

/// What the blue sky alone gives, as a share of sun and sky.
constexpr Canvas::Pixel kSkyLight{.red = 0.40F, .green = 0.44F, .blue = 0.53F};

void darken(Canvas::Pixel& c, float shadow_01) {
  c.red *= 1.0F - shadow_01 * (1.0F - kSkyLight.red);
  c.green *= 1.0F - shadow_01 * (1.0F - kSkyLight.green);
  c.blue *= 1.0F - shadow_01 * (1.0F - kSkyLight.blue);
}

/// The canvas as lines of pixels that rays cross one by one: rows, or columns where the sun stands
/// more to the side.
struct Lines {
  std::size_t count, length;          ///< lines, pixels of each
  std::size_t line_step, pixel_step;  ///< in the canvas's arrays
  std::int64_t first;                 ///< the world's row or column of line 0
  double along, across;               ///< the direction to the sun, pixels
};

Lines lines_of(const Canvas& canvas, const Sun& sun) {
  const PixelBlock& b = canvas.block;
  const Point to_sun = sun.direction();
  const double columns = to_sun.x;
  const double rows = -to_sun.y;
  if (std::abs(rows) >= std::abs(columns))
    return {b.height, b.width, b.width, 1, b.row, columns, rows};
  return {b.width, b.height, 1, b.width, b.column, rows, columns};
}

}  // namespace

Point Sun::direction() const { return {std::sin(azimuth_rad), std::cos(azimuth_rad)}; }

double Sun::reach_m(double height_m) const { return height_m / std::tan(elevation_rad); }

void cast_shadows(Canvas& canvas, const Sun& sun) {
  const Lines lines = lines_of(canvas, sun);
  const bool is_sun_behind = lines.across > 0.0;  // the sunny line has the next higher number
  const double slope = lines.along / std::abs(lines.across);
  const double step_m = canvas.pixel_m * std::hypot(1.0, slope);
  const auto drop = static_cast<float>(step_m * std::tan(sun.elevation_rad));
  const auto offset = [&](std::int64_t line) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(line) * slope + 0.5));
  };
  std::vector<float> ray(lines.length, 0.0F);
  std::vector<float> next(lines.length, 0.0F);
  for (std::size_t k = 0; k < lines.count; ++k) {
    const std::size_t line = is_sun_behind ? lines.count - 1 - k : k;
    const std::int64_t number = lines.first + static_cast<std::int64_t>(line);
    // Numbers that grow towards the sun, so that one offset serves both directions.
    const std::int64_t sunward = is_sun_behind ? number : -number;
    const std::int64_t shift = offset(sunward + 1) - offset(sunward);
    for (std::size_t i = 0; i < lines.length; ++i) {
      const std::int64_t from = static_cast<std::int64_t>(i) + shift;
      const bool is_inside = from >= 0 && from < static_cast<std::int64_t>(lines.length);
      const float above =
          is_inside ? std::max(ray[static_cast<std::size_t>(from)] - drop, 0.0F) : 0.0F;
      const std::size_t p = line * lines.line_step + i * lines.pixel_step;
      const float height = canvas.height_m[p];
      if (above > height) darken(canvas.colour[p], std::min((above - height) / kPenumbra_m, 1.0F));
      next[i] = std::max(above, height);
    }
    std::swap(ray, next);
  }
}

}  // namespace plat::imagery
