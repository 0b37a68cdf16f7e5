#include "imagery/tree_painter.h"

#include <algorithm>
#include <cmath>

namespace plat::imagery {
namespace {

/// How far noise moves a crown's edge, as a share of its radius per standard deviation.
constexpr float kRaggedness = 0.11F;
/// How much lighter the side towards the sun is than the middle.
constexpr float kDomeLight = 0.34F;
/// How much light the tufts of leaves catch.
constexpr float kTuftLight = 0.26F;
/// Where the lowest leaves are, as a share of the height.
constexpr float kCrownBase_01 = 0.68F;
/// Over this share of the radius a crown's edge fades, so that it has no steps.
constexpr float kEdge = 0.12F;

/// A tree in the world's pixels.
class Crown {
 public:
  Crown(const Tree& tree, double pixel_m, const PictureNoise& noise, Point to_sun)
      : tree_(tree),
        noise_(noise),
        x_(tree.place.x / pixel_m),
        y_(-tree.place.y / pixel_m),
        radius_(tree.radius_m / pixel_m),
        sun_x_(static_cast<float>(to_sun.x)),
        sun_y_(static_cast<float>(-to_sun.y)),
        shift_(static_cast<std::int64_t>(tree.variation % 997U)) {}

  void paint(Canvas& canvas) const {
    const PixelBlock& b = canvas.block;
    const double reach = radius_ * kCrownReach;
    const auto clip = [](double v, std::int64_t first, std::size_t size) {
      const auto last = first + static_cast<std::int64_t>(size);
      return std::clamp(static_cast<std::int64_t>(std::floor(v)), first, last);
    };
    for (std::int64_t r = clip(y_ - reach, b.row, b.height);
         r < clip(y_ + reach + 1, b.row, b.height); ++r) {
      for (std::int64_t c = clip(x_ - reach, b.column, b.width);
           c < clip(x_ + reach + 1, b.column, b.width); ++c) {
        const auto p =
            static_cast<std::size_t>(r - b.row) * b.width + static_cast<std::size_t>(c - b.column);
        paint_pixel(canvas, p, c, r);
      }
    }
  }

 private:
  void paint_pixel(Canvas& canvas, std::size_t p, std::int64_t column, std::int64_t row) const {
    const auto dx = static_cast<float>((static_cast<double>(column) + 0.5 - x_) / radius_);
    const auto dy = static_cast<float>((static_cast<double>(row) + 0.5 - y_) / radius_);
    const float tuft = noise_.medium.at(column + shift_, row);
    const float d = std::sqrt(dx * dx + dy * dy) + kRaggedness * tuft;
    const float cover = std::clamp((1.0F - d) / kEdge, 0.0F, 1.0F);
    if (cover <= 0.0F) return;
    const float dome = std::sqrt(std::max(0.0F, 1.0F - d * d));
    const auto height =
        static_cast<float>(tree_.height_m) * (kCrownBase_01 + (1.0F - kCrownBase_01) * dome);
    if (height < canvas.height_m[p]) return;  // under a roof
    // Light on a tuft: how fast the noise falls off away from the sun, two pixels on.
    const auto step_x = static_cast<std::int64_t>(std::lround(2.0F * sun_x_));
    const auto step_y = static_cast<std::int64_t>(std::lround(2.0F * sun_y_));
    const float relief = tuft - noise_.medium.at(column + shift_ + step_x, row + step_y);
    const float leaves = noise_.fine.at(column, row + shift_);
    const float light = std::clamp(
        0.92F + kDomeLight * (dx * sun_x_ + dy * sun_y_) + kTuftLight * relief + 0.10F * leaves,
        0.35F, 1.6F);
    Canvas::Pixel& c = canvas.colour[p];
    const auto over = [&](float below, double tint) {
      return below + cover * (light * static_cast<float>(tint) - below);
    };
    c = {over(c.red, tree_.tint.red), over(c.green, tree_.tint.green),
         over(c.blue, tree_.tint.blue)};
    if (cover >= 0.5F) canvas.height_m[p] = height;
  }

  const Tree& tree_;
  const PictureNoise& noise_;
  double x_, y_, radius_;
  float sun_x_, sun_y_;
  std::int64_t shift_;
};

}  // namespace

void paint_trees(Canvas& canvas, const Scene& scene, const PictureNoise& noise, const Sun& sun) {
  for (const std::uint32_t i : scene.trees_near(canvas.block.box(canvas.pixel_m)))
    Crown(scene.trees()[i], canvas.pixel_m, noise, sun.direction()).paint(canvas);
}

}  // namespace plat::imagery
