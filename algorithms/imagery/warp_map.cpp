#include "imagery/warp_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/failure.h"

namespace plat::imagery {
namespace {

/// Parameters this far outside [0, 1] are rounding, and the column is the right one.
constexpr double kParameterRounding_01 = 1e-9;
/// At a tip the Jacobian vanishes; it is taken this far from it.
constexpr double kFromTip_01 = 1e-3;

}  // namespace

Stretch stretch_at(const SourcePoint& point) {
  const double determinant = std::abs(cross(point.per_east, point.per_north));
  const double square = squared_length(point.per_east) + squared_length(point.per_north);
  // Singular values s, t: s t = determinant, s^2 + t^2 = square.
  const double larger = std::sqrt(
      0.5 * (square + std::sqrt(std::max(0.0, square * square - 4.0 * determinant * determinant))));
  return {larger * larger / determinant, 1.0 / determinant};
}

WarpMap::Patch::Patch(const Quad& quad)
    : p(quad[0]),
      e(quad[1] - quad[0]),
      f(quad[3] - quad[0]),
      g((quad[2] - quad[3]) - (quad[1] - quad[0])) {}

Point WarpMap::Patch::at(double a, double b) const { return p + a * e + b * f + (a * b) * g; }

WarpMap::WarpMap(const WarpGrid& grid) {
  expects(!grid.target.empty() && grid.target.size() == grid.source.size(),
          "a grid has as many columns in the source as in the target");
  for (const Quad& quad : grid.target) target_.emplace_back(quad);
  for (const Quad& quad : grid.source) source_.emplace_back(quad);
}

WarpMap::Parameters WarpMap::parameters(const Patch& patch, Point target) const {
  // The line at `a` from p + a e in the direction f + a g passes through the target:
  // qa a^2 + qb a + qc = 0; the root where the left side falls, as the Jacobian is positive.
  const Point q = target - patch.p;
  const double qa = -cross(patch.e, patch.g);
  const double qb = cross(q, patch.g) - cross(patch.e, patch.f);
  const double qc = cross(q, patch.f);
  const double root = std::sqrt(std::max(0.0, qb * qb - 4.0 * qa * qc));
  double a = 0.0;  // in a quadrilateral without area
  if (qb < 0.0) {
    a = 2.0 * qc / (root - qb);
  } else if (qa != 0.0) {
    a = -(root + qb) / (2.0 * qa);
  }
  double excess = std::max({0.0, -a, a - 1.0});
  a = std::clamp(a, 0.0, 1.0);
  const Point along = patch.f + a * patch.g;
  const double squared = squared_length(along);
  double b = squared > 0.0 ? dot(q - a * patch.e, along) / squared : 0.5;
  excess = std::max({excess, -b, b - 1.0});
  b = std::clamp(b, 0.0, 1.0);
  return {a, b, excess};
}

void WarpMap::move_towards(Point target, std::size_t& column) const {
  // Start line of column k: from p in the direction f.
  const auto lies_before = [&](std::size_t k) {
    return cross(target_[k].f, target - target_[k].p) > 0.0;
  };
  while (column > 0 && lies_before(column)) --column;
  while (column + 1 < target_.size() && !lies_before(column + 1)) ++column;
}

SourcePoint WarpMap::source_of(Point target, std::size_t& column) const {
  column = std::min(column, target_.size() - 1);
  move_towards(target, column);
  Parameters at = parameters(target_[column], target);
  if (at.excess > kParameterRounding_01 && target_.size() > 1) {
    // Outside the contour, or a leaning line misled: the column that fits best.
    for (std::size_t k = 0; k < target_.size(); ++k) {
      const Parameters other = parameters(target_[k], target);
      if (other.excess < at.excess) {
        at = other;
        column = k;
      }
    }
  }
  const Patch& to = target_[column];
  const Patch& from = source_[column];
  const double a = std::clamp(at.a, kFromTip_01, 1.0 - kFromTip_01);
  const double b = std::clamp(at.b, kFromTip_01, 1.0 - kFromTip_01);
  const Point to_a = to.e + b * to.g;
  const Point to_b = to.f + a * to.g;
  const Point from_a = from.e + b * from.g;
  const Point from_b = from.f + a * from.g;
  const double determinant = cross(to_a, to_b);
  const Point a_per{to_b.y / determinant, -to_b.x / determinant};  // per east, per north
  const Point b_per{-to_a.y / determinant, to_a.x / determinant};
  return {from.at(at.a, at.b), a_per.x * from_a + b_per.x * from_b,
          a_per.y * from_a + b_per.y * from_b};
}

}  // namespace plat::imagery
