#pragma once

#include <cmath>
#include <numbers>

#include "core/rng.h"
#include "core/validity.h"
#include "imagery/parcel_shape.h"
#include "support/synthetic_blocks.h"

namespace plat::testing {

inline Polygon rectangle(double x, double y, double w, double h) {
  return {{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, {}};
}

inline imagery::ParcelShape shape(const Polygon& polygon) {
  return imagery::shape_of(polygon, std::nullopt);
}

/// A strip between a lower and an upper contour of up to seven vertices each, twice as long as it
/// is wide or more, turned; on the working grid and strictly simple. Most are monotone along their
/// main axis, many along both.
inline Polygon strip_parcel(Rng& rng) {
  for (;;) {
    const double length = rng.uniform(20, 80);
    const double width = rng.uniform(5, 0.5 * length);
    const auto vertices = [&](double from, double to) {
      Ring row;
      const auto n = static_cast<int>(rng.index(6));
      row.push_back({rng.uniform(0, 0.1) * length, rng.uniform(from, to)});
      for (int i = 0; i < n; ++i)
        row.push_back({length * (0.15 + 0.7 * (i + rng.uniform_01()) / n), rng.uniform(from, to)});
      row.push_back({rng.uniform(0.9, 1.0) * length, rng.uniform(from, to)});
      return row;
    };
    Polygon polygon{vertices(0, 0.2 * width), {}};
    const Ring above = vertices(0.6 * width, width);
    polygon.outer.insert(polygon.outer.end(), above.rbegin(), above.rend());
    const double turn = rng.uniform(0, 2.0 * std::numbers::pi);
    const Point u{std::cos(turn), std::sin(turn)};
    for (Point& p : polygon.outer) p = Point{100, -50} + p.x * u + p.y * perpendicular(u);
    if (const auto admitted = admit_polygon(polygon, 100)) return *admitted;
  }
}

/// Strips, and now and then a lot of any shape: L, star, curved.
inline Polygon any_parcel(Rng& rng) {
  if (rng.index(3) != 0) return strip_parcel(rng);
  for (;;) {
    Polygon p = synthetic_blocks(rng, 1).front();
    p.holes.clear();
    if (const auto admitted = admit_polygon(p, 200)) return *admitted;
  }
}

}  // namespace plat::testing
