#include "parcels/cube_packing_subdivider.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/working_grid.h"
#include "parcels/lot_packing.h"
#include "parcels/partition.h"

namespace plat::parcels {
namespace {

/// The regions that hold the middle of a packed lot.
std::set<std::uint32_t> regions_of_lots(const BlockPartition& partition,
                                        const std::vector<PackedLot>& lots) {
  std::set<std::uint32_t> out;
  for (const std::uint32_t region : partition.regions()) {
    const Polygon polygon = partition.polygon(region);
    const Box box = box_of(polygon);
    const bool is_lot = std::any_of(lots.begin(), lots.end(), [&](const PackedLot& lot) {
      const Point p = snap(centre(lot));
      return box.contains(p) && locate(polygon, p) == Side::kInside;
    });
    if (is_lot) out.insert(region);
  }
  return out;
}

/// The lot beside a region with which it shares the longest boundary.
std::optional<std::uint32_t> longest_lot(const BlockPartition& partition, std::uint32_t region,
                                         const std::set<std::uint32_t>& lots) {
  std::optional<BlockPartition::Border> best;
  for (const BlockPartition::Border& border : partition.borders(region)) {
    if (lots.contains(border.neighbour) && (!best || border.length_m > best->length_m))
      best = border;
  }
  if (!best) return std::nullopt;
  return best->neighbour;
}

/// Joins what is left over to the lots, from them outwards: land beside no lot waits until land
/// between has been joined to one.
void join_left_over(BlockPartition& partition, const std::set<std::uint32_t>& lots) {
  std::vector<std::uint32_t> open;
  for (const std::uint32_t region : partition.regions()) {
    if (!lots.contains(region)) open.push_back(region);
  }
  for (bool is_changed = true; is_changed && !open.empty();) {
    is_changed = false;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joins;
    std::vector<std::uint32_t> waiting;
    for (const std::uint32_t region : open) {
      if (const auto lot = longest_lot(partition, region, lots)) {
        joins.emplace_back(*lot, region);
      } else {
        waiting.push_back(region);
      }
    }
    for (const auto& [lot, region] : joins) partition.join(lot, region);
    is_changed = !joins.empty();
    open = std::move(waiting);
  }
}

}  // namespace

Expected<std::vector<Parcel>> CubePackingSubdivider::subdivide(const blocks::Block& block,
                                                               Rng& rng) const {
  double fronts_m = 0.0;
  for (const Front& front : fronts_of(block)) fronts_m += length_m(front);
  if (fronts_m / options_.lot_width_m > static_cast<double>(kMaxLotsPerBlock)) {
    return fail(FailureCode::kNoConvergence,
                fmt::format("lots {:g} m wide are too many along {:.0f} m of streets: raise "
                            "lot_width_m",
                            options_.lot_width_m, fronts_m));
  }
  const PackingSize size{options_.lot_width_m, options_.width_deviation, options_.lot_depth_m,
                         options_.depth_min_share * options_.lot_depth_m};
  const std::vector<PackedLot> lots = pack_lots(block, size, rng);
  auto partition = BlockPartition::cut(block, packing_cuts(block, lots));
  if (!partition) return tl::unexpected<Failure>(partition.error());
  join_left_over(*partition, regions_of_lots(*partition, lots));
  return partition->parcels();
}

CubePackingSubdivider CubePackingSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  const LotSize lot = mean_lot(style);
  o.lot_width_m = lot.width_m;
  o.lot_depth_m = lot.depth_m;
  if (style.width_mean_m > 0.0) {
    o.width_deviation =
        std::min(10.0, o.fit_deviations * style.width_deviation_m / style.width_mean_m);
  }
  return CubePackingSubdivider(o);
}

}  // namespace plat::parcels
