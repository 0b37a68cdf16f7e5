#pragma once

#include <cstdint>
#include <vector>

#include "core/polygon.h"
#include "streets/street_network.h"

namespace plat::synthesis {

/// A network from which a region has been cut out.
struct NetworkCut {
  streets::StreetNetwork network;        ///< what is left, streets in their order
  Polygon region;                        ///< with a vertex at each cut, so up to the working grid
  std::vector<std::uint32_t> cut_nodes;  ///< where streets were cut, ascending
  std::size_t cut_streets = 0;           ///< streets of which something is missing
};

/// Takes the streets in a region away; streets that cross its boundary are cut there.
///
/// Guarantees: 1. no part of a street is left inside the region, but for what the working grid
/// moves;  2. streets that do not enter its inside are unchanged, those along its boundary
/// included;  3. the nodes of cut streets lie on the boundary of the region returned.
/// Pre: `region` is strictly simple and on the working grid (core/validity.h).
/// Complexity: O(segments in the box of the region x edges of the region)
NetworkCut cut_out(const streets::StreetNetwork& network, const Polygon& region);

}  // namespace plat::synthesis
