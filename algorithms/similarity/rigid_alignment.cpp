#include "similarity/rigid_alignment.h"

#include <cmath>

namespace plat::similarity {

Affine rigid_alignment(std::span<const std::pair<Point, Point>> correspondence) {
  if (correspondence.empty()) return {};
  // Sums are taken about the first pair, so that digits are not lost far from the origin.
  const auto [origin_a, origin_b] = correspondence.front();
  const auto count = static_cast<double>(correspondence.size());
  Point mean_a;
  Point mean_b;
  for (const auto& [a, b] : correspondence) {
    mean_a = mean_a + (a - origin_a) / count;
    mean_b = mean_b + (b - origin_b) / count;
  }
  double cosine = 0.0;
  double sine = 0.0;
  for (const auto& [a, b] : correspondence) {
    const Point from = a - origin_a - mean_a;
    const Point to = b - origin_b - mean_b;
    cosine += dot(from, to);
    sine += cross(from, to);
  }
  const double norm = std::hypot(cosine, sine);
  Affine out;
  if (norm > 0.0) {
    out.xx = out.yy = cosine / norm;
    out.yx = sine / norm;
    out.xy = -out.yx;
  }
  out.shift = origin_b + mean_b - out.linear(origin_a + mean_a);
  return out;
}

}  // namespace plat::similarity
