#pragma once

#include <optional>
#include <span>

#include "core/failure.h"
#include "core/polygon.h"
#include "parcels/parcel.h"

namespace plat::parcels {

/// Whether the parcels are a coverage of the contour, decided exactly for coordinates on the
/// working grid: nullopt if so, else kNotCovered or the defect of a parcel, with the place.
///
/// Proof used: every directed edge of a parcel is cancelled by the reverse edge of another one, or
/// is left over; the left-over edges must be the contour's rings, refined by vertices at most
/// `tolerance_m` off its edges. As every parcel is a valid polygon (it winds 0 or 1 times around
/// any point), the sum of the parcels' winding numbers is then that of the contour: every point
/// inside is covered exactly once, none outside. Complexity: O(n log n).
std::optional<Failure> find_coverage_defect(const Polygon& contour, std::span<const Parcel> parcels,
                                            double tolerance_m);

/// One and a half grid steps: iterated snap rounding can move a cut's end by a step and a half at
/// most off the edge.
inline constexpr double kContourTolerance_m = 1.5 / 1024.0;

}  // namespace plat::parcels
