#pragma once

#include <limits>
#include <span>

#include "core/polygon.h"

namespace plat::similarity {

/// How much the distance that is found may fall short of the true one, metres.
inline constexpr double kHausdorffResolution_m = 1e-9;

/// The Hausdorff distance of two outlines, edges included: how far from the other one a point of
/// either lies at most.
///
/// Guarantees: 1. between points of the edges, not between vertices only, and true to
/// kHausdorffResolution_m;  2. exactly 0 for the same ring.
/// @param give_up_m  where the distance is seen to reach this, a lower bound of it that does is
///                   returned
/// Complexity:  O(mn), and for each edge on which the farthest point may lie O(m) a halving
/// Pre: at least three points each.
double outline_hausdorff_m(std::span<const Point> a, std::span<const Point> b,
                           double give_up_m = std::numeric_limits<double>::infinity());

}  // namespace plat::similarity
