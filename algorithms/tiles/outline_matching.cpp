#include "tiles/outline_matching_internal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/failure.h"
#include "similarity/rigid_alignment.h"
#include "tiles/reconfiguration_internal.h"

namespace plat::tiles::detail {
namespace {

/// Points on each outline that an alignment is measured by.
constexpr std::size_t kSamples = 72;
/// Alignments whose squares differ by less than this share are as good as each other.
constexpr double kAsGood_01 = 1e-3;
/// Anchors nearer than this to each other are one: a grid step.
constexpr double kSamePlace_m = 1.0 / 1024.0;
/// Another alignment is preferred to the similarity's where it is as much nearer: a measure that
/// forgives stretching may lay a long side on a short one.
constexpr double kMuchNearer_01 = 0.7;
/// Corners of aligned outlines correspond where they are at most this share of the outline apart.
constexpr double kCornerReach_01 = 0.06;
/// A corner turns by more than this.
constexpr double kCornerTurn_rad = 0.35;

using Pairs = std::vector<std::pair<Point, Point>>;

double rotation_of(const Affine& map) { return std::atan2(map.yx - map.xy, map.xx + map.yy); }

/// A rotation about nothing in particular, then a shift, that carries `from` to `to`.
Affine motion_by(double angle_rad, Point from, Point to) {
  Affine out = Affine::rotation(angle_rad);
  out.shift = to - out.linear(from);
  return out;
}

double squares(const Affine& motion, const Pairs& pairs) {
  double sum = 0.0;
  for (const auto& [a, b] : pairs) sum += squared_length(motion(a) - b);
  return sum;
}

Pairs sampled(const ArcLength& from, const ArcLength& to, std::size_t offset) {
  Pairs out;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const auto share = [](std::size_t i) {
      return static_cast<double>(i) / static_cast<double>(kSamples);
    };
    out.emplace_back(from.point(share(k) * from.total_m()),
                     to.point(share((k + offset) % kSamples) * to.total_m()));
  }
  return out;
}

double turned_against(const Affine& motion, const Affine& other) {
  return std::abs(std::remainder(rotation_of(motion) - rotation_of(other), 2 * std::numbers::pi));
}

Affine best_alignment(const ArcLength& from, const ArcLength& to, const Affine& as_placed) {
  Affine best;
  double best_squares = std::numeric_limits<double>::infinity();
  for (std::size_t offset = 0; offset < kSamples; ++offset) {
    const Pairs pairs = sampled(from, to, offset);
    const Affine motion = similarity::rigid_alignment(pairs);
    const double sum = squares(motion, pairs);
    const bool is_as_good = std::abs(sum - best_squares) <= kAsGood_01 * best_squares;
    if (is_as_good ? turned_against(motion, as_placed) < turned_against(best, as_placed)
                   : sum < best_squares) {
      best = motion;
      best_squares = sum;
    }
  }
  return best;
}

Affine motion_of(const similarity::ShapeComparison& comparison, const ArcLength& from,
                 const ArcLength& to, const Affine& as_placed) {
  if (comparison.transformation && comparison.transformation->determinant() > 0.0) {
    const Point center = centroid(Polygon{from.ring(), {}});
    return motion_by(rotation_of(*comparison.transformation), center,
                     (*comparison.transformation)(center));
  }
  if (comparison.correspondence.size() >= 2)
    return similarity::rigid_alignment(comparison.correspondence);
  return best_alignment(from, to, as_placed);
}

std::vector<ArcMap::Anchor> anchors_of(const Pairs& correspondence, const ArcLength& from,
                                       const ArcLength& to) {
  std::vector<ArcMap::Anchor> out;
  for (const auto& [a, b] : correspondence) out.emplace_back(from.nearest(a), to.nearest(b));
  return out;
}

/// One pair of places by the best cyclic alignment of the outline as it is placed, then corners
/// near each other.
std::vector<ArcMap::Anchor> aligned_anchors(const Affine& motion, const ArcLength& from,
                                            const ArcLength& to) {
  std::size_t best = 0;
  double best_squares = std::numeric_limits<double>::infinity();
  for (std::size_t offset = 0; offset < kSamples; ++offset) {
    const double sum = squares(motion, sampled(from, to, offset));
    if (sum < best_squares) {
      best = offset;
      best_squares = sum;
    }
  }
  const double shift = static_cast<double>(best) / static_cast<double>(kSamples) * to.total_m();
  const ArcMap alignment(from.total_m(), to.total_m(), {{0.0, shift}});
  std::vector<ArcMap::Anchor> out;
  for (std::size_t i = 0; i < from.ring().size(); ++i) {
    if (std::abs(turn_rad(from.ring(), i)) < kCornerTurn_rad) continue;
    const double expected = alignment.to(from.at(i));
    double nearest = std::numeric_limits<double>::infinity();
    double place = 0.0;
    for (std::size_t j = 0; j < to.ring().size(); ++j) {
      if (std::abs(turn_rad(to.ring(), j)) < kCornerTurn_rad) continue;
      const double off = std::abs(std::remainder(to.at(j) - expected, to.total_m()));
      const double apart = distance(motion(from.ring()[i]), to.ring()[j]);
      if (off <= kCornerReach_01 * to.total_m() && apart < nearest) {
        nearest = apart;
        place = to.at(j);
      }
    }
    if (std::isfinite(nearest)) out.emplace_back(from.at(i), place);
  }
  if (out.empty()) out.emplace_back(0.0, shift);
  return out;
}

/// The way from `base` to `s` round an outline.
double ahead(double s, double base, double total) {
  const double out = std::fmod(s - base, total);
  return out < 0.0 ? out + total : out;
}

}  // namespace

