#include "parcels/recursive_subdivider.h"

#include <algorithm>
#include <cmath>

#include "parcels/recursive_division.h"

namespace plat::parcels {
namespace {

/// A lot above the largest size tries its edges in the order of the criterion, up to this many.
constexpr std::size_t kMaxTries = 8;

struct Candidate {
  double score = 0.0;
  Segment edge;
};

/// The criterion [GMN, Sec. 4.2]: long edges, and edges whose neighbours stand at right angles.
std::vector<Candidate> candidates_of(const Lot& lot, double squareness, std::size_t count) {
  const Ring ring = polygon_of(lot).outer;
  const std::size_t n = ring.size();
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < n; ++i) {
    const Segment edge{ring[i], ring[(i + 1) % n]};
    const double sines =
        std::abs(std::sin(turn_rad(ring, i))) + std::abs(std::sin(turn_rad(ring, (i + 1) % n)));
    out.push_back({length(edge) * (1.0 + squareness * 0.5 * sines), edge});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  out.resize(std::min(out.size(), count));
  return out;
}

class RecursiveRule {
 public:
  /// @param block_seed  the seed of the whole block, which is split along its box
  RecursiveRule(const RecursiveSubdivider::Options& options, std::uint64_t block_seed)
      : options_(options), block_seed_(block_seed) {}

  std::optional<SplitResult> operator()(const Lot& lot, std::uint64_t seed) const {
    Rng rng(seed);
    const double share = 0.5 + options_.jitter * rng.uniform(-1.0, 1.0);
    const bool may_stop = rng.uniform_01() < options_.stop_early;
    const bool is_large = area_m2(lot) > options_.area_max_m2;
    if (may_stop && !is_large) return std::nullopt;
    if (seed == block_seed_) {
      if (auto result = allowed(lot, along_box(lot, share))) return result;
    }
    const std::size_t tries = is_large ? kMaxTries : 1;
    for (const Candidate& candidate : candidates_of(lot, options_.squareness, tries)) {
      const Segment& edge = candidate.edge;
      const SplitLine line{lerp(edge.a, edge.b, share), perpendicular(normalized(edge.b - edge.a))};
      if (auto result = allowed(lot, line)) return result;
    }
    return std::nullopt;
  }

 private:
  static SplitLine along_box(const Lot& lot, double share) {
    const OrientedBox box = minimum_area_box(lot);
    return {box.center + (share - 0.5) * box.width_m * perpendicular(box.axis), box.axis};
  }

  [[nodiscard]] std::optional<SplitResult> allowed(const Lot& lot, const SplitLine& line) const {
    SplitResult result = split(lot, line);
    if (result.lots.size() < 2 || !keeps_street_access(lot, result)) return std::nullopt;
    const bool is_too_small =
        std::any_of(result.lots.begin(), result.lots.end(), [&](const Lot& part) {
          const OrientedBox box = minimum_area_box(part);
          return box.width_m < options_.width_min_m || box.area_m2() < options_.area_min_m2;
        });
    if (is_too_small) return std::nullopt;
    return result;
  }

  const RecursiveSubdivider::Options& options_;
  std::uint64_t block_seed_;
};

}  // namespace

Expected<std::vector<Parcel>> RecursiveSubdivider::subdivide(const blocks::Block& given,
                                                             Rng& rng) const {
  const blocks::Block block = blocks::with_streets_assumed(given);
  const std::uint64_t seed = rng();
  return divide_recursively(block, seed, RecursiveRule(options_, seed),
                            "area_min_m2 or width_min_m")
      .map([](const BlockPartition& partition) { return partition.parcels(); });
}

RecursiveSubdivider RecursiveSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  const Bounds area =
      bounds_around(style.area_mean_m2, style.area_deviation_m2, o.fit_deviations, 1.0);
  const Bounds width =
      bounds_around(style.width_mean_m, style.width_deviation_m, o.fit_deviations, 0.5);
  o.area_min_m2 = style.count <= 1 ? kUndivided_m2 : area.low;
  o.area_max_m2 = area.high;
  o.width_min_m = width.low;
  return RecursiveSubdivider(o);
}

}  // namespace plat::parcels
