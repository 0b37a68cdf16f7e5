#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/failure.h"
#include "core/working_grid.h"
#include "imagery/contour_chains_internal.h"
#include "parcels/contour_simplification.h"

namespace plat::imagery::detail {
namespace {

/// Lines nearer than this in the parameter are one: some micrometres of a parcel.
constexpr double kSameLine_01 = 1e-7;
/// A side at the end of a parcel is steep where it rises more than it runs.
constexpr double kSteepSlope = 1.0;
/// A step takes at most this share of the way to the next vertex.
constexpr double kStepShare_01 = 0.4;

/// The box's axis as a vector between vertices of the hull, or across one: exact on the grid.
Point exact_axis(const ParcelShape& shape) {
  const Ring hull = convex_hull(shape.polygon.outer);
  Point best = shape.box.axis;
  double best_cosine = -1.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point edge = hull[(i + 1) % hull.size()] - hull[i];
    for (const Point candidate : {edge, perpendicular(edge), -edge, -perpendicular(edge)}) {
      const double cosine = dot(normalized(candidate), shape.box.axis);
      if (cosine > best_cosine) {
        best_cosine = cosine;
        best = candidate;
      }
    }
  }
  return best;
}

/// From the vertex farthest from the middle, which is none to leave out.
Ring simplified(Ring ring, double tolerance_m) {
  const Point middle = centroid({ring, {}});
  const auto farthest = std::max_element(ring.begin(), ring.end(), [&](Point a, Point b) {
    return squared_length(a - middle) < squared_length(b - middle);
  });
  std::rotate(ring.begin(), farthest, ring.end());
  blocks::Block block;
  block.edges.emplace_back(ring.size());
  block.contour.outer = std::move(ring);
  return drop_collinear(parcels::simplify_contour(block, tolerance_m).polygon.outer);
}

std::size_t next(std::size_t i, std::size_t n) { return i + 1 == n ? 0 : i + 1; }
std::size_t previous(std::size_t i, std::size_t n) { return i == 0 ? n - 1 : i - 1; }

/// First and last vertex, counter-clockwise, of the run of vertices at one end of the axis.
struct EndSide {
  std::size_t first;
  std::size_t last;
};

EndSide end_side(const Ring& ring, std::size_t extreme) {
  EndSide side{extreme, extreme};
  const std::size_t n = ring.size();
  while (previous(side.first, n) != extreme && ring[previous(side.first, n)].x == ring[extreme].x)
    side.first = previous(side.first, n);
  while (next(side.last, n) != extreme && ring[next(side.last, n)].x == ring[extreme].x)
    side.last = next(side.last, n);
  return side;
}

/// A single end vertex becomes a side where an edge at it is steep: the one that rises more.
/// @param heading  the way across in which the contour passes this end: -1 at the start, +1 at the
///                 end
void extend_over_steep_edge(const Ring& ring, double heading, EndSide& side) {
  if (side.first != side.last) return;
  const std::size_t n = ring.size();
  const auto rise = [&](std::size_t from, std::size_t to) {
    const Point edge = ring[to] - ring[from];
    return heading * edge.y > kSteepSlope * std::abs(edge.x) ? heading * edge.y : 0.0;
  };
  const std::size_t before = previous(side.first, n);
  const std::size_t after = next(side.last, n);
  const double rise_before = rise(before, side.first);
  const double rise_after = rise(side.last, after);
  if (rise_before == 0.0 && rise_after == 0.0) return;
  if (rise_before >= rise_after) {
    side.first = before;
  } else {
    side.last = after;
  }
}

std::vector<ChainVertex> chain_between(const ContourProfile& profile, std::size_t from,
                                       std::size_t to) {
  std::vector<ChainVertex> chain;
  const std::size_t n = profile.ring.size();
  for (std::size_t i = from;; i = next(i, n)) {
    chain.push_back({0.0, profile.ring[i], profile.world[i]});
    if (i == to) return chain;
  }
}

/// @param inward  +1 on the lower chain, whose parcel lies above; -1 on the upper
bool set_lines(std::vector<ChainVertex>& chain, double inward, double lean) {
  const double begin = chain.front().across.x;
  const double run = chain.back().across.x - begin;
  if (chain.size() < 2 || !(run > 0.0)) return false;
  for (ChainVertex& vertex : chain) vertex.line = (vertex.across.x - begin) / run;
  chain.back().line = 1.0;
  const auto rise = [&](std::size_t i) {
    return inward * (chain[i + 1].across.y - chain[i].across.y);
  };
  const auto least = [&](double height, double reach) {
    return std::min(lean * std::abs(height) / run, kStepShare_01 * reach);
  };
  if (lean > 0.0) {
    // The parcel narrows: its wide part, before the step, lends the width.
    for (std::size_t i = chain.size() - 1; i-- > 1;) {
      if (rise(i) <= 0.0) continue;
      const double reach = std::max(0.0, chain[i + 1].line - chain[i - 1].line);
      chain[i].line = std::min(chain[i].line, chain[i + 1].line - least(rise(i), reach));
    }
    for (std::size_t i = 0; i + 2 < chain.size(); ++i) {
      if (rise(i) >= 0.0) continue;
      const double reach = std::max(0.0, chain[i + 2].line - chain[i].line);
      chain[i + 1].line = std::max(chain[i + 1].line, chain[i].line + least(rise(i), reach));
    }
  }
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    if (!(chain[i + 1].line - chain[i].line > kSameLine_01)) return false;
  }
  return true;
}

}  // namespace

