#pragma once

#include <cstddef>

#include "core/point.h"
#include "imagery/canvas.h"

namespace plat::imagery {

/// Where the sun stands.
struct Sun {
  double azimuth_rad = 0.0;    ///< clockwise from north
  double elevation_rad = 0.0;  ///< above the horizon

  /// The unit vector on the ground towards the sun.
  [[nodiscard]] Point direction() const;
  /// How far a thing of this height throws its shadow, metres.
  [[nodiscard]] double reach_m(double height_m) const;
};

/// Darkens what a higher thing hides from the sun, by the canvas's heights.
///
/// A ray's height sinks from pixel to pixel away from the sun, and is lifted by what it passes:
/// each pixel looks at one neighbour only, whatever the length of the shadows. Rays are anchored to
/// the world's pixels.
/// Guarantees: 1. a pixel farther from the canvas's sunny sides than the highest thing's reach is
/// as in any larger canvas;  2. nothing is darkened by what is lower than itself.
/// Complexity: O(pixels).
void cast_shadows(Canvas& canvas, const Sun& sun);

}  // namespace plat::imagery
