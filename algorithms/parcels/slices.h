#pragma once

#include <vector>

#include "core/rng.h"
#include "parcels/strips.h"

namespace plat::parcels {

/// How far apart slices are: normal around `spacing_m` with variance 3 omega (m2) [VKW12,
/// Sec. 4.2.3].
struct SliceSpacing {
  double mean_m = 15.0;
  double irregularity = 0.2;  ///< omega
};

/// Where to cut a front between two places, metres along it: as many lots as fit, their widths
/// drawn and then scaled to fill it; a closed front starts with a cut.
std::vector<double> slice_positions(double from_m, double to_m, bool is_closed,
                                    const SliceSpacing& spacing, Rng& rng);

/// The cuts that divide each beta-strip into lots: rays from points on psi, perpendicular to the
/// edge they start on, to the strip's boundary; a ray that meets a skeleton arc inside its strip
/// follows that arc away from the street instead [VKW12, Sec. 4.2.3, fig. 5b]. The spacings of a
/// strip are scaled so that a whole number of lots fills its front (ADR 0006). Each strip draws
/// from a stream of its own, so that a change to one leaves the others as they are. Complexity:
/// O(slices
/// * edges).
std::vector<Segment> slice_strips(const StripLayout& layout, const SliceSpacing& spacing, Rng& rng);

}  // namespace plat::parcels
