#include "tiles/mesh_warp.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace plat::tiles {
namespace {

/// Share of the points' larger extent that the smaller one must have for them not to be a line.
/// Below, rounding would decide across it.
constexpr double kLeastBreadth = 1e-6;

/// How far a control may end from its place, as a share of the controls' extent.
constexpr double kArrivalTolerance = 1e-7;

bool is_finite(const ControlPoint& c) {
  return std::isfinite(c.from.x) && std::isfinite(c.from.y) && std::isfinite(c.to.x) &&
         std::isfinite(c.to.y);
}

/// r^2 log r, of the squared distance.
double bending(double squared) { return squared > 0.0 ? 0.5 * squared * std::log(squared) : 0.0; }

Point mean(std::span<const Point> points) {
  Point sum;
  for (const Point p : points) sum = sum + p;
  return sum / static_cast<double>(points.size());
}

/// Second moments about the mean: (xx, xy, yy).
struct Moments {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  [[nodiscard]] double larger() const { return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy); }
  /// By the determinant: the difference of what larger() adds would be rounding.
  [[nodiscard]] double smaller() const {
    return larger() > 0.0 ? (xx * yy - xy * xy) / larger() : 0.0;
  }
  [[nodiscard]] bool is_line() const {
    return !(smaller() > kLeastBreadth * kLeastBreadth * larger());
  }
};

Moments moments_of(std::span<const Point> points, Point center) {
  Moments out;
  for (const Point p : points) {
    const Point d = p - center;
    out.xx += d.x * d.x;
    out.xy += d.x * d.y;
    out.yy += d.y * d.y;
  }
  return out;
}

}  // namespace

Expected<MeshWarp> MeshWarp::make(std::span<const ControlPoint> controls) {
  if (controls.size() < 3)
    return fail(FailureCode::kOutOfRange,
                fmt::format("{} control points, at least 3 are needed", controls.size()));
  if (controls.size() > kMostControls)
    return fail(FailureCode::kTooManyVertices,
                fmt::format("{} control points, at most {}", controls.size(), kMostControls));
  if (!std::ranges::all_of(controls, is_finite))
    return fail(FailureCode::kOutOfRange, "a control point is not finite");
  std::vector<Point> from;
  for (const ControlPoint& control : controls) from.push_back(control.from);
  MeshWarp out;
  out.center_ = mean(from);
  const Moments moments = moments_of(from, out.center_);
  if (moments.is_line())
    return fail(FailureCode::kOutOfRange, "the control points lie on one line");
  const auto count = static_cast<Eigen::Index>(controls.size());
  out.scale_m_ = std::sqrt(moments.larger() / static_cast<double>(count));
  for (const Point p : from) out.knots_.push_back((p - out.center_) / out.scale_m_);

  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + 3, count + 3);
  Eigen::MatrixX2d wished = Eigen::MatrixX2d::Zero(count + 3, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point knot = out.knots_[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < i; ++j)
      system(i, j) = system(j, i) =
          bending(squared_length(knot - out.knots_[static_cast<std::size_t>(j)]));
    system.block<1, 3>(i, count) << 1.0, knot.x, knot.y;
    system.block<3, 1>(count, i) << 1.0, knot.x, knot.y;
    const ControlPoint& control = controls[static_cast<std::size_t>(i)];
    // Displacements: a control that stays is a zero, not a large number to be met.
    wished.row(i) << control.to.x - control.from.x, control.to.y - control.from.y;
  }
  const Eigen::MatrixX2d solution = system.partialPivLu().solve(wished);
  for (Eigen::Index i = 0; i < count; ++i) out.weights_.push_back({solution(i, 0), solution(i, 1)});
  out.affine_ = {solution(count + 1, 0),
                 solution(count + 2, 0),
                 solution(count + 1, 1),
                 solution(count + 2, 1),
                 {solution(count, 0), solution(count, 1)}};
  for (const ControlPoint& control : controls) {
    if (!(distance(out(control.from), control.to) <= kArrivalTolerance * out.scale_m_))
      return fail(FailureCode::kOutOfRange,
                  fmt::format("the control point at {:.3f} {:.3f} does not arrive: another one is "
                              "at its place",
                              control.from.x, control.from.y));
  }
  return out;
}

Point MeshWarp::operator()(Point p) const {
  const Point q = (p - center_) / scale_m_;
  Point out = p + affine_(q);
  for (std::size_t i = 0; i < knots_.size(); ++i)
    out = out + bending(squared_length(q - knots_[i])) * weights_[i];
  return out;
}

AffineFit fitted_affine(std::span<const Point> from, std::span<const Point> to) {
  expects(!from.empty() && from.size() == to.size(), "as many points from as to, at least one");
  const Point center = mean(from);
  const Point arrived = mean(to);
  const Moments moments = moments_of(from, center);
  // Sums of the products of both sides' coordinates about their means.
  Affine product{0.0, 0.0, 0.0, 0.0, {}};
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Point d = from[i] - center;
    const Point e = to[i] - arrived;
    product.xx += e.x * d.x;
    product.xy += e.x * d.y;
    product.yx += e.y * d.x;
    product.yy += e.y * d.y;
  }
  AffineFit out;
  if (!moments.is_line()) {
    const double det = moments.xx * moments.yy - moments.xy * moments.xy;
    out.map = {(product.xx * moments.yy - product.xy * moments.xy) / det,
               (product.xy * moments.xx - product.xx * moments.xy) / det,
               (product.yx * moments.yy - product.yy * moments.xy) / det,
               (product.yy * moments.xx - product.yx * moments.xy) / det,
               {}};
  } else if (const double sum = moments.xx + moments.yy; sum > 0.0) {
    const double a = (product.xx + product.yy) / sum;
    const double b = (product.yx - product.xy) / sum;
    out.map = {a, -b, b, a, {}};
  }
  out.map.shift = arrived - out.map.linear(center);
  double squared = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) squared += squared_length(out.map(from[i]) - to[i]);
  out.residual_m = std::sqrt(squared / static_cast<double>(from.size()));
  return out;
}

}  // namespace plat::tiles
