#pragma once

#include <cmath>
#include <compare>

namespace plat {

/// A point or a vector of the plane, metres, local east-north.
struct Point {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
  /// Lexicographic, x first: the order in which everything unordered is put before it is written.
  friend std::partial_ordering operator<=>(const Point&, const Point&) = default;
};

constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
constexpr Point operator-(Point a) { return {-a.x, -a.y}; }
constexpr Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
constexpr Point operator/(Point a, double s) { return {a.x / s, a.y / s}; }

constexpr double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
constexpr double squared_length(Point a) { return dot(a, a); }
inline double length(Point a) { return std::sqrt(squared_length(a)); }
inline double distance(Point a, Point b) { return length(b - a); }
constexpr Point lerp(Point a, Point b, double t) { return a + t * (b - a); }
constexpr Point midpoint(Point a, Point b) { return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}; }

/// The vector turned by +90 degrees: left of `a`.
constexpr Point perpendicular(Point a) { return {-a.y, a.x}; }

/// The unit vector along `a`; the zero vector for the zero vector.
inline Point normalized(Point a) {
  const double norm = length(a);
  return norm > 0.0 ? a / norm : Point{};
}

/// Twice the signed area of abc: positive where c lies left of ab. Exact for points of the working
/// grid that lie within 2^15 m of each other (working_grid.h).
constexpr double orientation(Point a, Point b, Point c) { return cross(b - a, c - a); }

/// A directed line segment.
struct Segment {
  Point a;
  Point b;

  friend bool operator==(const Segment&, const Segment&) = default;
};

inline double length(const Segment& s) { return distance(s.a, s.b); }

/// The parameter in [0, 1] of the point of `s` nearest to `p`; 0 for a segment without length.
constexpr double nearest_parameter(const Segment& s, Point p) {
  const Point d = s.b - s.a;
  const double dd = squared_length(d);
  if (dd <= 0.0) return 0.0;
  const double t = dot(p - s.a, d) / dd;
  return t < 0.0 ? 0.0 : (t > 1.0 ? 1.0 : t);
}

constexpr Point nearest_point(const Segment& s, Point p) {
  return lerp(s.a, s.b, nearest_parameter(s, p));
}

inline double distance(const Segment& s, Point p) { return distance(nearest_point(s, p), p); }

}  // namespace plat
