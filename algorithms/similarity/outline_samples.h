#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/polygon.h"

namespace plat::similarity {

/// Points on an outline, equally far apart along it, as seen from `origin`.
struct OutlineSamples {
  Point origin;               ///< a vertex of the ring
  std::vector<Point> places;  ///< counter-clockwise, relative to `origin`
  Point centroid;             ///< of the outline's area, relative to `origin`
};

/// Samples an outline uniformly. The first sample is the vertex farthest from the centroid; several
/// are told apart by how the following samples lie as seen from the centroid towards the first.
///
/// Guarantees: 1. sample i lies i / count of the outline's length behind the first;  2. the samples
/// of an outline that is moved, turned, begun at another vertex or that has more vertices on its
/// edges are the same points of it, up to rounding; turned, they may be their images under a
/// rotation of the outline onto itself.
/// Pre: a simple ring with an area, count > 0.
/// Complexity:  O(n + count log n), times the vertices that tie
OutlineSamples outline_samples(std::span<const Point> ring, std::size_t count);

}  // namespace plat::similarity
