#include <algorithm>
#include <cmath>
#include <optional>

#include "blocks/contour_offset_internal.h"
#include "core/working_grid.h"

namespace plat::blocks::detail {
namespace {

/// A mitre longer than this many half widths is cut off: the corner is a needle or a dead end.
constexpr double kMitreLimit = 3.0;

/// The contour's points at the node between two sides: where the offset line of the first ends
/// (front), and where that of the second starts (back).
///
///   left turn, widths alike        left turn, first much wider      right turn
///        |                              ____                             ____p
///     ___p                              d   |q____ e                     d   |e
///     ---v                              ----v-----                       ---v|
std::vector<Point> corner_points(const StreetSide& first, const StreetSide& second) {
  const Point v = second.segment.a;
  const Point u = normalized(first.segment.b - first.segment.a);
  const Point w = normalized(second.segment.b - second.segment.a);
  const double d = first.half_width_m;
  const double e = second.half_width_m;
  const Point first_end = v + d * perpendicular(u);
  const Point second_start = v + e * perpendicular(w);
  const double sine = cross(u, w);
  const double cosine = dot(u, w);
  // Below this the offset lines are parallel for all distances that occur.
  constexpr double kParallel = 1e-6;
  if (std::abs(sine) < kParallel) return {first_end, second_start};
  // The lines meet at first_end + t u = second_start + s w.
  const double t = (d * cosine - e) / sine;
  const double s = (d - e * cosine) / sine;
  const Point meeting = first_end + t * u;
  if (sine > 0.0) {
    if (t > 0.0) return {first_end, v + (e / cosine) * perpendicular(u)};
    if (s < 0.0) return {v + (d / cosine) * perpendicular(w), second_start};
    return {meeting};
  }
  const bool is_needle = distance(meeting, v) > kMitreLimit * std::max(d, e);
  if (t < 0.0 || s > 0.0 || is_needle) return {first_end, second_start};
  return {meeting};
}

/// Where the offset lines of two sides meet that have lost those between them, which turn left.
std::optional<Point> meeting_point(const StreetSide& first, const StreetSide& second) {
  const Point u = normalized(first.segment.b - first.segment.a);
  const Point w = normalized(second.segment.b - second.segment.a);
  const double sine = cross(u, w);
  // Flatter lines meet far away: such a place is cut instead.
  constexpr double kFlat = 1e-3;
  if (sine < kFlat) return std::nullopt;
  const Point p = first.segment.b + first.half_width_m * perpendicular(u);
  const Point q = second.segment.a + second.half_width_m * perpendicular(w);
  return p + (cross(q - p, w) / sine) * u;
}

/// Whether the ring keeps the half width of a side that has no edge in it.
bool keeps_away(const Ring& ring, const StreetSide& side) {
  const double least_m = side.half_width_m - 2.0 * kGridStep_m;
  const auto& [a, b] = side.segment;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Segment edge{ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]};
    const double d = std::min({distance(edge, a), distance(edge, b), distance(side.segment, edge.a),
                               distance(side.segment, edge.b)});
    if (d < least_m) return false;
  }
  return true;
}

/// The offset ring of the sides that are left, one corner after the other.
class Inset {
 public:
  explicit Inset(std::span<const StreetSide> sides) : sides_(sides) {
    for (std::size_t i = 0; i < sides.size(); ++i) left_.push_back(i);
  }

  Ring run() {
    while (left_.size() >= 3) {
      if (!join_corners()) return {};
      const std::optional<std::size_t> shortest = vanished();
      if (!shortest) return is_free() ? ring_ : Ring{};
      dropped_.push_back(left_[*shortest]);
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(*shortest));
    }
    return {};
  }

 private:
  bool join_corners() {
    ring_.clear();
    at_.clear();
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const std::size_t before = left_[(k + left_.size() - 1) % left_.size()];
      std::vector<Point> corner;
      if ((before + 1) % sides_.size() == left_[k]) {
        corner = corner_points(sides_[before], sides_[left_[k]]);
      } else if (const auto meeting = meeting_point(sides_[before], sides_[left_[k]])) {
        corner = {*meeting};
      } else {
        return false;
      }
      at_.emplace_back(ring_.size(), ring_.size() + corner.size() - 1);
      ring_.insert(ring_.end(), corner.begin(), corner.end());
    }
    return true;
  }

  /// The side that is left with the least length, if that is none.
  [[nodiscard]] std::optional<std::size_t> vanished() const {
    std::optional<std::size_t> out;
    double least = 2.0 * kGridStep_m;
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const Point run = ring_[at_[(k + 1) % left_.size()].first] - ring_[at_[k].second];
      const Segment& side = sides_[left_[k]].segment;
      const double along = dot(run, normalized(side.b - side.a));
      if (along >= least) continue;
      least = along;
      out = k;
    }
    return out;
  }

  [[nodiscard]] bool is_free() const {
    return std::all_of(dropped_.begin(), dropped_.end(),
                       [&](std::size_t i) { return keeps_away(ring_, sides_[i]); });
  }

  std::span<const StreetSide> sides_;
  std::vector<std::size_t> left_;
  std::vector<std::size_t> dropped_;
  Ring ring_;
  std::vector<std::pair<std::size_t, std::size_t>> at_;  ///< first and last point before each side
};

}  // namespace

Ring inset_ring(std::span<const StreetSide> sides) { return Inset(sides).run(); }

std::vector<Polygon> street_strips(std::span<const StreetSide> walk,
                                   const std::vector<bool>& is_wanted) {
  std::vector<Polygon> out;
  const std::size_t n = walk.size();
  const auto wants = [&](std::size_t i) { return is_wanted.empty() || is_wanted[i]; };
  for (std::size_t i = 0; i < n; ++i) {
    const StreetSide& side = walk[i];
    const auto& [a, b] = side.segment;
    const Point across = side.half_width_m * perpendicular(normalized(b - a));
    if (wants(i)) out.push_back({{a, b, b + across, a + across}, {}});
    const StreetSide& before = walk[(i + n - 1) % n];
    const Point arriving = before.segment.b - before.segment.a;
    if (cross(arriving, b - a) >= 0.0 || !(wants(i) || wants((i + n - 1) % n))) continue;
    const Point end = a + before.half_width_m * perpendicular(normalized(arriving));
    Ring wedge{a, a + across};
    const std::vector<Point> corner = corner_points(before, side);
    if (corner.size() == 1) wedge.push_back(corner.front());
    wedge.push_back(end);
    out.push_back({std::move(wedge), {}});
  }
  return out;
}

}  // namespace plat::blocks::detail
