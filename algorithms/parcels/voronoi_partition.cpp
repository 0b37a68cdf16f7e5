#include "parcels/voronoi_partition.h"

#include <algorithm>

#include "core/working_grid.h"
#include "parcels/voronoi_diagram.h"

namespace plat::parcels {
namespace {

/// Cells without a site are parts of a Voronoi cell that the contour cuts off.
void join_cells_without_site(BlockPartition& partition, const std::vector<Point>& sites) {
  std::vector<std::uint32_t> open;
  for (const std::uint32_t r : partition.regions()) {
    const Polygon polygon = partition.polygon(r);
    const Box box = box_of(polygon);
    const bool has_site = std::any_of(sites.begin(), sites.end(), [&](Point p) {
      return box.contains(p) && locate(polygon, p) == Side::kInside;
    });
    if (!has_site) open.push_back(r);
  }
  if (open.size() == partition.cell_count())
    open.erase(open.begin());  // no site inside at all: keep one parcel
  // Joining to another part without a site is allowed; that one is joined in its turn.
  for (const std::uint32_t r : open) {
    if (const auto neighbour = partition.longest_neighbour(r)) partition.join(*neighbour, r);
  }
}

}  // namespace

Expected<BlockPartition> partition_by_sites(const blocks::Block& block, std::vector<Point> sites) {
  for (Point& site : sites) site = snap(site);
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  std::vector<Segment> cuts;
  if (sites.size() > 1) {
    Box window = box_of(block.contour).expanded(1.0);
    for (const Point p : sites) window.add(p);
    for (const VoronoiEdge& edge : voronoi_edges(sites, window)) cuts.push_back(edge.segment);
  }
  auto partition = BlockPartition::cut(block, cuts);
  if (partition) join_cells_without_site(*partition, sites);
  return partition;
}

}  // namespace plat::parcels
