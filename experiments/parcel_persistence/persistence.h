#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "editing/city.h"
#include "parcels/parcel_matching.h"

namespace plat::persistence {

/// What became of the parcels of the blocks that one edit changed, by one matching. Sums, so that
/// edits can be added up; README.md defines each.
struct Persistence {
  double old_parcels = 0.0;
  double new_parcels = 0.0;
  double survivors = 0.0;    ///< old parcels whose warped shape is again a parcel
  double recognised = 0.0;   ///< survivors whose id the right new parcel has
  double kept = 0.0;         ///< old parcels whose id some new parcel has
  double transferred = 0.0;  ///< new parcels that inherit from the warped parcel they lie on most
  double iou = 0.0;          ///< over new parcels: IoU with the warped match; 0 without a match

  Persistence& operator+=(const Persistence& other);
};

inline constexpr std::array kMatchings{parcels::ParcelMatching::kRelativeDistances,
                                       parcels::ParcelMatching::kNearestCentroid,
                                       parcels::ParcelMatching::kLargestOverlap};

/// IoU from which a new parcel is the old one: above one half, at most one can be.
inline constexpr double kSameParcel_iou = 0.5;

/// One entry per matching; nullopt where fewer than three corners of the block correspond, so that
/// there is no deformation to warp by, or where one of the two could not be divided.
std::optional<std::array<Persistence, kMatchings.size()>> persistence_of(
    const editing::CityBlock& before, const editing::CityBlock& after);

}  // namespace plat::persistence
