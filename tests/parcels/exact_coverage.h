#pragma once

#include <optional>
#include <span>
#include <string>

#include "parcels/parcel.h"

namespace plat::testing {

/// The oracle of parcels/coverage.h: Boolean operations with exact arithmetic (CGAL, EPECK), and
/// none of the code under test. nullopt where all of this holds, exactly but for item 4:
///
/// 1. the parcels' areas sum to the area of their union, so that their interiors are disjoint;
/// 2. no parcel's vertex lies inside an edge of another: both sides have the same vertices;
/// 3. the union is one region with as many holes as the contour, and every vertex of the contour is
///    a vertex of it;
/// 4. the union's vertices are at most `tolerance_m` off the contour (a cut's end is rounded), and
///    where the union and the contour differ at all, their difference is no more than that allows.
std::optional<std::string> find_exact_coverage_defect(const Polygon& contour,
                                                      std::span<const parcels::Parcel> parcels,
                                                      double tolerance_m);

}  // namespace plat::testing
