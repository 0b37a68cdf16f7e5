#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/rng.h"
#include "parcels/partition.h"
#include "parcels/slices.h"

namespace plat::parcels {

/// What the lots of a strip should be like.
struct LotRules {
  double area_min_m2 = 150.0;
  double area_max_m2 = 900.0;
  double triangle_max_m2 = 525.0;  ///< triangular lots below this are merged
  double shallow_m = 0.0;          ///< rows less deep than this are too shallow for two; 0 = never
  SliceSpacing spacing;
  CornerScheme corners = CornerScheme::kStreetWidth;  ///< which of two shallow rows stays
};

/// The lots cut from a block's strips, while the special cases of [VKW12, Sec. 4.2.3] put them
/// right. Patios are land without access on purpose: what lies in them is left as it is.
///
/// Guarantees: 1. after merge_small() no lot outside the patios is without street access, below
/// area_min_m2, or a triangle below triangle_max_m2, unless it is the only one.
class StripLots {
 public:
  /// @param cuts     as BlockPartition::cut
  /// @param patios   what the offset contour encloses; cut out by `cuts` as well
  static Expected<StripLots> cut(const blocks::Block& block, std::span<const Segment> cuts,
                                 std::vector<Polygon> patios);

  /// Two rows back to back that are each less deep than `shallow_m` become one: their lots are
  /// joined and sliced anew, from the front on the more important street through to the other side.
  Expected<void> group_shallow(const LotRules& rules, Rng& rng);

  /// A lot above `area_max_m2` is cut by a ray from the middle of its front, again and again while
  /// the halves keep half the mean width.
  Expected<void> split_large(const LotRules& rules);

  void merge_small(const LotRules& rules);

  [[nodiscard]] std::vector<Parcel> parcels() const { return partition_.parcels(); }

 private:
  StripLots(const blocks::Block& block, BlockPartition partition, std::vector<Polygon> patios);

  /// Cuts anew: what separates two lots now, and `more`.
  Expected<void> cut_again(const std::vector<Segment>& more);
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> shallow_rows(const LotRules& rules) const;
  void slice_row(std::uint32_t row, const LotRules& rules, Rng& rng,
                 std::vector<Segment>& cuts) const;
  [[nodiscard]] std::optional<std::uint32_t> heir(std::uint32_t region) const;

  const blocks::Block* block_;
  BlockPartition partition_;
  std::vector<Polygon> patios_;
  std::vector<bool> is_patio_;  ///< per cell of the partition
};

}  // namespace plat::parcels
