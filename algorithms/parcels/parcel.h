#pragma once

#include "core/ids.h"
#include "core/polygon.h"

namespace plat::parcels {

/// The least length along a street that counts as street access, metres: a person gets through.
inline constexpr double kStreetAccess_m = 1.0;

/// A parcel of a block. Parcels of one block form a coverage (coverage.h): no gap, no overlap, and
/// the same vertices on both sides of every common boundary.
struct Parcel {
  ParcelId id;  ///< unique in its block; the same seed and options give the same parcel the same id
  Polygon shape;

  friend bool operator==(const Parcel&, const Parcel&) = default;
};

}  // namespace plat::parcels
