#pragma once

#include <cstddef>
#include <span>

#include "streets/intersection_point.h"
#include "streets/street_chains.h"
#include "streets/street_network.h"

namespace plat::streets {

/// The style of a whole street, from what lies between its consecutive intersection points:
/// tortuosity is the mean of curve length over chord, distance and angle are of the chords.
/// Segments that come back to where they began have no chord and count for none of them.
/// @param stops  the chain's intersection points: indices into its nodes, ascending; an open chain
///               has both of its ends among them, a closed one not its last node, which is its
///               first
/// @returns tortuosity 1 and zeros where the street has no segment, or no turn
/// Paper: [AVB08, Sec. 3.1.1 and Fig. 4]. Deviation: the angle is unsigned (ADR 0026).
PassingStreet style_of(const StreetNetwork& network, const StreetChain& chain,
                       std::span<const std::size_t> stops);

}  // namespace plat::streets
