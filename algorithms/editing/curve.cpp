#include "editing/curve.h"

#include <algorithm>
#include <cmath>

#include "core/working_grid.h"

namespace plat::editing {
namespace {

Point at(Point from, const Curve& curve, Point to, double t) {
  const Point a = lerp(from, curve.first, t);
  const Point b = lerp(curve.first, curve.second, t);
  const Point c = lerp(curve.second, to, t);
  return lerp(lerp(a, b, t), lerp(b, c, t), t);
}

/// So many equal steps of the parameter keep the chord within kFlatness_m: an eighth of the largest
/// second derivative times the step squared bounds its distance.
int step_count(Point from, const Curve& curve, Point to) {
  constexpr double kMaxSteps = 256.0;
  const double bend = std::max(length(from - 2.0 * curve.first + curve.second),
                               length(curve.first - 2.0 * curve.second + to));
  const double steps = std::ceil(std::sqrt(6.0 * bend / (8.0 * kFlatness_m)));
  return static_cast<int>(std::clamp(steps, 1.0, kMaxSteps));
}

}  // namespace

Polyline sampled(Point from, const Curve& curve, Point to) {
  const int steps = step_count(from, curve, to);
  Polyline line{from};
  for (int i = 1; i < steps; ++i) {
    const Point p = snap(at(from, curve, to, static_cast<double>(i) / steps));
    if (p != line.back() && p != to) line.push_back(p);
  }
  line.push_back(to);
  return line;
}

std::pair<Curve, Curve> split(Point from, const Curve& curve, Point to, double t) {
  const Point a = lerp(from, curve.first, t);
  const Point b = lerp(curve.first, curve.second, t);
  const Point c = lerp(curve.second, to, t);
  return {{snap(a), snap(lerp(a, b, t))}, {snap(lerp(b, c, t)), snap(c)}};
}

double nearest_parameter(Point from, const Curve& curve, Point to, Point p) {
  const int steps = step_count(from, curve, to);
  double best_distance = distance(from, p);
  double best = 0.0;
  for (int i = 0; i < steps; ++i) {
    const Segment chord{at(from, curve, to, static_cast<double>(i) / steps),
                        at(from, curve, to, static_cast<double>(i + 1) / steps)};
    const double t = plat::nearest_parameter(chord, p);
    const double d = distance(lerp(chord.a, chord.b, t), p);
    if (d >= best_distance) continue;
    best_distance = d;
    best = (i + t) / steps;
  }
  return best;
}

}  // namespace plat::editing
