#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "similarity/affine_distortion.h"
#include "similarity/vertex_mapping_internal.h"

namespace plat::similarity::detail {
namespace {

using Options = AffineVertexSimilarity::Options;
using Coordinates = std::array<double, kMaxMappedCorners>;

/// Corners lie on a line where the determinant of their second moments is at most this share of the
/// square of its trace: a thousandth of a millimetre over a metre.
constexpr double kLineShare = 1e-12;
/// A map is singular where the sine of the angle between its columns is at most this.
constexpr double kLeastSine = 1e-9;
/// Of the sum of squares, what may be lost to rounding where the residual is taken as a difference.
constexpr double kRoundingShare = 1e-12;

constexpr std::uint32_t all_of(int count) { return (1U << count) - 1U; }

/// A set of `count` corners, renamed: corner i becomes corner i - by.
constexpr std::uint32_t rotated(std::uint32_t corners, int by, int count) {
  return ((corners >> by) | (corners << (count - by))) & all_of(count);
}

/// Second moments of paired points about their means: sums of p_x q_x, p_x q_y, p_y q_x, p_y q_y.
struct Moments {
  double xx = 0.0;
  double xy = 0.0;
  double yx = 0.0;
  double yy = 0.0;
};

/// Corners in their order, with what does not depend on what they are laid on.
struct Corners {
  int count = 0;
  Coordinates x;
  Coordinates y;
  Point sum;
};

Corners chosen_corners(const CornerOutline& outline, std::uint32_t chosen) {
  Corners out;
  for (; chosen != 0; chosen &= chosen - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(chosen));
    const auto k = static_cast<std::size_t>(out.count++);
    out.x[k] = outline.x[i];
    out.y[k] = outline.y[i];
    out.sum = out.sum + Point{outline.x[i], outline.y[i]};
  }
  return out;
}

/// @param p  `count` points, of the sum given
Moments moments(const double* px, const double* py, Point p_sum, const Corners& q) {
  Moments m;
  for (int k = 0; k < q.count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    m.xx += px[i] * q.x[i];
    m.xy += px[i] * q.y[i];
    m.yx += py[i] * q.x[i];
    m.yy += py[i] * q.y[i];
  }
  const double count = q.count;
  m.xx -= p_sum.x * q.sum.x / count;
  m.xy -= p_sum.x * q.sum.y / count;
  m.yx -= p_sum.y * q.sum.x / count;
  m.yy -= p_sum.y * q.sum.y / count;
  return m;
}

/// Twice the area of the triangle of three corners.
double twice_triangle(const CornerOutline& outline, int a, int b, int c) {
  const auto at = [&](int i) {
    return Point{outline.x[static_cast<std::size_t>(i)], outline.y[static_cast<std::size_t>(i)]};
  };
  return std::abs(orientation(at(a), at(b), at(c)));
}

/// The corners of a set, in order.
struct CornerList {
  int count = 0;
  std::array<int, kMaxMappedCorners> corner;

  explicit CornerList(std::uint32_t set) {
    for (; set != 0; set &= set - 1)
      corner[static_cast<std::size_t>(count++)] = std::countr_zero(set);
  }
  [[nodiscard]] int at(int k) const {
    return corner[static_cast<std::size_t>(k < 0 ? k + count : (k < count ? k : k - count))];
  }
};

/// The least error over the mappings that it is shown.
class MappingSearch {
 public:
  MappingSearch(const CornerOutline& from, const CornerOutline& to, const Options& options)
      : from_(from), to_(to), options_(options) {
    const Corners laid_on = chosen_corners(to, all_of(to.count));
    to_sum_ = laid_on.sum;
    for (int k = 0; k < 2 * to.count; ++k) {
      to_x_[static_cast<std::size_t>(k)] = laid_on.x[static_cast<std::size_t>(k % to.count)];
      to_y_[static_cast<std::size_t>(k)] = laid_on.y[static_cast<std::size_t>(k % to.count)];
    }
    const Moments own = moments(to_x_.data(), to_y_.data(), to_sum_, laid_on);
    to_square_sum_ = own.xx + own.yy;
    perimeter_factor_ =
        options.alpha *
        (options.perimeter == PerimeterUnit::kRelative ? 1.0 / to.perimeter_m : 1.0);
    distortion_factor_ = 1.0 - options.alpha;
  }

  [[nodiscard]] const VertexMapping& best() const { return best_; }

