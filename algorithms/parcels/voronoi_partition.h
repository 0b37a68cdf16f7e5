#pragma once

#include <vector>

#include "parcels/partition.h"

namespace plat::parcels {

/// A block cut along the Voronoi diagram of sites, which are snapped and may repeat.
///
/// Guarantees: 1. every region holds exactly one site inside the block: the part of a cell that the
/// contour cuts off goes to the neighbour with the longest common boundary;  2. without any site
/// inside the block there is one region.
Expected<BlockPartition> partition_by_sites(const blocks::Block& block, std::vector<Point> sites);

}  // namespace plat::parcels
