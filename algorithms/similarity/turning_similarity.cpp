#include "similarity/turning_similarity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "similarity/rigid_alignment.h"
#include "similarity/shape_admission.h"

namespace plat::similarity {
namespace {

constexpr std::size_t kMaxVertices = 2000;
constexpr double kFullTurn_rad = 2.0 * std::numbers::pi;
/// Corners nearer to each other than this share of the outline meet: far below the working grid's
/// step in the longest outline, far above the rounding of a share.
constexpr double kMeeting_01 = 1e-11;
/// Starts that are as good as the best up to this, the rounding of a sum over all starts, are
/// integrated one by one.
constexpr double kAsGood_rad2 = 1e-9;

using Prepared = TurningSimilarity::Prepared;

/// A start of `a` at which one of its corners meets one of b's. The product of the two turns is
/// what the derivative of the covariance loses there.
struct Meeting {
  double start_01 = 0.0;
  double product_rad2 = 0.0;
};

double fraction(double x) {
  const double out = x - std::floor(x);
  return out < 1.0 ? out : 0.0;
}

std::vector<Meeting> meetings(const Prepared& a, const Prepared& b) {
  std::vector<Meeting> out;
  out.reserve(a.starts_01.size() * b.starts_01.size());
  for (std::size_t i = 0; i < a.starts_01.size(); ++i)
    for (std::size_t j = 0; j < b.starts_01.size(); ++j)
      out.push_back({fraction(a.starts_01[i] - b.starts_01[j]), a.turns_rad[i] * b.turns_rad[j]});
  std::ranges::sort(out, {}, &Meeting::start_01);
  return out;
}

/// Starts of `a` of which one is the best. Turning functions less a full turn over the length are
/// periodic; their mean squared difference, for the best rotation, is the sum of their variances
/// less twice their covariance C(t). Between meetings C is a parabola, C'' = (2 pi)^2, and C' loses
/// each meeting's product, so that the largest C lies at a meeting; that C is periodic gives C'(0).
std::vector<double> best_starts(const std::vector<Meeting>& meetings) {
  constexpr double kCurvature = kFullTurn_rad * kFullTurn_rad;
  double slope = -0.5 * kCurvature;
  for (const Meeting& meeting : meetings) slope += meeting.product_rad2 * (1.0 - meeting.start_01);
  double covariance = 0.0;  // up to a constant
  double at = 0.0;
  double largest = -std::numeric_limits<double>::infinity();
  std::vector<double> covariances;
  covariances.reserve(meetings.size());
  for (const Meeting& meeting : meetings) {
    const double step = meeting.start_01 - at;
    covariance += slope * step + 0.5 * kCurvature * step * step;
    slope += kCurvature * step - meeting.product_rad2;
    at = meeting.start_01;
    covariances.push_back(covariance);
    largest = std::max(largest, covariance);
  }
  std::vector<double> out;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    const bool is_new = out.empty() || meetings[i].start_01 - out.back() > kMeeting_01;
    if (covariances[i] >= largest - kAsGood_rad2 && is_new) out.push_back(meetings[i].start_01);
  }
  return out;
}

/// Calls visit(share, jump) at every corner of `b`, and of `a` from this start on, in order of the
/// share of the length; the jump is that of a's direction less b's.
template <class Visit>
void walk_both(const Prepared& a, const Prepared& b, double start_01, Visit visit) {
  const std::size_t n = a.starts_01.size();
  const auto behind = std::ranges::lower_bound(a.starts_01, start_01);
  const auto first = static_cast<std::size_t>(behind - a.starts_01.begin());
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < n || j < b.starts_01.size()) {
    const std::size_t corner = (first + i) % n;
    const double of_a = a.starts_01[corner] - start_01 + (first + i < n ? 0.0 : 1.0);
    if (j == b.starts_01.size() || (i < n && of_a <= b.starts_01[j])) {
      visit(of_a, a.turns_rad[corner]);
      ++i;
    } else {
      visit(b.starts_01[j], -b.turns_rad[j]);
      ++j;
    }
  }
}

