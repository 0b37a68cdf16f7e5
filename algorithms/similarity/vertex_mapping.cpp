#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "similarity/affine_distortion.h"
#include "similarity/corner_choices_internal.h"
#include "similarity/vertex_mapping_internal.h"

namespace plat::similarity::detail {
namespace {

using Options = AffineVertexSimilarity::Options;

/// Corners lie on a line where the determinant of their second moments is at most this share of the
/// square of its trace: a thousandth of a millimetre over a metre.
constexpr double kLineShare = 1e-12;
/// A map is singular where the sine of the angle between its columns is at most this.
constexpr double kLeastSine = 1e-9;
/// Of the sum of squares, what may be lost to rounding where the residual is taken as a difference.
constexpr double kRoundingShare = 1e-12;

/// A set of `count` corners, renamed: corner i becomes corner i - by.
constexpr std::uint32_t rotated(std::uint32_t corners, std::size_t by, std::size_t count) {
  return ((corners >> by) | (corners << (count - by))) & all_of(count);
}

/// A matrix of two rows.
struct Matrix {
  double xx = 0.0;
  double xy = 0.0;
  double yx = 0.0;
  double yy = 0.0;

  [[nodiscard]] double determinant() const { return xx * yy - xy * yx; }
  /// Adds p q^T.
  void add(Point p, Point q) {
    xx += p.x * q.x;
    xy += p.x * q.y;
    yx += p.y * q.x;
    yy += p.y * q.y;
  }
  /// Of second moments; nullopt where the points lie on a line.
  [[nodiscard]] std::optional<Matrix> inverse_of_moments() const {
    const double d = determinant();
    const double trace = xx + yy;
    if (!(d > kLineShare * trace * trace)) return std::nullopt;
    return Matrix{yy / d, -xy / d, -yx / d, xx / d};
  }
  friend Matrix operator*(const Matrix& a, const Matrix& b) {
    return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
            a.yx * b.xy + a.yy * b.yy};
  }
  [[nodiscard]] double product_sum(const Matrix& other) const {
    return xx * other.xx + xy * other.xy + yx * other.yx + yy * other.yy;
  }
};

/// A choice of corners, about their mean.
struct Choice {
  std::uint32_t corners = 0;  ///< the set
  std::size_t count = 0;
  std::array<Point, kMaxMappedCorners> at;
  Point mean;
};

/// The sum of p q^T over the choice's corners q and as many points p: the second moments about the
/// means, whatever the mean of p, as that of q is zero.
Matrix moments(const Point* p, const Choice& q) {
  Matrix m;
  for (std::size_t k = 0; k < q.count; ++k) m.add(p[k], q.at[k]);
  return m;
}

Choice choose(const CornerOutline& outline, std::uint32_t corners) {
  Choice out{corners, 0, {}, {}};
  for (std::uint32_t rest = corners; rest != 0; rest &= rest - 1) {
    const Point p = outline.corners[static_cast<std::size_t>(std::countr_zero(rest))];
    out.at[out.count++] = p;
    out.mean = out.mean + p;
  }
  out.mean = out.mean / static_cast<double>(out.count);
  for (std::size_t k = 0; k < out.count; ++k) out.at[k] = out.at[k] - out.mean;
  return out;
}

/// The least error over the mappings that it is shown.
class MappingSearch {
 public:
  MappingSearch(const CornerOutline& from, const CornerOutline& to, const Options& options)
      : from_(from),
        to_(to),
        options_(options),
        distortion_factor_(1.0 - options.alpha),
        mismatch_factor_(options.perimeter == PerimeterUnit::kRelative
                             ? options.alpha / to.perimeter_m
                             : options.alpha),
        laid_on_mean_(choose(to, all_of(to.count)).mean) {
    for (std::size_t k = 0; k < to.count; ++k) {
      laid_on_[k] = laid_on_[k + to.count] = to.corners[k] - laid_on_mean_;
      laid_on_squares_ += squared_length(laid_on_[k]);
    }
  }

