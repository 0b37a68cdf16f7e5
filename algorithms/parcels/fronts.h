#pragma once

#include <vector>

#include "blocks/block.h"

namespace plat::parcels {

/// A stretch of a block's contour along streets without a corner, the block on its left.
struct Front {
  Polyline line;           ///< a closed one repeats its first point
  bool is_closed = false;  ///< a whole ring without a corner
};

/// A turn by more than this is a corner: a front ends there. As blocks::block_from_contour.
inline constexpr double kFrontCorner_rad = 0.5;

/// The fronts of a block, in the order of its rings: consecutive street edges up to the next
/// corner. Without any street edge every outer edge counts as one.
std::vector<Front> fronts_of(const blocks::Block& block);

double length_m(const Front& front);

/// A place on a front and the unit vector into the block there.
struct FrontPlace {
  Point point;
  Point inward;
};

/// The place `s` metres along the front; its ends beyond them.
FrontPlace place_at(const Front& front, double s_m);

}  // namespace plat::parcels
