#include "streets/segment_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/working_grid.h"

namespace plat::streets {
namespace {

constexpr int kMostPieces = 32;
/// How often the sideways amplitude is halved before a segment stays straight: a sixteenth bends
/// a street by less than its own width.
constexpr int kHalvings = 4;
/// Bisection of the amplitude: to a thousandth of a millimetre of a kilometre.
constexpr int kBisections = 30;

/// A street's way between two points, seen sideways: amplitudes of half a wave and of a whole one.
struct Shape {
  double arc = 1.0;
  double wave = 0.0;

  [[nodiscard]] double offset(double t) const {
    return arc * std::sin(std::numbers::pi * t) + wave * std::sin(2.0 * std::numbers::pi * t);
  }
};

Polyline drawn(Point a, Point b, const Shape& shape, double amplitude_share, int pieces) {
  const Point along = b - a;
  const Point aside = amplitude_share * perpendicular(along);
  Polyline line{a};
  for (int i = 1; i < pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const Point p = snap(a + t * along + shape.offset(t) * aside);
    if (p != line.back() && p != b) line.push_back(p);
  }
  line.push_back(b);
  return line;
}

Polyline line_of_length(Point a, Point b, const Shape& shape, double tortuosity) {
  const double chord = distance(a, b);
  const int pieces = std::clamp(static_cast<int>(std::ceil(chord / kCurveStep_m)), 4, kMostPieces);
  double low = 0.0;
  double high = 2.0 * tortuosity;  // an offset of more than the whole length is longer than it
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    const bool is_short = length_m(drawn(a, b, shape, middle, pieces)) < tortuosity * chord;
    (is_short ? low : high) = middle;
  }
  return drawn(a, b, shape, low, pieces);
}

/// Half of the streets are arcs, half are S-shaped, most of them uneven.
Shape draw_shape(Rng& rng) {
  const double lean = rng.uniform_01() < 0.5 ? 1.0 : -1.0;
  const double share = rng.uniform_01();
  return rng.uniform_01() < 0.5 ? Shape{lean, 0.3 * lean * share} : Shape{0.5 * lean * share, lean};
}

bool is_bent(double tortuosity) { return std::isfinite(tortuosity) && tortuosity > 1.0; }

}  // namespace

Polyline tortuous_line(Point a, Point b, double tortuosity, Rng& rng) {
  const Shape shape = draw_shape(rng);
  if (!is_bent(tortuosity) || a == b) return {a, b};
  return line_of_length(a, b, shape, tortuosity);
}

Polyline bend_segment(GrowthPlane& plane, std::uint32_t from, std::uint32_t to, double tortuosity,
                      Rng& rng) {
  Shape shape = draw_shape(rng);
  if (!is_bent(tortuosity)) return {};
  const Point a = plane.vertices()[from];
  const Point b = plane.vertices()[to];
  for (int halving = 0; halving <= kHalvings; ++halving) {
    // Near the straight line, the surplus of length goes with the square of the amplitude.
    const double wanted = 1.0 + (tortuosity - 1.0) * std::pow(0.25, halving);
    for (int side = 0; side < 2; ++side) {
      const Polyline line = line_of_length(a, b, shape, wanted);
      if (line.size() > 2 && plane.bend(from, to, line)) return line;
      shape = {-shape.arc, -shape.wave};
    }
  }
  return {};
}

}  // namespace plat::streets
