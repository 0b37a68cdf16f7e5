#pragma once

#include <span>

#include "synthesis/point_set.h"

namespace plat::synthesis {

enum class Mirroring { kNone, kAcrossEast };  ///< kAcrossEast: north and south change places

/// Where a copy of a point set goes: mirrored, scaled and turned about `pivot`, then moved.
struct Placement {
  Point pivot{};
  Mirroring mirroring = Mirroring::kNone;
  double scale = 1.0;         ///< > 0
  double rotation_rad = 0.0;  ///< counter-clockwise
  Point translation{};
};

Point placed(Point place, const Placement& placement);

/// A copy of the points at another place.
///
/// Guarantees: 1. places lie on the working grid, points at one place stay at one place;  2. at
/// scale 1 the attributes are unchanged, so that a rigid motion keeps the style; otherwise
/// distances and parcel areas scale with the places, widths and angles do not;  3. the order is
/// kept. Pre: scale > 0. Paper: [AVB08, Sec. 4]: copies are placed by hand
PointSet place(std::span<const streets::IntersectionPoint> points, const Placement& placement);

}  // namespace plat::synthesis