  [[nodiscard]] const VertexMapping& best() const { return best_; }
  [[nodiscard]] bool is_found() const { return std::isfinite(best_.error); }
  /// Whether a mapping was rejected by labels.
  [[nodiscard]] bool has_mismatch() const { return has_mismatch_; }

  /// Corner i on corner i, nothing distorted: outlines of the same corners about their means.
  void try_identity(LabelRule labels) {
    const std::uint32_t all = all_of(from_.count);
    if (from_.count != to_.count || from_.corners != to_.corners) return;
    if (!is_permitted(types_of(all), 0, labels)) return;
    best_ = {0.0, all, 0, Affine{}, laid_on_mean_, laid_on_mean_};
  }

  /// Every choice of corners that removals within the bound on area lead to.
  void try_all_choices(LabelRule labels) {
    for (const std::uint16_t corners : choices_of(from_, to_.count)) try_shifts(corners, labels);
  }

  /// All cyclic shifts of a choice of corners: the least-squares map is C_ba C_aa^-1.
  void try_shifts(std::uint32_t corners, LabelRule labels) {
    const Choice a = choose(from_, corners);
    const auto inverse = moments(a.at.data(), a).inverse_of_moments();
    if (!inverse) return;
    const Types types = types_of(corners);
    for (std::size_t offset = 0; offset < to_.count; ++offset) {
      if (is_permitted(types, offset, labels)) try_shift(a, *inverse, offset);
    }
  }

  /// A similar figure of the same area, centre on centre: defined for any two outlines.
  void try_similar_figure(std::uint32_t corners) {
    const Choice a = choose(from_, corners);
    const double factor = std::sqrt(to_.area_m2 / from_.area_m2);
    for (std::size_t offset = 0; offset < to_.count; ++offset)
      take(a, {factor, 0.0, 0.0, factor}, offset, 0.0);
  }

 private:
  /// The types of chosen corners: bit k is the k-th.
  struct Types {
    std::uint32_t street = 0;
    std::uint32_t property = 0;
  };

  [[nodiscard]] Types types_of(std::uint32_t corners) const {
    Types out;
    for (std::uint32_t bit = 1; corners != 0; corners &= corners - 1, bit <<= 1) {
      const std::uint32_t first = corners & (~corners + 1U);
      if ((from_.street_corners & first) != 0) out.street |= bit;
      if ((from_.property_corners & first) != 0) out.property |= bit;
    }
    return out;
  }

  bool is_permitted(const Types& types, std::size_t offset, LabelRule labels) {
    if (labels == LabelRule::kIgnored) return true;
    const bool is_matched =
        (types.street & rotated(to_.property_corners, offset, to_.count)) == 0 &&
        (types.property & rotated(to_.street_corners, offset, to_.count)) == 0;
    has_mismatch_ = has_mismatch_ || !is_matched;
    return is_matched;
  }

  void try_shift(const Choice& a, const Matrix& inverse, std::size_t offset) {
    const Matrix c = moments(&laid_on_[offset], a);
    if (!(c.determinant() > 0.0)) return;
    const Matrix map = c * inverse;
    // The summed distance is at least the root of the summed squares.
    const double residual = laid_on_squares_ * (1.0 - kRoundingShare) - map.product_sum(c);
    if (residual > bounds_.residual || !is_within_bounds(map)) return;
    take(a, map, offset, residual > 0.0 ? mismatch_factor_ * std::sqrt(residual) : 0.0);
  }

  /// Keeps the mapping if its error is the least so far. Terms are added up from the cheapest on,
  /// until the sum is too much.
  void take(const Choice& a, const Matrix& map, std::size_t offset, double least_mismatch) {
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
    const double least = distortion_factor_ * (stretch + options_.shear_weight * least_shear);
    if (!(least + least_mismatch < best_.error)) return;
    const double distortion =
        distortion_factor_ * (stretch + options_.shear_weight * shear_of(u, v));
    if (!(distortion + least_mismatch < best_.error)) return;
    const Affine linear{map.xx, map.xy, map.yx, map.yy, {}};
    const double error = distortion + mismatch_factor_ * mismatch_m(a, linear, offset);
    if (!(error < best_.error)) return;
    best_ = {error, a.corners, offset, linear, a.mean, laid_on_mean_};
    set_bounds();
  }

