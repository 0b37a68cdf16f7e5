#include "parcels/hybrid_subdivider.h"

#include "parcels/min_box_subdivider.h"
#include "parcels/obb_subdivider.h"
#include "parcels/recursive_subdivider.h"
#include "parcels/skeleton_subdivider.h"
#include "parcels/voronoi_subdivider.h"

namespace plat::parcels {
namespace {

/// The options of experiments/block_style/config.json; a test compares.
AnyBlockSubdivider strategy_of(const HybridSubdivider::Options& options) {
  switch (options.style) {
    case BlockStyle::kSkeleton: {
      SkeletonSubdivider::Options o;
      o.irregularity = options.irregularity;
      return AnyBlockSubdivider(SkeletonSubdivider(o));
    }
    case BlockStyle::kObb: {
      ObbSubdivider::Options o;
      o.irregularity = options.irregularity;
      o.street_access = options.street_access;
      o.fit_deviations = 0.25;
      return AnyBlockSubdivider(ObbSubdivider(o));
    }
    case BlockStyle::kMinBox:
      return AnyBlockSubdivider(MinBoxSubdivider({}));
    case BlockStyle::kRecursive: {
      RecursiveSubdivider::Options o;
      o.fit_deviations = 1.0;
      o.stop_early = 0.2;
      o.jitter = 0.3;
      return AnyBlockSubdivider(RecursiveSubdivider(o));
    }
    case BlockStyle::kVoronoi:
      return AnyBlockSubdivider(VoronoiSubdivider({}));
  }
  throw LogicError("every style has a strategy");
}

}  // namespace

Expected<std::vector<Parcel>> HybridSubdivider::subdivide(const blocks::Block& block,
                                                          Rng& rng) const {
  ParcelStyle style;
  style.count = static_cast<std::size_t>(options_.parcels);
  style.area_mean_m2 = options_.area_mean_m2;
  style.area_deviation_m2 = options_.area_deviation_m2;
  style.width_mean_m = options_.width_mean_m;
  style.width_deviation_m = options_.width_deviation_m;
  return strategy_of(options_).fitted(style).subdivide(block, rng);
}

HybridSubdivider HybridSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  o.style = block_style_of(style);
  o.parcels = static_cast<double>(style.count);
  o.area_mean_m2 = style.area_mean_m2;
  o.area_deviation_m2 = style.area_deviation_m2;
  o.width_mean_m = style.width_mean_m;
  o.width_deviation_m = style.width_deviation_m;
  return HybridSubdivider(o);
}

}  // namespace plat::parcels
