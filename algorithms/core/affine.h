#pragma once

#include <optional>

#include "core/point.h"
#include "core/polygon.h"

namespace plat {

/// An affine map of the plane: p -> (xx x + xy y, yx x + yy y) + shift. The identity by default.
struct Affine {
  double xx = 1.0;
  double xy = 0.0;
  double yx = 0.0;
  double yy = 1.0;
  Point shift{};

  static Affine translation(Point by) { return {.shift = by}; }
  /// Counter-clockwise about a point.
  static Affine rotation(double angle_rad, Point about = {});

  /// Of a vector: without the shift.
  [[nodiscard]] constexpr Point linear(Point v) const {
    return {xx * v.x + xy * v.y, yx * v.x + yy * v.y};
  }
  [[nodiscard]] constexpr Point operator()(Point p) const { return linear(p) + shift; }
  [[nodiscard]] constexpr double determinant() const { return xx * yy - xy * yx; }
  /// nullopt where the map is singular or not finite.
  [[nodiscard]] std::optional<Affine> inverse() const;
  [[nodiscard]] bool is_finite() const;

  friend bool operator==(const Affine&, const Affine&) = default;
};

/// First `b`, then `a`.
constexpr Affine operator*(const Affine& a, const Affine& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
          a.yx * b.xy + a.yy * b.yy, a(b.shift)};
}

/// The image of a polygon, its rings turned round where the map mirrors. Not on the working grid.
Polygon transformed(const Affine& map, const Polygon& polygon);

}  // namespace plat
