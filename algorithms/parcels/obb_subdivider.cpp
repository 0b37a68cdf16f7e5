#include "parcels/obb_subdivider.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/working_grid.h"
#include "parcels/lot.h"
#include "parcels/partition.h"

namespace plat::parcels {
namespace {

/// Far beyond what halving a block takes; ends the recursion if a split makes no progress.
constexpr int kMaxDepth = 48;
/// Cells below this are leftovers of rounding, not lots.
constexpr double kSliver_m2 = 0.5;
/// How far a cut goes on beyond its ends: these lie on edges of lots, whose own ends were rounded
/// again and again, so that they may stop short of the cut or contour edge they were meant for.
constexpr double kProlongation_m = 8.0 * kGridStep_m;
/// How near the ends of the box's longer side a split may come, as a share of that side.
constexpr double kEndMargin = 0.1;

struct Split {
  SplitResult result;
  OrientedBox box;
};

class Recursion {
 public:
  Recursion(const ObbSubdivider::Options& options, std::vector<Segment>& cuts)
      : options_(options), cuts_(cuts) {}

  [[nodiscard]] bool is_exceeded() const { return lots_ > kMaxLotsPerBlock; }

  // Algorithm 2, recSubdivOBB(l).
  void divide(const Lot& lot, std::uint64_t seed, int depth) {
    if (is_exceeded()) return;
    const OrientedBox box = minimum_area_box(lot);
    if (depth >= kMaxDepth || area_m2(lot) < options_.area_max_m2 ||
        front_width_m(lot, box) < options_.width_max_m)
      return;
    Rng rng(seed);
    // Drawn whether needed or not: the stream must not depend on the geometry of the children.
    const double shift = options_.irregularity * box.width_m * rng.uniform(-1.0, 1.0);
    const bool must_keep_access = rng.uniform_01() < options_.street_access;

    SplitResult across = split_across(lot, box, shift);
    if (across.lots.size() < 2) return;
    if (must_keep_access && has_access(lot) && !all_have_access(across)) {
      SplitResult along = split_along(lot, box);
      if (along.lots.size() < 2 || !all_have_access(along)) return;
      across = std::move(along);
    }
    for (const Segment& cut : across.cuts) add_cut(cut);
    lots_ += across.lots.size() - 1;
    std::uint64_t child = 0;
    for (const Lot& part : across.lots) divide(part, derive_seed(seed, {child++}), depth + 1);
  }

 private:
  /// The prolongations are segments of their own: the cut must go through its ends. What is left
  /// over of them separates nothing.
  void add_cut(const Segment& cut) {
    const Point beyond = kProlongation_m * normalized(cut.b - cut.a);
    cuts_.push_back(cut);
    cuts_.push_back({cut.a, cut.a - beyond});
    cuts_.push_back({cut.b, cut.b + beyond});
  }

  [[nodiscard]] static bool has_access(const Lot& lot) {
    return frontage_m(lot) >= kStreetAccess_m;
  }
  [[nodiscard]] static bool all_have_access(const SplitResult& split) {
    return std::all_of(split.lots.begin(), split.lots.end(), has_access);
  }

  [[nodiscard]] bool is_too_small(const Lot& lot) const {
    return area_m2(lot) < options_.area_min_m2 ||
           minimum_area_box(lot).width_m < 0.5 * options_.width_min_m;
  }

  /// computeSplitLine(l): across the longer side, at its middle shifted by `shift`.
  [[nodiscard]] SplitResult split_across(const Lot& lot, const OrientedBox& box,
                                         double shift) const {
    const double reach = (0.5 - kEndMargin) * box.length_m;
    const Point direction = perpendicular(box.axis);
    const Point shifted = box.center + std::clamp(shift, -reach, reach) * box.axis;
    SplitResult result = split(lot, {snapped_pivot(lot, shifted, direction), direction});
    if (std::any_of(result.lots.begin(), result.lots.end(),
                    [&](const Lot& l) { return is_too_small(l); })) {
      SplitResult middle = split(lot, {snapped_pivot(lot, box.center, direction), direction});
      if (middle.lots.size() >= 2) return middle;
    }
    return result;
  }

  /// The split line turned by 90 degrees.
  [[nodiscard]] SplitResult split_along(const Lot& lot, const OrientedBox& box) const {
    return split(lot, {snapped_pivot(lot, box.center, box.axis), box.axis});
  }

  /// The pivot moved so that the line goes through the nearest contour vertex of the lot, if that
  /// is near enough.
  [[nodiscard]] Point snapped_pivot(const Lot& lot, Point pivot, Point direction) const {
    Point best = pivot;
    double best_distance = options_.snap_m;
    for (const auto& ring : lot.rings) {
      for (const LotVertex& v : ring) {
        if (!v.is_contour_vertex) continue;
        const double d = std::abs(cross(direction, v.position - pivot));
        if (d < best_distance) {
          best_distance = d;
          best = v.position;
        }
      }
    }
    return best;
  }

  const ObbSubdivider::Options& options_;
  std::vector<Segment>& cuts_;
  std::size_t lots_ = 1;
};

}  // namespace

Expected<std::vector<Parcel>> ObbSubdivider::subdivide(const blocks::Block& block, Rng& rng) const {
  std::vector<Segment> cuts;
  Recursion recursion(options_, cuts);
  recursion.divide(lot_of(block), rng(), 0);
  if (recursion.is_exceeded()) {
    return fail(
        FailureCode::kNoConvergence,
        fmt::format("more than {} lots: raise area_max_m2 or width_max_m", kMaxLotsPerBlock));
  }
  auto partition = BlockPartition::cut(block, cuts);
  if (!partition) return tl::unexpected<Failure>(partition.error());
  partition->join_slivers(kSliver_m2);
  return partition->parcels();
}

ObbSubdivider ObbSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  const Bounds area =
      bounds_around(style.area_mean_m2, style.area_deviation_m2, o.fit_deviations, 1.0);
  const Bounds width =
      bounds_around(style.width_mean_m, style.width_deviation_m, o.fit_deviations, 0.5);
  o.area_min_m2 = area.low;
  o.area_max_m2 = style.count <= 1 ? kUndivided_m2 : area.high;
  o.width_min_m = width.low;
  o.width_max_m = width.high;
  return ObbSubdivider(o);
}

}  // namespace plat::parcels
