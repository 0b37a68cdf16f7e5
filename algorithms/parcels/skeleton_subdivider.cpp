#include "parcels/skeleton_subdivider.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/validity.h"
#include "parcels/contour_simplification.h"
#include "parcels/obb_subdivider.h"
#include "parcels/skeleton_steps.h"
#include "parcels/strip_lots.h"

namespace plat::parcels {
namespace {

/// More vertices than this are simplified away first, in steps: time grows with their square and
/// worse.
constexpr std::size_t kComfortableVertices = 300;
constexpr double kCoarsest_m = 4.0;
/// Slices of two streets may cross behind a side without a street, as a lattice: more crossings
/// than this would take minutes and gigabytes.
constexpr std::size_t kMaxCrossings = 50'000;

Expected<StripLayout> lay_out(const blocks::Block& block, double simplify_m,
                              const StripRules& rules) {
  for (;;) {
    LabelledContour contour = simplify_contour(block, simplify_m);
    const bool is_coarsest = simplify_m >= kCoarsest_m;
    if (contour.labels.size() > kComfortableVertices && !is_coarsest) {
      simplify_m = std::max(0.05, 2.0 * simplify_m);
      continue;
    }
    auto layout =
        lay_out_strips(std::move(contour.polygon), std::move(contour.labels), simplify_m, rules);
    const bool may_help = !layout && (layout.error().code == FailureCode::kNoSkeleton ||
                                      layout.error().code == FailureCode::kTimeLimit);
    if (!may_help || is_coarsest) return layout;
    simplify_m = std::max(0.05, 2.0 * simplify_m);
  }
}

/// A patio that is nowhere wider than this share of a lot's width is left to the lots around it.
constexpr double kMinPatioShare = 0.5;

constexpr std::size_t kMaxPatioVertices = 20'000;

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

/// The patios that the offset contour encloses, as polygons, and their rims as cuts.
struct Patios {
  std::vector<Polygon> polygons;
  std::vector<Segment> cuts;
};

Expected<Patios> find_patios(const blocks::Block& block, const StripLayout& layout) {
  Patios out;
  if (layout.rim.empty()) return out;
  const auto partition = BlockPartition::cut(block, layout.rim);
  if (!partition) return tl::unexpected<Failure>(partition.error());
  out.cuts = partition->inner_edges();
  // A patio is what the strips do not reach: it touches no street.
  for (const std::uint32_t region : partition->regions()) {
    if (partition->frontage_m(region) <= 0.0) out.polygons.push_back(partition->polygon(region));
  }
  return out;
}

}  // namespace

/// Everything up to the cuts of Algorithm 1.
struct SkeletonSubdivider::Plan {
  blocks::Block block;
  StripLayout layout;
  std::vector<Segment> slices;
  Patios patios;
  LotRules rules;
};

Expected<SkeletonSubdivider::Plan> SkeletonSubdivider::plan(const blocks::Block& given,
                                                            Rng& rng) const {
  Plan out{blocks::with_streets_assumed(given), {}, {}, {}, {}};
  const double spacing_m = std::max(0.5, 0.5 * (options_.width_min_m + options_.width_max_m));
  const double area_m2 =
      0.5 * (options_.area_min_m2 + std::min(options_.area_max_m2, kUndivided_m2));
  out.rules = {options_.area_min_m2,
               options_.area_max_m2,
               area_m2,
               options_.shallow_share * area_m2 / spacing_m,
               {spacing_m, options_.irregularity},
               options_.corners};
  // Algorithm 1: computeSkeletonOffset, convertToStrip, mergeOnLogicalStreets, fixDiagonalEdges.
  auto layout = lay_out(out.block, options_.simplify_m,
                        {options_.corners, options_.offset_m, kMinPatioShare * spacing_m});
  if (!layout) return tl::unexpected<Failure>(layout.error());
  out.layout = *std::move(layout);
  // slice(s)
  double front_m = 0.0;
  for (const Strip& strip : out.layout.strips) front_m += front_length_m(out.layout, strip);
  if (front_m / spacing_m > static_cast<double>(kMaxLotsPerBlock))
    return lots_too_narrow(front_m, spacing_m);
  out.slices = slice_strips(out.layout, out.rules.spacing, rng);
  if (has_more_crossings(out.slices, kMaxCrossings)) return lots_too_narrow(front_m, spacing_m);
  auto patios = find_patios(out.block, out.layout);
  if (!patios) return tl::unexpected<Failure>(patios.error());
  out.patios = *std::move(patios);
  return out;
}

Expected<StripLots> SkeletonSubdivider::cut_lots(const Plan& plan, Rng& rng) const {
  std::vector<Segment> cuts = plan.slices;
  const auto append = [&](const std::vector<Segment>& more) {
    cuts.insert(cuts.end(), more.begin(), more.end());
  };
  append(plan.layout.walls);
  append(plan.patios.cuts);
  const std::uint64_t seed = rng();
  for (const Polygon& patio : plan.patios.polygons) {
    Rng stream(derive_seed(seed, {static_cast<std::uint64_t>(&patio - &plan.patios.polygons[0])}));
    append(inner_cuts(plan.block, patio, stream));
  }
  return StripLots::cut(plan.block, cuts, plan.patios.polygons);
}

/// What divides a patio; nothing where the inner division cannot.
std::vector<Segment> SkeletonSubdivider::inner_cuts(const blocks::Block& block,
                                                    const Polygon& patio, Rng& rng) const {
  std::vector<Segment> cuts;
  if (options_.inner == InnerDivision::kKeep) return cuts;
  auto contour = admit_polygon(patio, kMaxPatioVertices);
  if (!contour) return cuts;
  blocks::Block inner = blocks::block_from_contour(block.id, *std::move(contour));
  auto parcels = [&]() -> Expected<std::vector<Parcel>> {
    if (options_.inner == InnerDivision::kObb) {
      for (auto& ring : inner.edges) ring.assign(ring.size(), {});  // no street to keep access to
      return ObbSubdivider({.area_min_m2 = std::max(0.0, options_.area_min_m2),
                            .area_max_m2 = options_.area_max_m2,
                            .width_min_m = std::max(0.0, options_.width_min_m),
                            .width_max_m = options_.width_max_m,
                            .irregularity = options_.irregularity})
          .subdivide(inner, rng);
    }
    Options o = options_;
    o.offset_m.reset();
    return SkeletonSubdivider(o).subdivide(inner, rng);
  }();
  if (!parcels) return cuts;
  for (const Parcel& parcel : *parcels) {
    for_each_edge(parcel.shape, [&](const Segment& s) {
      if (s.a < s.b) cuts.push_back(s);  // the other parcel has the same edge the other way round
    });
  }
  return cuts;
}

Expected<std::vector<Parcel>> SkeletonSubdivider::subdivide(const blocks::Block& block,
                                                            Rng& rng) const {
  const auto steps = plan(block, rng);
  if (!steps) return tl::unexpected<Failure>(steps.error());
  return divide(*steps, rng);
}

Expected<std::vector<Parcel>> SkeletonSubdivider::subdivide(const blocks::Block& block, Rng& rng,
                                                            SubdivisionTrace& trace) const {
  const auto steps = plan(block, rng);
  if (!steps) return tl::unexpected<Failure>(steps.error());
  show_steps(steps->block, steps->layout, steps->slices, trace);
  return divide(*steps, rng);
}

Expected<std::vector<Parcel>> SkeletonSubdivider::divide(const Plan& plan, Rng& rng) const {
  auto lots = cut_lots(plan, rng);
  if (!lots) return tl::unexpected<Failure>(lots.error());
  // processSmallLargeOrTriangularLots
  if (auto done = lots->group_shallow(plan.rules, rng); !done)
    return tl::unexpected<Failure>(done.error());
  if (auto done = lots->split_large(plan.rules); !done)
    return tl::unexpected<Failure>(done.error());
  lots->merge_small(plan.rules);
  return lots->parcels();
}

SkeletonSubdivider SkeletonSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  // Lower bounds may be negative: their mean with the upper ones must stay the observed one.
  const Bounds area =
      bounds_around(style.area_mean_m2, style.area_deviation_m2, o.fit_deviations, -1e9);
  const Bounds width =
      bounds_around(style.width_mean_m, style.width_deviation_m, o.fit_deviations, -1e6);
  if (style.count <= 1) {
    o.area_min_m2 = area.low;
    o.area_max_m2 = kUndivided_m2;
  } else {
    // A lot below half the mean is nearer to it when it is merged, one above four thirds when it is
    // halved: bounds nearer than that would move lots away from the mean.
    o.area_min_m2 = std::min(area.low, 0.5 * style.area_mean_m2);
    o.area_max_m2 = std::max({1.0, area.high, 4.0 / 3.0 * style.area_mean_m2});
  }
  o.width_min_m = width.low;
  o.width_max_m = std::max(0.5, width.high);  // observed slivers must not leave the option's range
  return SkeletonSubdivider(o);
}

}  // namespace plat::parcels
