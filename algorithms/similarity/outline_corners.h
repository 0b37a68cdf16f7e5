#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/point.h"

namespace plat::similarity {

/// A vertex whose triangle with its neighbours has at most this share of the ring's area is no
/// corner. A vertex on a straight edge that was rounded to the working grid has 2e-5 of a lot of
/// 500 m2; the smallest jog of a survey has a hundred times more.
inline constexpr double kFlatShare_01 = 1e-4;

/// Sorts shares of an area: monotone, and so rough that shares that are equal but for rounding are
/// equal, whatever the scale.
float rough_share(double share_01);

/// The corners of an outline: vertices are dropped, that of the smallest triangle with its
/// neighbours first, while that triangle is flat or more than `max_count` are left; three always
/// stay.
///
/// Guarantees: 1. the same corners, in the same order, whichever vertex the ring begins with: they
/// begin with the lexicographically first;  2. as many vertices on an edge as one likes change
/// nothing.
/// @param ring  of a valid polygon, counter-clockwise
/// @returns     indices of the ring's vertices, in its cyclic order
/// Complexity:  O(n log n)
std::vector<std::size_t> outline_corners(std::span<const Point> ring, std::size_t max_count);

}  // namespace plat::similarity
