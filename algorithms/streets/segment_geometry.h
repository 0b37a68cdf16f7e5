#pragma once

#include <cstdint>

#include "core/polygon.h"
#include "core/rng.h"
#include "streets/growth_plane.h"

namespace plat::streets {

/// Curves whose length is within this share of the wanted one are as tortuous as was wanted.
inline constexpr double kTortuosityTolerance = 0.01;
/// Curves are drawn by segments no longer than this, metres, and by no more than 32.
inline constexpr double kCurveStep_m = 12.0;

/// A curve between two points that looks like a street: an arc or an S, leaning to one side at
/// random, on the working grid.
///
/// Guarantees: 1. runs from `a` to `b`, and no point is repeated;  2. its length over the distance
/// of its ends is `tortuosity`, within kTortuosityTolerance, where the ends are metres apart and
/// the tortuosity is at most 2;  3. straight for a tortuosity of 1 or less.
/// Paper: [AVB08, Sec. 3.1.1 and Fig. 5c], which does not say how.
Polyline tortuous_line(Point a, Point b, double tortuosity, Rng& rng);

/// Bends a segment of the plane as its tortuosity says; where that is barred, to the other side,
/// then by half as much, and so on; straight at last.
/// @returns the line as it is now in the plane; empty where it stayed straight
/// Pre: the straight segment was added.
Polyline bend_segment(GrowthPlane& plane, std::uint32_t from, std::uint32_t to, double tortuosity,
                      Rng& rng);

}  // namespace plat::streets
