#pragma once

#include <vector>

#include "core/rng.h"
#include "parcels/fronts.h"

namespace plat::parcels {

/// A rectangle on a front: `front` its side on the street, the land on its left.
struct PackedLot {
  Segment front;
  double depth_m = 0.0;
};

/// What is packed.
struct PackingSize {
  double width_m = 15.0;
  double width_deviation = 0.0;  ///< over the mean
  double depth_m = 30.0;
  double depth_min_m = 15.0;
};

/// Rectangles along the fronts of a block: longest front first, along each from its start, each at
/// the first place where it fits.
///
/// Guarantees: 1. lots lie inside the contour and beside each other, but for kPackingSlack_m.
std::vector<PackedLot> pack_lots(const blocks::Block& block, const PackingSize& size, Rng& rng);

/// The sides and rear of every lot, and the prolongations of its sides through the land behind it,
/// to the next lot or to the contour.
std::vector<Segment> packing_cuts(const blocks::Block& block, const std::vector<PackedLot>& lots);

/// The middle of a lot.
Point centre(const PackedLot& lot);

/// How far a lot may reach over its neighbours or a curved contour, metres: chords of curved fronts
/// do by their height.
inline constexpr double kPackingSlack_m = 0.3;

}  // namespace plat::parcels
