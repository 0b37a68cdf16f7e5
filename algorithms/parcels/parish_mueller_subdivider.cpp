#include "parcels/parish_mueller_subdivider.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "parcels/recursive_division.h"

namespace plat::parcels {
namespace {

/// A vertex that turns by less does not end a side: a digitised curve has one side, not fifty.
constexpr double kSideTurn_rad = 0.175;  // 10 degrees
/// Pairs are tried, longest first, up to this many: a line through a concave lot may miss it.
constexpr std::size_t kMaxTries = 4;

/// The sides of a lot's outer ring as chords, in ring order; single edges where nothing turns.
std::vector<Segment> sides_of(const Lot& lot) {
  const Ring ring = polygon_of(lot).outer;
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (std::abs(turn_rad(ring, i)) >= kSideTurn_rad) corners.push_back(i);
  }
  if (corners.size() < 3) {
    corners.resize(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) corners[i] = i;
  }
  std::vector<Segment> sides;
  for (std::size_t k = 0; k < corners.size(); ++k)
    sides.push_back({ring[corners[k]], ring[corners[(k + 1) % corners.size()]]});
  return sides;
}

struct Pair {
  double length_m = 0.0;  ///< along which both sides run opposite each other
  SplitLine line;
};

/// The line across two sides that run against each other, in the middle of where they do but for
/// the share; nothing where they do not face each other.
std::optional<Pair> pair_of(const Segment& s, const Segment& t, double share) {
  const Point along = normalized(normalized(s.b - s.a) + normalized(t.a - t.b));
  const auto at = [&](Point p) { return dot(p - s.a, along); };
  const double from = std::max(at(s.a), at(t.b));
  const double to = std::min(at(s.b), at(t.a));
  if (to - from < kStreetAccess_m) return std::nullopt;
  return Pair{to - from, {s.a + (from + share * (to - from)) * along, perpendicular(along)}};
}

class ParishMuellerRule {
 public:
  explicit ParishMuellerRule(const ParishMuellerSubdivider::Options& options)
      : options_(options),
        cos_parallel_(std::cos(options.parallel_within_deg * std::numbers::pi / 180.0)) {}

  std::optional<SplitResult> operator()(const Lot& lot, std::uint64_t seed) const {
    if (area_m2(lot) <= options_.area_max_m2) return std::nullopt;
    const double share = 0.5 + options_.irregularity * Rng(seed).uniform(-1.0, 1.0);
    const std::vector<Segment> sides = sides_of(lot);
    std::vector<Pair> pairs = parallel_pairs(sides, share);
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.length_m > b.length_m; });
    pairs.resize(std::min(pairs.size(), kMaxTries));
    pairs.push_back(across_longest(sides, share));
    for (const Pair& pair : pairs) {
      SplitResult result = split(lot, pair.line);
      if (result.lots.size() >= 2) return result;
    }
    return std::nullopt;
  }

 private:
  /// Sides that run against each other: the boundary goes round the lot between them.
  [[nodiscard]] std::vector<Pair> parallel_pairs(const std::vector<Segment>& sides,
                                                 double share) const {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Point along = sides[i].b - sides[i].a;
      for (std::size_t j = i + 2; j < sides.size(); ++j) {
        if (i == 0 && j + 1 == sides.size()) continue;  // meet in a corner, as does i + 1
        const Point back = sides[j].a - sides[j].b;
        const double lengths = length(sides[i]) * length(sides[j]);
        if (dot(along, back) < cos_parallel_ * lengths) continue;
        if (const auto pair = pair_of(sides[i], sides[j], share)) pairs.push_back(*pair);
      }
    }
    return pairs;
  }

  static Pair across_longest(const std::vector<Segment>& sides, double share) {
    const Segment& longest =
        *std::max_element(sides.begin(), sides.end(),
                          [](const Segment& a, const Segment& b) { return length(a) < length(b); });
    return {length(longest),
            {lerp(longest.a, longest.b, share), perpendicular(normalized(longest.b - longest.a))}};
  }

  const ParishMuellerSubdivider::Options& options_;
  double cos_parallel_;
};

}  // namespace

Expected<std::vector<Parcel>> ParishMuellerSubdivider::subdivide(const blocks::Block& given,
                                                                 Rng& rng) const {
  const blocks::Block block = blocks::with_streets_assumed(given);
  auto partition = divide_recursively(block, rng(), ParishMuellerRule(options_), "area_max_m2");
  if (!partition) return tl::unexpected<Failure>(partition.error());
  if (options_.interior == Interior::kJoin) {
    partition->join_while(
        [&](std::uint32_t region) { return partition->frontage_m(region) < kStreetAccess_m; });
  }
  return partition->parcels();
}

ParishMuellerSubdivider ParishMuellerSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  const Bounds area =
      bounds_around(style.area_mean_m2, style.area_deviation_m2, o.fit_deviations, 1.0);
  o.area_max_m2 = style.count <= 1 ? kUndivided_m2 : area.high;
  return ParishMuellerSubdivider(o);
}

}  // namespace plat::parcels