/// The variance of the difference in direction: what is left of it after the best rotation.
double variance_rad2(const Prepared& a, const Prepared& b, double start_01) {
  std::vector<std::pair<double, double>> pieces;  // length and difference
  pieces.reserve(a.starts_01.size() + b.starts_01.size() + 1);
  double difference = 0.0;
  double at = 0.0;
  const auto go_to = [&](double share) {
    // Where corners meet, rounding alone lies between them.
    if (share - at > kMeeting_01) pieces.emplace_back(share - at, difference);
    at = share;
  };
  walk_both(a, b, start_01, [&](double share, double jump) {
    go_to(share);
    difference += jump;
  });
  go_to(1.0);
  double mean = 0.0;
  double total = 0.0;
  for (const auto& [share, value] : pieces) {
    mean += share * value;
    total += share;
  }
  mean /= total;
  double sum = 0.0;
  for (const auto& [share, value] : pieces) sum += share * (value - mean) * (value - mean);
  return sum / total;
}

struct Best {
  double variance_rad2 = std::numeric_limits<double>::infinity();
  double start_01 = 0.0;
};

Best best_start(const Prepared& a, const Prepared& b) {
  Best best;
  for (const double start_01 : best_starts(meetings(a, b))) {
    const double variance = variance_rad2(a, b, start_01);
    if (variance < best.variance_rad2) best = {variance, start_01};
  }
  return best;
}

double distance_of(const Best& best, const Prepared& a, const Prepared& b, double size_weight) {
  return std::sqrt(best.variance_rad2) +
         size_weight * std::abs(std::log(a.outline.length_m() / b.outline.length_m()));
}

}  // namespace

Expected<Prepared> TurningSimilarity::prepare(const LabelledShape& shape) const {
  if (auto defect = find_shape_defect(shape)) return tl::unexpected(std::move(*defect));
  const Ring& ring = shape.polygon.outer;
  if (ring.size() > kMaxVertices)
    return fail(FailureCode::kTooManyVertices,
                fmt::format("{} vertices, at most {}", ring.size(), kMaxVertices));
  Prepared out{OutlineWalk(ring), {}, {}};
  double sum_rad = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    out.starts_01.push_back(out.outline.start_m(i) / out.outline.length_m());
    out.turns_rad.push_back(turn_rad(ring, i));
    sum_rad += out.turns_rad.back();
  }
  // A simple outline turns once; what rounding adds to that would grow with every lap.
  const double excess_rad = (sum_rad - kFullTurn_rad) / static_cast<double>(ring.size());
  for (double& turn : out.turns_rad) turn -= excess_rad;
  return out;
}

double TurningSimilarity::distance(const Prepared& a, const Prepared& b) const {
  return distance_of(best_start(a, b), a, b, options_.size_weight);
}

ShapeComparison TurningSimilarity::compare(const Prepared& a, const Prepared& b) const {
  const Best best = best_start(a, b);
  ShapeComparison out{distance_of(best, a, b, options_.size_weight), {}, {}};
  walk_both(a, b, best.start_01, [&](double share, double) {
    const double of_a = fraction(best.start_01 + share) * a.outline.length_m();
    const double of_b = fraction(share) * b.outline.length_m();
    out.correspondence.emplace_back(a.outline.origin() + a.outline.at(of_a),
                                    b.outline.origin() + b.outline.at(of_b));
  });
  out.transformation = rigid_alignment(out.correspondence);
  return out;
}

SimilarityClaims TurningSimilarity::claims() const {
  return {.is_symmetric = true,
          .rotation = true,
          .common_scale = true,
          .scale = options_.size_weight == 0.0,
          .collinear_vertices = true};
}

}  // namespace plat::similarity
