#pragma once

#include <cmath>
#include <cstdint>

#include "core/polygon.h"

/// The working grid (ADR 0002): inside a stage every vertex lies on a grid of 2^-10 m in the local
/// frame.
///
/// Points within 2^15 m of each other then differ by at most 2^25 grid units, their products by
/// 2^51, and a plain double cross product is exact. This is the one place that decides the step.
namespace plat {

inline constexpr double kGridUnitsPerMetre = 1024.0;
inline constexpr double kGridStep_m = 1.0 / kGridUnitsPerMetre;
/// Largest coordinate that may be snapped, metres: 2^31 grid units, so that noding's 128-bit
/// products cannot overflow.
inline constexpr double kGridExtent_m = 2097152.0;

/// Grid units, ties away from minus infinity: the same cell rule for every sign.
inline std::int64_t to_grid(double metres) {
  return static_cast<std::int64_t>(std::floor(metres * kGridUnitsPerMetre + 0.5));
}
inline double from_grid(std::int64_t units) { return static_cast<double>(units) * kGridStep_m; }

inline double snap(double metres) {
  return std::floor(metres * kGridUnitsPerMetre + 0.5) * kGridStep_m;
}
inline Point snap(Point p) { return {snap(p.x), snap(p.y)}; }
inline bool is_on_grid(Point p) { return snap(p) == p; }

/// The ring on the grid, without repeated and without exactly collinear vertices (spikes included).
/// Fewer than three points where nothing is left. Orientation and start are kept where possible.
Ring snap_ring(std::span<const Point> ring);

/// The ring without repeated and without exactly collinear vertices; points are not moved.
Ring drop_collinear(std::span<const Point> ring);

/// Every ring snapped, oriented (outer counter-clockwise, holes clockwise); rings that vanish are
/// left out.
Polygon snap_polygon(const Polygon& polygon);

}  // namespace plat
