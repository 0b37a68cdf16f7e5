#include "parcels/min_box_subdivider.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/oriented_box.h"
#include "core/working_grid.h"
#include "parcels/partition.h"
#include "parcels/random_divisions.h"

namespace plat::parcels {
namespace {

/// Cells below this are leftovers of rounding, not lots.
constexpr double kSliver_m2 = 0.5;
/// How far a cut goes on beyond the line it ends on, so that rounding cannot make it stop short.
constexpr double kProlongation_m = 8.0 * kGridStep_m;

/// A whole number of lots or rows that fill a side of the box.
double count_along(double side_m, double part_m) {
  return std::max(1.0, std::round(side_m / part_m));
}

/// The lines between rows, and in every row those between its lots.
std::vector<Segment> regular_cuts(const OrientedBox& box, int rows, int lots,
                                  double width_deviation, Rng& rng) {
  const Point across = perpendicular(box.axis);
  const Point corner = box.center - 0.5 * box.length_m * box.axis - 0.5 * box.width_m * across;
  const auto at = [&](double along_m, double across_m) {
    return corner + along_m * box.axis + across_m * across;
  };
  const double depth = box.width_m / rows;
  std::vector<Segment> cuts;
  for (int row = 0; row < rows; ++row) {
    const double low = row * depth;
    if (row > 0)
      cuts.push_back({at(-kProlongation_m, low), at(box.length_m + kProlongation_m, low)});
    const std::vector<double> ends = random_divisions(box.length_m, lots, width_deviation, rng);
    for (std::size_t i = 1; i + 1 < ends.size(); ++i) {
      cuts.push_back(
          {at(ends[i], low - kProlongation_m), at(ends[i], low + depth + kProlongation_m)});
    }
  }
  return cuts;
}

}  // namespace

Expected<std::vector<Parcel>> MinBoxSubdivider::subdivide(const blocks::Block& block,
                                                          Rng& rng) const {
  const OrientedBox box = minimum_area_box(block.contour);
  const double rows = count_along(box.width_m, options_.lot_depth_m);
  const double lots = count_along(box.length_m, options_.lot_width_m);
  if (rows * lots > static_cast<double>(kMaxLotsPerBlock)) {
    return fail(
        FailureCode::kNoConvergence,
        fmt::format("more than {} lots: raise lot_width_m or lot_depth_m", kMaxLotsPerBlock));
  }
  auto partition =
      BlockPartition::cut(block, regular_cuts(box, static_cast<int>(rows), static_cast<int>(lots),
                                              options_.width_deviation, rng));
  if (!partition) return tl::unexpected<Failure>(partition.error());
  partition->join_slivers(std::max(options_.area_min_m2, kSliver_m2));
  return partition->parcels();
}

MinBoxSubdivider MinBoxSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  const LotSize lot = mean_lot(style);
  o.lot_width_m = lot.width_m;
  o.lot_depth_m = lot.depth_m;
  if (style.width_mean_m > 0.0)
    o.width_deviation = std::min(10.0, style.width_deviation_m / style.width_mean_m);
  o.area_min_m2 =
      bounds_around(style.area_mean_m2, style.area_deviation_m2, o.fit_deviations, 1.0).low;
  return MinBoxSubdivider(o);
}

}  // namespace plat::parcels
