#include "parcels/border_voronoi_subdivider.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/working_grid.h"
#include "parcels/fronts.h"
#include "parcels/random_divisions.h"
#include "parcels/voronoi_partition.h"

namespace plat::parcels {
namespace {

/// How often a setback is halved before a site is given up: the tip of a spike.
constexpr int kMaxHalvings = 10;

/// The site behind a place on the front: at the setback, or at a part of it where that is outside
/// or nearer to another side of the block than to its own.
Point site_behind(const Polygon& contour, const FrontPlace& place, double setback_m) {
  double depth = setback_m;
  for (int i = 0; i < kMaxHalvings; ++i, depth *= 0.5) {
    const Point site = place.point + depth * place.inward;
    if (locate(contour, snap(site)) == Side::kInside &&
        boundary_distance_m(contour, site) >= 0.5 * depth)
      break;
  }
  return place.point + depth * place.inward;
}

}  // namespace

Expected<std::vector<Parcel>> BorderVoronoiSubdivider::subdivide(const blocks::Block& block,
                                                                 Rng& rng) const {
  const std::vector<Front> fronts = fronts_of(block);
  double total_m = 0.0;
  for (const Front& front : fronts) total_m += length_m(front);
  if (total_m / options_.spacing_m > static_cast<double>(kMaxLotsPerBlock)) {
    return fail(FailureCode::kNoConvergence,
                fmt::format("sites {:g} m apart are too many along {:.0f} m of streets: raise "
                            "spacing_m",
                            options_.spacing_m, total_m));
  }
  std::vector<Point> sites;
  for (const Front& front : fronts) {
    const double length = length_m(front);
    const int count = static_cast<int>(std::round(length / options_.spacing_m));
    if (count == 0) continue;
    const std::vector<double> ends =
        random_divisions(length, count, options_.spacing_deviation, rng);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const FrontPlace place = place_at(front, 0.5 * (ends[i] + ends[i + 1]));
      sites.push_back(site_behind(block.contour, place, options_.setback_m));
    }
  }
  return partition_by_sites(block, std::move(sites)).map([](const BlockPartition& partition) {
    return partition.parcels();
  });
}

BorderVoronoiSubdivider BorderVoronoiSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  o.spacing_m = mean_lot(style).width_m;
  if (style.width_mean_m > 0.0) {
    o.spacing_deviation =
        std::min(10.0, o.fit_deviations * style.width_deviation_m / style.width_mean_m);
  }
  return BorderVoronoiSubdivider(o);
}

}  // namespace plat::parcels