  /// What one term alone must not exceed, in squares: to know it takes no root and no division.
  struct Bounds {
    double residual = std::numeric_limits<double>::infinity();
    double scale = std::numeric_limits<double>::infinity();
    double aspect = std::numeric_limits<double>::infinity();
    double sine = std::numeric_limits<double>::infinity();
  };

  void set_bounds() {
    const auto squared = [](double x) { return x * x; };
    // A weight of zero bounds nothing: the quotient is infinite.
    const double left = best_.error * (1.0 + kRoundingShare);
    bounds_.residual = squared(left / mismatch_factor_);
    bounds_.scale = squared(1.0 + left / (distortion_factor_ * options_.scale_weight));
    bounds_.aspect = squared(1.0 + left / (distortion_factor_ * options_.aspect_weight));
    bounds_.sine =
        squared(0.5 * std::numbers::pi * left / (distortion_factor_ * options_.shear_weight));
  }

  [[nodiscard]] bool is_within_bounds(const Matrix& map) const {
    const Point u{map.xx, map.yx};
    const Point v{map.xy, map.yy};
    const double uu = squared_length(u);
    const double vv = squared_length(v);
    const double sum = squared_length(u + v);
    const double uv = dot(u, v);
    return std::max(uu, vv) <= bounds_.aspect * std::min(uu, vv) &&
           std::max(sum, 2.0) <= bounds_.scale * std::min(sum, 2.0) &&
           uv * uv <= bounds_.sine * uu * vv;
  }

  /// Summed distance of corresponding corners, metres.
  [[nodiscard]] double mismatch_m(const Choice& a, const Affine& map, std::size_t offset) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.count; ++k)
      sum += length(laid_on_[k + offset] - map.linear(a.at[k]));
    return sum;
  }

  const CornerOutline& from_;
  const CornerOutline& to_;
  const Options& options_;
  double distortion_factor_;
  double mismatch_factor_;
  // The corners laid on about their mean, twice: a shift is where one begins.
  std::array<Point, 2 * kMaxMappedCorners> laid_on_;
  Point laid_on_mean_;
  double laid_on_squares_ = 0.0;
  bool has_mismatch_ = false;
  VertexMapping best_;
  Bounds bounds_;
};

}  // namespace

VertexMapping best_vertex_mapping(const CornerOutline& from, const CornerOutline& to,
                                  const Options& options) {
  MappingSearch search(from, to, options);
  search.try_identity(options.labels);
  if (search.is_found()) return search.best();
  int given_up = 0;
  search.try_all_choices(options.labels);
  if (!search.is_found()) {
    ++given_up;
    if (search.has_mismatch()) search.try_all_choices(LabelRule::kIgnored);
  }
  if (!search.is_found()) {
    ++given_up;
    search.try_shifts(largest_corners(from, to.count), LabelRule::kIgnored);
  }
  const bool is_least_squares = search.is_found();
  if (!is_least_squares) {
    ++given_up;
    search.try_similar_figure(largest_corners(from, to.count));
  }
  VertexMapping best = search.best();
  best.is_least_squares = is_least_squares;
  best.error += given_up * AffineVertexSimilarity::kRelaxationPenalty;
  return best;
}

std::optional<Affine> least_squares_map(const std::vector<std::pair<Point, Point>>& pairs) {
  Point from_mean;
  Point to_mean;
  for (const auto& [from, to] : pairs) {
    from_mean = from_mean + from / static_cast<double>(pairs.size());
    to_mean = to_mean + to / static_cast<double>(pairs.size());
  }
  Matrix own;
  Matrix c;
  for (const auto& [from, to] : pairs) {
    own.add(from - from_mean, from - from_mean);
    c.add(to - to_mean, from - from_mean);
  }
  const auto inverse = own.inverse_of_moments();
  if (!inverse) return std::nullopt;
  const Matrix map = c * *inverse;
  Affine out{map.xx, map.xy, map.yx, map.yy, {}};
  out.shift = to_mean - out.linear(from_mean);
  return out;
}

}  // namespace plat::similarity::detail
