#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/polygon.h"

namespace plat::buildings::detail {

using DirectedEdge = std::pair<Point, Point>;

/// Chains directed edges with the inside on their left into closed rings; where several leave a
/// point, the ring stays in the same corner of the inside. nullopt where one does not close.
std::optional<std::vector<Ring>> chain_rings(const std::vector<DirectedEdge>& edges);

/// Counter-clockwise rings as regions, clockwise ones as holes of the smallest region around them.
std::vector<Polygon> regions_of(std::vector<Ring> rings);

}  // namespace plat::buildings::detail
