#include <algorithm>
#include <cmath>

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

}  // namespace

Ring inset_ring(std::span<const StreetSide> ring) {
  const std::size_t n = ring.size();
  Ring out;
  std::vector<std::pair<std::size_t, std::size_t>> at;  // first and last point at node i
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<Point> corner = corner_points(ring[(i + n - 1) % n], ring[i]);
    at.emplace_back(out.size(), out.size() + corner.size() - 1);
    out.insert(out.end(), corner.begin(), corner.end());
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Point run = out[at[(i + 1) % n].first] - out[at[i].second];
    const Point along = normalized(ring[i].segment.b - ring[i].segment.a);
    if (dot(run, along) < 2.0 * kGridStep_m) return {};
  }
  return out;
}

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
