#include "parcels/obb_subdivider.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "parcels/recursive_division.h"

namespace plat::parcels {
namespace {

/// How near the ends of the box's longer side a split may come, as a share of that side.
constexpr double kEndMargin = 0.1;
/// Which options to change where the lots become too many.
constexpr std::string_view kRemedy = "area_max_m2 or width_max_m";

/// Algorithm 2, recSubdivOBB(l), one step of it.
class ObbRule {
 public:
  explicit ObbRule(const ObbSubdivider::Options& options) : options_(options) {}

  std::optional<SplitResult> operator()(const Lot& lot, std::uint64_t seed) const {
    const OrientedBox box = minimum_area_box(lot);
    if (area_m2(lot) < options_.area_max_m2 || front_width_m(lot, box) < options_.width_max_m)
      return std::nullopt;
    Rng rng(seed);
    // Drawn whether needed or not: the stream must not depend on the geometry of the children.
    const double shift = options_.irregularity * box.width_m * rng.uniform(-1.0, 1.0);
    const bool must_keep_access = rng.uniform_01() < options_.street_access;

    SplitResult result = split_across(lot, box, shift);
    if (result.lots.size() < 2) return std::nullopt;
    if (must_keep_access && !keeps_street_access(lot, result)) {
      result = split_along(lot, box);
      if (result.lots.size() < 2 || !keeps_street_access(lot, result)) return std::nullopt;
    }
    return result;
  }

 private:
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
};

}  // namespace

Expected<std::vector<Parcel>> ObbSubdivider::subdivide(const blocks::Block& block, Rng& rng) const {
  return divide_recursively(block, rng(), ObbRule(options_), kRemedy)
      .map([](const BlockPartition& partition) { return partition.parcels(); });
}

template <SubdivisionVisitor Visitor>
Expected<std::vector<Parcel>> ObbSubdivider::subdivide(const blocks::Block& block, Rng& rng,
                                                       Visitor& visitor) const {
  return divide_recursively(block, rng(), ObbRule(options_), kRemedy, visitor)
      .map([](const BlockPartition& partition) { return partition.parcels(); });
}

template Expected<std::vector<Parcel>> ObbSubdivider::subdivide(const blocks::Block&, Rng&,
                                                                SubdivisionTrace&) const;

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