ContourProfile profile_of(const ParcelShape& shape, ScanAxis axis, Symmetry symmetry,
                          double simplified_m) {
  ContourProfile profile;
  profile.world = drop_collinear(shape.polygon.outer);
  if (simplified_m > 0.0) profile.world = simplified(profile.world, simplified_m);
  expects(profile.world.size() >= 3, "a parcel has an area");
  // Turned and mirrored frames measure against the axis.
  const Point main = exact_axis(shape);
  const bool turns = symmetry == Symmetry::kTurned;
  const Point along = turns || symmetry == Symmetry::kMirroredAlong ? -main : main;
  const Point across =
      turns || symmetry == Symmetry::kMirroredAcross ? -perpendicular(main) : perpendicular(main);
  const Point x = axis == ScanAxis::kMain ? along : across;
  const Point y = axis == ScanAxis::kMain ? across : -along;
  if (is_mirrored(symmetry)) std::reverse(profile.world.begin(), profile.world.end());
  // A power of two, so that no comparison along the axis is rounded.
  const double scale = std::exp2(std::floor(std::log2(length(main))));
  const Point origin = profile.world.front();
  for (const Point p : profile.world)
    profile.ring.push_back({dot(p - origin, x) / scale, dot(p - origin, y) / scale});
  return profile;
}

bool is_monotone(const ContourProfile& profile) {
  const Ring& ring = profile.ring;
  const std::size_t n = ring.size();
  // Directions of the edges that run along the axis, cyclically: how often they change; and
  // perpendicular edges between two of the same direction are steps.
  int changes = 0;
  int last = 0;
  for (std::size_t i = n; i-- > 0 && last == 0;) {
    const double run = ring[next(i, n)].x - ring[i].x;
    last = run > 0.0 ? 1 : (run < 0.0 ? -1 : 0);
  }
  bool has_perpendicular = ring[0].x == ring[n - 1].x;
  for (std::size_t i = 0; i < n; ++i) {
    const double run = ring[next(i, n)].x - ring[i].x;
    if (run == 0.0) {
      has_perpendicular = true;
      continue;
    }
    const int sign = run > 0.0 ? 1 : -1;
    if (sign != last) {
      ++changes;
    } else if (has_perpendicular) {
      return false;
    }
    last = sign;
    has_perpendicular = false;
  }
  return changes == 2;
}

std::optional<ContourChains> chains_of(const ContourProfile& profile, ChainEnds ends, double lean) {
  const Ring& ring = profile.ring;
  const auto by_along = [](Point a, Point b) { return a.x < b.x; };
  const auto [low, high] = std::minmax_element(ring.begin(), ring.end(), by_along);
  EndSide start = end_side(ring, static_cast<std::size_t>(low - ring.begin()));
  EndSide end = end_side(ring, static_cast<std::size_t>(high - ring.begin()));
  if (ends == ChainEnds::kSides) {
    extend_over_steep_edge(ring, -1.0, start);
    extend_over_steep_edge(ring, 1.0, end);
  }
  // Counter-clockwise: down the start side, along the lower chain, up the end side, back above.
  if (start.last == end.first || end.last == start.first) return std::nullopt;
  ContourChains chains{chain_between(profile, start.last, end.first),
                       chain_between(profile, end.last, start.first)};
  std::reverse(chains.upper.begin(), chains.upper.end());
  if (chains.lower.size() + chains.upper.size() > ring.size() + 2) return std::nullopt;
  if (!set_lines(chains.lower, 1.0, lean) || !set_lines(chains.upper, -1.0, lean))
    return std::nullopt;
  return chains;
}

}  // namespace plat::imagery::detail
