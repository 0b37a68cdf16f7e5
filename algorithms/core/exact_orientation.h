#pragma once

#include <cmath>
#include <cstdint>

#include "core/point.h"
#include "core/working_grid.h"

namespace plat {

/// The sign of orientation(a, b, c), exact for points of the working grid, and for midpoints of
/// such points, anywhere within kGridExtent_m: in doubles where these are sure of the sign, else in
/// 128-bit integers.
inline int orientation_sign(Point a, Point b, Point c) {
  const double left = (b.x - a.x) * (c.y - a.y);
  const double right = (b.y - a.y) * (c.x - a.x);
  const double determinant = left - right;
  // Differences of grid points are exact; two products and a difference err by less than four
  // halves of an ulp.
  constexpr double kErrorShare = 0x1p-50;
  const double error = kErrorShare * (std::abs(left) + std::abs(right));
  if (determinant > error) return 1;
  if (determinant < -error) return -1;
  __extension__ using Wide = __int128;
  constexpr double kHalfGridUnitsPerMetre = 2.0 * kGridUnitsPerMetre;
  const auto units = [](double metres) {
    return static_cast<Wide>(std::llround(metres * kHalfGridUnitsPerMetre));
  };
  const Wide exact = units(b.x - a.x) * units(c.y - a.y) - units(b.y - a.y) * units(c.x - a.x);
  return (exact > 0) - (exact < 0);
}

/// Whether `p`, which lies on the line through the segment's ends, lies on the segment, ends
/// included.
inline bool is_between(const Segment& s, Point p) {
  const auto within = [](double a, double b, double v) {
    return (a <= v && v <= b) || (b <= v && v <= a);
  };
  return within(s.a.x, s.b.x, p.x) && within(s.a.y, s.b.y, p.y);
}

/// Whether `p` lies on the segment, ends included; exact as orientation_sign().
inline bool lies_on(const Segment& s, Point p) {
  return is_between(s, p) && orientation_sign(s.a, s.b, p) == 0;
}

/// Whether the insides of the two segments meet in one point; exact as orientation_sign().
inline bool cross_properly(const Segment& s, const Segment& t) {
  return orientation_sign(s.a, s.b, t.a) * orientation_sign(s.a, s.b, t.b) < 0 &&
         orientation_sign(t.a, t.b, s.a) * orientation_sign(t.a, t.b, s.b) < 0;
}

/// Whether the segments, ends included, have a point in common; exact as orientation_sign().
inline bool meet(const Segment& s, const Segment& t) {
  return cross_properly(s, t) || lies_on(s, t.a) || lies_on(s, t.b) || lies_on(t, s.a) ||
         lies_on(t, s.b);
}

}  // namespace plat
