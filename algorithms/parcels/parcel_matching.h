#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "parcels/parcel.h"

namespace plat::parcels {

/// Which parcel of a block before an edit a parcel after it takes the place of.
enum class ParcelMatching {
  kRelativeDistances,  ///< nearest by relative distances to the contour's vertices [VKW12, 5.2]
  kNearestCentroid,    ///< baseline: nearest centroid, metres
  kLargestOverlap,     ///< baseline: largest common area; none where nothing overlaps
};
std::string_view matching_name(ParcelMatching matching);
std::optional<ParcelMatching> matching_named(std::string_view name);

/// The outer contour of a block with its parcels, before or after an edit.
struct MatchedBlock {
  std::span<const Point> contour;
  /// What each edge of the contour faces, edge i running from vertex i to i + 1: equal numbers
  /// before and after are the same street. Empty where that is not known.
  std::span<const std::uint32_t> labels;
  std::span<const Parcel> parcels;
};

/// Vertices of the contour before and after that are the same corner of the block, in ring order.
///
/// A vertex that is straight, such as a new T-junction, is left out. With labels, a corner is known
/// by the two streets that meet in it; a pair of streets that meets several times counts where it
/// meets equally often, in ring order. Without, contours of equally many corners are paired in the
/// turn that a similarity maps best (of equally good ones the least rotated); else those that are
/// each other's nearest.
/// Paper:     [VKW12, Sec. 5.2], which assumes order and number unchanged
/// Deviation: any change of the corners is allowed; those without a partner are ignored (ADR 0013)
std::vector<std::pair<Point, Point>> corresponding_corners(const MatchedBlock& before,
                                                           const MatchedBlock& after);

/// Fewer corners do not tell a place from its mirror image.
inline constexpr std::size_t kMinMatchedCorners = 3;

struct ParcelMatch {
  std::uint32_t predecessor = 0;  ///< index among the parcels before
  double distance = 0.0;          ///< of the matching's own kind: the smaller the better

  friend bool operator==(const ParcelMatch&, const ParcelMatch&) = default;
};

/// For every parcel after the edit, the nearest one before it [VKW12, Sec. 5.2]; several may share
/// one.
///
/// Guarantees: 1. relative_distances does not depend on how the block is translated, rotated or
/// uniformly scaled between the two steps, up to rounding;  2. equal parcels in equal contours
/// match themselves;  3. of equally near ones the lowest index is taken.
/// Deviation: with fewer than three corresponding corners, relative distances say too little, and
/// centroids are compared (ADR 0013). Complexity: O(m n k) for k corners.
std::vector<std::optional<ParcelMatch>> match_parcels(ParcelMatching matching,
                                                      const MatchedBlock& before,
                                                      const MatchedBlock& after);

}  // namespace plat::parcels
