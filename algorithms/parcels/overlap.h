#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "parcels/parcel.h"

namespace plat::parcels {

/// The common area of a shape of one set with a shape of another.
struct Overlap {
  std::uint32_t first = 0;   ///< index in the first set
  std::uint32_t second = 0;  ///< index in the second set
  double area_m2 = 0.0;

  friend bool operator==(const Overlap&, const Overlap&) = default;
};

/// The pairs of shapes that overlap, sorted: all edges are noded together, and each face counts for
/// the shapes that it lies in.
///
/// Guarantees: 1. exact but for the rounding of crossings to the working grid;  2. a pair without
/// common area is left out. Pre: valid polygons on the working grid.
/// Complexity: O(n log n + f s) for f faces and s shapes whose box holds a face's point.
std::vector<Overlap> find_overlaps(std::span<const Parcel> first, std::span<const Parcel> second);

}  // namespace plat::parcels
