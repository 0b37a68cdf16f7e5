#include "synthesis/block_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/oriented_box.h"

namespace plat::synthesis {
namespace {

std::optional<ParcelAreas> sample_of(std::span<const double> areas_m2) {
  if (areas_m2.empty()) return std::nullopt;
  const auto count = static_cast<double>(areas_m2.size());
  double sum = 0.0;
  for (const double area : areas_m2) sum += area;
  ParcelAreas out{sum / count, 0.0};
  if (areas_m2.size() < 2) return out;
  double squares = 0.0;
  for (const double area : areas_m2) squares += (area - out.mean_m2) * (area - out.mean_m2);
  out.deviation_m2 = std::sqrt(squares / (count - 1.0));
  return out;
}

}  // namespace

PointAreas::PointAreas(const streets::StreetNetwork& network,
                       std::span<const streets::IntersectionPoint> points,
                       std::span<const streets::IntersectionPoint> existing_points)
    : network_(network) {
  struct Sum {
    double area_m2 = 0.0;
    double count = 0.0;
  };
  std::map<Point, Sum> at;
  for (const auto& some : {points, existing_points}) {
    for (const streets::IntersectionPoint& point : some) {
      if (!point.parcel_area_m2 || !(*point.parcel_area_m2 > 0.0)) continue;
      Sum& sum = at[point.place];
      sum.area_m2 += *point.parcel_area_m2;
      sum.count += 1.0;
    }
  }
  area_of_node_m2_.resize(network.nodes.size());
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    if (const auto it = at.find(network.nodes[n]); it != at.end())
      area_of_node_m2_[n] = it->second.area_m2 / it->second.count;
  }
}

std::optional<ParcelAreas> PointAreas::around(const blocks::Block& block) const {
  std::set<std::uint32_t> nodes;
  for (const auto& ring : block.edges) {
    for (const blocks::BlockEdge& edge : ring) {
      if (!edge.street) continue;
      const streets::Street& street = network_.streets[edge.street->value];
      nodes.insert({street.from, street.to});
    }
  }
  std::vector<double> areas;
  for (const std::uint32_t node : nodes) {
    if (area_of_node_m2_[node]) areas.push_back(*area_of_node_m2_[node]);
  }
  return sample_of(areas);
}

std::optional<ParcelAreas> PointAreas::everywhere() const {
  std::vector<double> areas;
  for (const std::optional<double>& area : area_of_node_m2_) {
    if (area) areas.push_back(*area);
  }
  return sample_of(areas);
}

parcels::ParcelStyle style_for(const blocks::Block& block, const ParcelAreas& areas) {
  const double block_m2 = area_m2(block.contour);
  const double depth_m = block_m2 / minimum_area_box(block.contour).length_m;
  // A lot of one row is depth^2 / area deep per unit of width, one of two rows a quarter of that:
  // both are equally far from a square where depth^2 is twice the area.
  const double rows = depth_m * depth_m > 2.0 * areas.mean_m2 ? 2.0 : 1.0;
  const double lot_depth_m = depth_m / rows;
  const double frontage_m = areas.mean_m2 / lot_depth_m;
  parcels::ParcelStyle style;
  style.count = static_cast<std::size_t>(std::max(1.0, std::round(block_m2 / areas.mean_m2)));
  style.area_mean_m2 = areas.mean_m2;
  style.area_deviation_m2 = areas.deviation_m2;
  style.width_mean_m = std::min(lot_depth_m, frontage_m);
  style.width_deviation_m = style.width_mean_m * areas.deviation_m2 / areas.mean_m2;
  style.aspect_ratio_mean = std::max(lot_depth_m, frontage_m) / style.width_mean_m;
  style.access_share_01 = 1.0;
  style.access_area_01 = 1.0;
  style.rows_mean = 1.0;
  return style;
}

}  // namespace plat::synthesis
