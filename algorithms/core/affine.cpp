#include "core/affine.h"

#include <algorithm>
#include <cmath>

namespace plat {

Affine Affine::rotation(double angle_rad, Point about) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  Affine turn{c, -s, s, c, {}};
  turn.shift = about - turn.linear(about);
  return turn;
}

std::optional<Affine> Affine::inverse() const {
  const double d = determinant();
  if (!is_finite() || !std::isnormal(d)) return std::nullopt;
  Affine out{yy / d, -xy / d, -yx / d, xx / d, {}};
  out.shift = -out.linear(shift);
  if (!out.is_finite()) return std::nullopt;
  return out;
}

bool Affine::is_finite() const {
  return std::isfinite(xx) && std::isfinite(xy) && std::isfinite(yx) && std::isfinite(yy) &&
         std::isfinite(shift.x) && std::isfinite(shift.y);
}

Polygon transformed(const Affine& map, const Polygon& polygon) {
  const auto image = [&](const Ring& ring) {
    Ring out;
    out.reserve(ring.size());
    for (const Point p : ring) out.push_back(map(p));
    if (map.determinant() < 0.0) std::ranges::reverse(out);
    return out;
  };
  Polygon out{image(polygon.outer), {}};
  for (const Ring& hole : polygon.holes) out.holes.push_back(image(hole));
  return out;
}

}  // namespace plat
