#include "parcels/skeleton_subdivider.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parcels/contour_simplification.h"
#include "parcels/partition.h"
#include "parcels/slices.h"

namespace plat::parcels {
namespace {

/// Cells below this are leftovers of rounding, not lots.
constexpr double kSliver_m2 = 0.5;
/// A vertex that turns by less is no corner of a lot.
constexpr double kCornerTurn_rad = 0.175;  // 10 degrees
/// More vertices than this are simplified away first, in steps: time grows with their square and
/// worse.
constexpr std::size_t kComfortableVertices = 300;
constexpr double kCoarsest_m = 4.0;
/// Slices of two streets may cross behind a side without a street, as a lattice: more crossings
/// than this would take minutes and gigabytes.
constexpr std::size_t kMaxCrossings = 50'000;

int corner_count(const Ring& ring) {
  int corners = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point in = ring[i] - ring[(i + ring.size() - 1) % ring.size()];
    const Point out = ring[(i + 1) % ring.size()] - ring[i];
    if (std::abs(std::atan2(cross(in, out), dot(in, out))) > kCornerTurn_rad) ++corners;
  }
  return corners;
}

bool is_triangular(const Polygon& polygon) {
  return polygon.holes.empty() && corner_count(polygon.outer) == 3;
}

Expected<StripLayout> lay_out(const blocks::Block& block, double simplify_m, CornerScheme corners) {
  for (;;) {
    LabelledContour contour = simplify_contour(block, simplify_m);
    const bool is_coarsest = simplify_m >= kCoarsest_m;
    if (contour.labels.size() > kComfortableVertices && !is_coarsest) {
      simplify_m = std::max(0.05, 2.0 * simplify_m);
      continue;
    }
    auto layout =
        lay_out_strips(std::move(contour.polygon), std::move(contour.labels), simplify_m, corners);
    const bool may_help = !layout && (layout.error().code == FailureCode::kNoSkeleton ||
                                      layout.error().code == FailureCode::kTimeLimit);
    if (!may_help || is_coarsest) return layout;
    simplify_m = std::max(0.05, 2.0 * simplify_m);
  }
}

/// Few cuts are not worth counting; kMaxLotsPerBlock bounds the rest.
bool has_more_crossings(const std::vector<Segment>& cuts, std::size_t limit) {
  if (cuts.size() * cuts.size() < 4 * limit) return false;  // n/2 slices may cross n/2 others
  std::size_t count = 0;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const Segment& s = cuts[i];
    for (std::size_t j = 0; j < i; ++j) {
      const Segment& t = cuts[j];
      const bool is_cut = (orientation(s.a, s.b, t.a) < 0.0) != (orientation(s.a, s.b, t.b) < 0.0);
      if (!is_cut) continue;
      if ((orientation(t.a, t.b, s.a) < 0.0) != (orientation(t.a, t.b, s.b) < 0.0)) ++count;
    }
    if (count > limit) return true;
  }
  return false;
}

tl::unexpected<Failure> lots_too_narrow(double front_m, double spacing_m) {
  return fail(FailureCode::kNoConvergence,
              fmt::format("lots {:g} m wide are too many along {:.0f} m of streets: raise "
                          "width_min_m or width_max_m",
                          spacing_m, front_m));
}

}  // namespace

Expected<std::vector<Parcel>> SkeletonSubdivider::subdivide(const blocks::Block& given,
                                                            Rng& rng) const {
  const blocks::Block block = blocks::with_streets_assumed(given);
  // Algorithm 1: computeSkeletonOffset, convertToStrip, mergeOnLogicalStreets, fixDiagonalEdges.
  auto layout = lay_out(block, options_.simplify_m, options_.corners);
  if (!layout) return tl::unexpected<Failure>(layout.error());
  // slice(s)
  const double spacing_m = std::max(0.5, 0.5 * (options_.width_min_m + options_.width_max_m));
  double front_m = 0.0;
  for (const Strip& strip : layout->strips) front_m += front_length_m(*layout, strip);
  if (front_m / spacing_m > static_cast<double>(kMaxLotsPerBlock))
    return lots_too_narrow(front_m, spacing_m);
  std::vector<Segment> cuts = slice_strips(*layout, {spacing_m, options_.irregularity}, rng);
  if (has_more_crossings(cuts, kMaxCrossings)) return lots_too_narrow(front_m, spacing_m);
  cuts.insert(cuts.end(), layout->walls.begin(), layout->walls.end());
  auto partition = BlockPartition::cut(block, cuts);
  if (!partition) return tl::unexpected<Failure>(partition.error());
  partition->join_slivers(kSliver_m2);
  // processSmallLargeOrTriangularLots, the last item of [VKW12, Sec. 4.2.3]
  const double triangle_max_m2 =
      0.5 * (options_.area_min_m2 + std::min(options_.area_max_m2, kUndivided_m2));
  partition->join_while([&](std::uint32_t region) {
    const double area = partition->area_m2(region);
    return partition->frontage_m(region) < kStreetAccess_m || area < options_.area_min_m2 ||
           (area < triangle_max_m2 && is_triangular(partition->polygon(region)));
  });
  return partition->parcels();
}

SkeletonSubdivider SkeletonSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  const Bounds area =
      bounds_around(style.area_mean_m2, style.area_deviation_m2, o.fit_deviations, 1.0);
  const Bounds width =
      bounds_around(style.width_mean_m, style.width_deviation_m, o.fit_deviations, -1e6);
  o.area_min_m2 = area.low;
  o.area_max_m2 = area.high;
  o.width_min_m = width.low;
  o.width_max_m = std::max(0.5, width.high);  // observed slivers must not leave the option's range
  return SkeletonSubdivider(o);
}

}  // namespace plat::parcels