  /// Every choice of corners that removals within the bound on area lead to, each once.
  void try_all_choices(LabelRule labels) {
    if (from_.count == to_.count) return try_shifts(all_of(from_.count), labels);
    seen_.fill(0);
    remove_corner(all_of(from_.count), labels);
  }

  /// Corner i on corner i, nothing distorted: outlines of the same corners about their means.
  void try_identity(LabelRule labels) {
    const std::uint32_t all = all_of(from_.count);
    if (from_.count != to_.count || from_.x != to_.x || from_.y != to_.y) return;
    if (labels == LabelRule::kMatched && !is_matched(types_of(all), 0)) return;
    const Point mean = to_sum_ / static_cast<double>(to_.count);
    best_ = {0.0, all, 0, Affine{}, mean, mean};
  }

  /// All cyclic shifts of a choice of corners.
  void try_shifts(std::uint32_t chosen, LabelRule labels) {
    const Corners corners = chosen_corners(from_, chosen);
    const Moments own = moments(corners.x.data(), corners.y.data(), corners.sum, corners);
    const double determinant = own.xx * own.yy - own.xy * own.yx;
    const double trace = own.xx + own.yy;
    if (!(determinant > kLineShare * trace * trace)) return;
    const Types types = types_of(chosen);
    for (int offset = 0; offset < to_.count; ++offset) {
      if (labels == LabelRule::kMatched && !is_matched(types, offset)) continue;
      try_mapping(corners, own, determinant, chosen, offset);
    }
  }

  /// A similar figure of the same area, centre on centre: defined for any two outlines.
  void try_similar_figure(std::uint32_t chosen) {
    const Corners corners = chosen_corners(from_, chosen);
    const double factor = std::sqrt(to_.area_m2 / from_.area_m2);
    for (int offset = 0; offset < to_.count; ++offset)
      take(corners, {factor, 0.0, 0.0, factor, {}}, chosen, offset);
  }

 private:
  struct Types {
    std::uint32_t street = 0;
    std::uint32_t property = 0;
  };

  [[nodiscard]] Types types_of(std::uint32_t chosen) const {
    Types out;
    for (std::uint32_t bit = 1; chosen != 0; chosen &= chosen - 1, bit <<= 1) {
      const std::uint32_t corner = chosen & (~chosen + 1U);
      if ((from_.street_corners & corner) != 0) out.street |= bit;
      if ((from_.property_corners & corner) != 0) out.property |= bit;
    }
    return out;
  }

  [[nodiscard]] bool is_matched(const Types& types, int offset) const {
    return (types.street & rotated(to_.property_corners, offset, to_.count)) == 0 &&
           (types.property & rotated(to_.street_corners, offset, to_.count)) == 0;
  }

  void remove_corner(std::uint32_t chosen, LabelRule labels) {
    if (std::popcount(chosen) == to_.count) return try_shifts(chosen, labels);
    const CornerList list(chosen);
    const double most = 2.0 * options_.area_loss_01 * from_.corner_area_m2;
    for (int k = 0; k < list.count; ++k) {
      if (twice_triangle(from_, list.at(k - 1), list.at(k), list.at(k + 1)) > most) continue;
      const std::uint32_t rest = chosen & ~(1U << list.at(k));
      std::uint64_t& word = seen_[rest / 64U];
      const std::uint64_t bit = std::uint64_t{1} << (rest % 64U);
      if ((word & bit) != 0) continue;
      word |= bit;
      remove_corner(rest, labels);
    }
  }

  /// The least-squares map is C_ba C_aa^-1.
  void try_mapping(const Corners& a, const Moments& c_aa, double determinant, std::uint32_t chosen,
                   int offset) {
    const Moments c = moments(&to_x_[static_cast<std::size_t>(offset)],
                              &to_y_[static_cast<std::size_t>(offset)], to_sum_, a);
    const double inverse = 1.0 / determinant;
    const Affine map{(c.xx * c_aa.yy - c.xy * c_aa.yx) * inverse,
                     (c.xy * c_aa.xx - c.xx * c_aa.xy) * inverse,
                     (c.yx * c_aa.yy - c.yy * c_aa.yx) * inverse,
                     (c.yy * c_aa.xx - c.yx * c_aa.xy) * inverse,
                     {}};
    // The summed distance is at least the root of the summed squares.
    const double residual = to_square_sum_ * (1.0 - kRoundingShare) -
                            (map.xx * c.xx + map.xy * c.xy + map.yx * c.yx + map.yy * c.yy);
    const double least = residual > 0.0 ? perimeter_factor_ * std::sqrt(residual) : 0.0;
    if (least < best_.error) take(a, map, chosen, offset, least);
  }

