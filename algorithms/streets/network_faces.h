#pragma once

#include <vector>

#include "streets/street_network.h"

namespace plat::streets {

/// The shape of a bounded face of the streets' centrelines: a block before the streets' widths are
/// taken off it.
struct FaceShape {
  double area_m2 = 0.0;         ///< what lies inside as an island taken off
  double perimeter_m = 0.0;     ///< islands included, dead ends not
  double aspect_ratio = 1.0;    ///< longer by shorter side of the box of least area, at least 1
  double rectangularity = 0.0;  ///< area by the area of that box, at most 1
};

/// The bounded faces of the network, in the order of find_faces(). Tunnels bound none; bridges do,
/// and meet what they cross, as in extract_blocks().
///
/// Guarantees: 1. faces do not overlap: their areas sum up to the area of their union;  2. no face
/// is left out for its size: slivers between carriageways are faces.  Complexity: O(n log n).
std::vector<FaceShape> measure_faces(const StreetNetwork& network);

}  // namespace plat::streets
