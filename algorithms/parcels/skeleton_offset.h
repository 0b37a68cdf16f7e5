#pragma once

#include <vector>

#include "parcels/straight_skeleton.h"

namespace plat::parcels {

/// A piece of the offset contour C'(B): the level set of one face of the skeleton's roof.
struct OffsetEdge {
  std::uint32_t from = 0;  ///< node of the lower part
  std::uint32_t to = 0;    ///< node of the lower part; the patio lies on the left
  std::uint32_t face = 0;  ///< the contour edge that the piece is parallel to
};

/// What lies between the contour C(B) and its offset C'(B).
struct LowerPart {
  /// The skeleton cut off at the offset. Its faces are left out: they are not cut.
  StraightSkeleton skeleton;
  std::vector<OffsetEdge> rim;  ///< C'(B), all its loops; empty where the roof is lower
};

/// Cuts the roof of the skeleton at the height `offset_m` [VKW12, Sec. 4.2.1, fig. 3 right].
///
/// A patio narrower than `min_width_m` at its widest is not made: the roof stays whole over it.
///
/// Guarantees: 1. every node of the offset contour lies at `offset_m` from the edges of its two
/// faces;  2. the rim's edges form closed loops: each of their nodes starts one and ends one.
/// Complexity: O(n log n) for n arcs.
LowerPart cut_roof(const StraightSkeleton& skeleton, double offset_m, double min_width_m);

}  // namespace plat::parcels
