#pragma once

#include <optional>
#include <span>
#include <vector>

#include "blocks/block.h"
#include "parcels/parcel_style.h"
#include "streets/intersection_point.h"
#include "streets/street_network.h"

namespace plat::synthesis {

/// Mean and deviation of parcel areas that points store.
struct ParcelAreas {
  double mean_m2 = 0.0;
  double deviation_m2 = 0.0;  ///< of the sample (n - 1); 0 for a single place

  friend bool operator==(const ParcelAreas&, const ParcelAreas&) = default;
};

/// The parcel areas around a network: what the points at its nodes store.
///
/// Guarantees: 1. a place counts once, with the mean of its points, however many streets cross
/// there;  2. points without parcels say nothing.
/// Paper: a(v) and the standard deviation of these averages [AVB08, Sec. 3.1.2]
class PointAreas {
 public:
  /// One area per node of `network`.
  PointAreas(const streets::StreetNetwork& network,
             std::span<const streets::IntersectionPoint> points,
             std::span<const streets::IntersectionPoint> existing_points);

  /// Over the nodes of the streets that the block's contour faces; nullopt where none knows
  /// parcels.
  [[nodiscard]] std::optional<ParcelAreas> around(const blocks::Block& block) const;
  /// Over all nodes; nullopt where none knows parcels.
  [[nodiscard]] std::optional<ParcelAreas> everywhere() const;

 private:
  const streets::StreetNetwork& network_;
  std::vector<std::optional<double>> area_of_node_m2_;
};

/// What the parcels of a block should look like, going by their wanted areas.
///
/// n_b is the block's area over the mean. The paper determines the expected aspect ratio from the
/// area, too, and leaves open how: a lot here fills the block's depth, its area over the length of
/// its oriented box, in one row or in two, whichever makes it squarer; two where depth^2 exceeds
/// twice the area. All parcels have street access [AVB08, Sec. 3.1.2, egress rule].
/// Paper: [AVB08, Sec. 3.1.2].   Deviation: how the aspect ratio follows from the area (ADR 0030)
parcels::ParcelStyle style_for(const blocks::Block& block, const ParcelAreas& areas);

}  // namespace plat::synthesis