  /// Keeps the mapping if its error is the least so far. Terms are added up from the cheapest on,
  /// until the sum is too much.
  void take(const Corners& a, const Affine& map, std::uint32_t chosen, int offset,
            double least_mismatch = 0.0) {
    const Point u{map.xx, map.yx};
    const Point v{map.xy, map.yy};
    const double u_length = length(u);
    const double v_length = length(v);
    const double lengths = u_length * v_length;
    if (!(map.determinant() > kLeastSine * lengths)) return;
    const double stretch =
        options_.scale_weight * ratio_excess(length(u + v), std::numbers::sqrt2) +
        options_.aspect_weight * ratio_excess(u_length, v_length);
    // e_shear is at least the share of the right angle by which the angle differs from it, and that
    // at least 2 / pi of its sine.
    const double least_shear = 2.0 * std::numbers::inv_pi * std::abs(dot(u, v)) / lengths;
    if (!(distortion_factor_ * (stretch + options_.shear_weight * least_shear) + least_mismatch <
          best_.error))
      return;
    const double distortion =
        distortion_factor_ * (stretch + options_.shear_weight * shear_of(u, v));
    if (!(distortion + least_mismatch < best_.error)) return;
    const Point a_mean = a.sum / static_cast<double>(a.count);
    const Point b_mean = to_sum_ / static_cast<double>(a.count);
    const double error =
        distortion + perimeter_factor_ * mismatch_m(a, map, a_mean, b_mean, offset);
    if (error < best_.error) best_ = {error, chosen, offset, map, a_mean, b_mean};
  }

  /// Summed distance of corresponding corners, metres.
  [[nodiscard]] double mismatch_m(const Corners& a, const Affine& map, Point a_mean, Point b_mean,
                                  int offset) const {
    double sum = 0.0;
    for (int k = 0; k < a.count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const auto j = static_cast<std::size_t>(k + offset);
      const Point image = map.linear(Point{a.x[i], a.y[i]} - a_mean);
      sum += length(Point{to_x_[j], to_y_[j]} - b_mean - image);
    }
    return sum;
  }

  const CornerOutline& from_;
  const CornerOutline& to_;
  const Options& options_;
  // The second outline's corners, twice: a shift is where one begins.
  std::array<double, 2 * kMaxMappedCorners> to_x_;
  std::array<double, 2 * kMaxMappedCorners> to_y_;
  Point to_sum_;
  double to_square_sum_;
  double perimeter_factor_;
  double distortion_factor_;
  // One bit per set of corners.
  std::array<std::uint64_t, (1U << kMaxMappedCorners) / 64U> seen_;
  VertexMapping best_;
};

/// The corners that are left when those of the smallest triangles are removed one by one.
std::uint32_t largest_corners(const CornerOutline& outline, int count) {
  std::uint32_t chosen = all_of(outline.count);
  while (std::popcount(chosen) > count) {
    const CornerList list(chosen);
    int least = 0;
    const auto triangle = [&](int k) {
      return static_cast<float>(
          twice_triangle(outline, list.at(k - 1), list.at(k), list.at(k + 1)));
    };
    for (int k = 1; k < list.count; ++k) {
      if (triangle(k) < triangle(least)) least = k;
    }
    chosen &= ~(1U << list.at(least));
  }
  return chosen;
}

}  // namespace

VertexMapping best_vertex_mapping(const CornerOutline& from, const CornerOutline& to,
                                  const Options& options) {
  MappingSearch search(from, to, options);
  const auto is_found = [&] { return std::isfinite(search.best().error); };
  int given_up = 0;
  search.try_identity(options.labels);
  if (is_found()) return search.best();
  search.try_all_choices(options.labels);
  if (!is_found()) {
    ++given_up;
    if (options.labels == LabelRule::kMatched) search.try_all_choices(LabelRule::kIgnored);
  }
  if (!is_found()) {
    ++given_up;
    search.try_shifts(largest_corners(from, to.count), LabelRule::kIgnored);
  }
  if (!is_found()) {
    ++given_up;
    search.try_similar_figure(largest_corners(from, to.count));
  }
  VertexMapping best = search.best();
  best.error += given_up * AffineVertexSimilarity::kRelaxationPenalty;
  return best;
}

}  // namespace plat::similarity::detail