ArcMap::ArcMap(double from_total_m, double to_total_m, std::vector<Anchor> anchors)
    : from_total_m_(from_total_m), to_total_m_(to_total_m) {
  expects(!anchors.empty(), "an arc map has an anchor");
  const Anchor base = anchors.front();
  std::ranges::stable_sort(
      anchors, {}, [&](const Anchor& a) { return ahead(a.first, base.first, from_total_m_); });
  double last_s = 0.0;
  double last_t = 0.0;
  anchors_.push_back(base);
  for (const Anchor& anchor : anchors) {
    const double s = ahead(anchor.first, base.first, from_total_m_);
    const double t = ahead(anchor.second, base.second, to_total_m_);
    if (s < last_s + kSamePlace_m || t < last_t + kSamePlace_m) continue;
    if (s > from_total_m_ - kSamePlace_m || t > to_total_m_ - kSamePlace_m) continue;
    anchors_.push_back(anchor);
    last_s = s;
    last_t = t;
  }
}

double ArcMap::to(double s) const {
  const double way = ahead(s, anchors_.front().first, from_total_m_);
  double s0 = 0.0;
  double t0 = 0.0;
  double s1 = from_total_m_;
  double t1 = to_total_m_;
  for (std::size_t k = 1; k < anchors_.size(); ++k) {
    const double at = ahead(anchors_[k].first, anchors_.front().first, from_total_m_);
    const double there = ahead(anchors_[k].second, anchors_.front().second, to_total_m_);
    if (at <= way) {
      s0 = at;
      t0 = there;
    } else {
      s1 = at;
      t1 = there;
      break;
    }
  }
  const double out = anchors_.front().second + t0 + (t1 - t0) * (way - s0) / (s1 - s0);
  return ahead(out, 0.0, to_total_m_);
}

double ArcMap::from(double t) const {
  std::vector<Anchor> turned;
  for (const auto& [s, there] : anchors_) turned.emplace_back(there, s);
  return ArcMap(to_total_m_, from_total_m_, std::move(turned)).to(t);
}

namespace {

/// Root mean square distance of corresponding points.
double misfit_m(const OutlineMatch& match, const ArcLength& from, const ArcLength& to) {
  const ArcMap map(from.total_m(), to.total_m(), match.anchors);
  double sum = 0.0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(kSamples) * from.total_m();
    sum += squared_length(match.motion(from.point(s)) - to.point(map.to(s)));
  }
  return std::sqrt(sum / static_cast<double>(kSamples));
}

}  // namespace

OutlineMatch match_outlines(const similarity::ShapeComparison& comparison, const ArcLength& from,
                            const ArcLength& to, const Affine& as_placed) {
  const Affine aligned = best_alignment(from, to, as_placed);
  OutlineMatch out{aligned, aligned_anchors(aligned, from, to)};
  if (!comparison.correspondence.empty() || comparison.transformation) {
    OutlineMatch similar{motion_of(comparison, from, to, as_placed), {}};
    similar.anchors = comparison.correspondence.empty()
                          ? aligned_anchors(similar.motion, from, to)
                          : anchors_of(comparison.correspondence, from, to);
    if (misfit_m(out, from, to) >= kMuchNearer_01 * misfit_m(similar, from, to))
      out = std::move(similar);
  }
  const bool is_as_placed = std::ranges::all_of(
      from.ring(), [&](Point p) { return distance(out.motion(p), as_placed(p)) < kUnmoved_m; });
  if (is_as_placed) out.motion = as_placed;
  return out;
}

}  // namespace plat::tiles::detail
