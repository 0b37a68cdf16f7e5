#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/polygon.h"
#include "core/rng.h"
#include "core/validity.h"

namespace plat::testing {

/// A star-shaped ring of n vertices, radii in [inner, outer] metres, around `center`.
inline Ring star_ring(Rng& rng, int n, double inner_m, double outer_m, Point center) {
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.8 * rng.uniform_01()) / n;
    const double radius = rng.uniform(inner_m, outer_m);
    ring.push_back(center + radius * Point{std::cos(angle), std::sin(angle)});
  }
  return ring;
}

/// Rectangles, L shapes, curved blocks, stars and blocks with a courtyard, on the working grid and
/// strictly simple.
inline std::vector<Polygon> synthetic_blocks(Rng& rng, int count) {
  std::vector<Polygon> blocks;
  while (static_cast<int>(blocks.size()) < count) {
    const Point c{rng.uniform(-500, 500), rng.uniform(-500, 500)};
    const double w = rng.uniform(25, 220);
    const double h = rng.uniform(25, 140);
    const double turn = rng.uniform(0, std::numbers::pi);
    Polygon p;
    switch (rng.index(5)) {
      case 0:
        p.outer = {{0, 0}, {w, 0}, {w, h}, {0, h}};
        break;
      case 1:
        p.outer = {{0, 0}, {w, 0}, {w, 0.4 * h}, {0.5 * w, 0.45 * h}, {0.48 * w, h}, {0, h}};
        break;
      case 2:  // a strip between two curves
        for (int i = 0; i <= 12; ++i)
          p.outer.push_back({w * i / 12.0, 0.15 * h * std::sin(0.35 * i)});
        for (int i = 12; i >= 0; --i)
          p.outer.push_back({w * i / 12.0, h + 0.15 * h * std::sin(0.35 * i)});
        break;
      case 3:
        p.outer = star_ring(rng, 5 + static_cast<int>(rng.index(25)), 0.35 * w, 0.6 * w, {});
        break;
      default:
        p.outer = {{0, 0}, {w, 0}, {w, h}, {0, h}};
        p.holes.push_back({{0.35 * w, 0.4 * h}, {0.4 * w, 0.7 * h}, {0.7 * w, 0.6 * h}});
        break;
    }
    const Point u{std::cos(turn), std::sin(turn)};
    const auto place = [&](Ring& ring) {
      for (Point& q : ring) q = c + q.x * u + q.y * perpendicular(u);
    };
    place(p.outer);
    for (Ring& hole : p.holes) place(hole);
    if (auto admitted = admit_polygon(p, 1000)) blocks.push_back(*std::move(admitted));
  }
  return blocks;
}

}  // namespace plat::testing
