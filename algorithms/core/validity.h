#pragma once

#include <optional>

#include "core/failure.h"
#include "core/polygon.h"

namespace plat {

/// Whether `polygon` is strictly simple: no ring crosses, touches or repeats itself; no hole
/// touches or leaves the outer ring or another hole; orientations as in Polygon. nullopt if so,
/// else the reason with the place. Exact on the working grid. Complexity: O(n log n) for blocks,
/// O(n^2) where all edges overlap in x.
std::optional<Failure> find_defect(const Polygon& polygon);

/// As find_defect, but holes may touch the outer ring or each other in single points, as a parcel
/// around a pinched courtyard does (OGC validity).
std::optional<Failure> find_ogc_defect(const Polygon& polygon);

/// The polygon on the working grid, ready for a stage; or why it cannot be used: not finite, empty,
/// not strictly simple, more than `max_vertices`.
Expected<Polygon> admit_polygon(const Polygon& raw, std::size_t max_vertices);

}  // namespace plat
