#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/affine.h"
#include "editing/city.h"
#include "editing/street_grid.h"
#include "tiles/tile_layout.h"

namespace plat::editing {

/// Tiles farther from a street than this do not take it along, metres: half of the widest street
/// and what stands between it and the tiles.
inline constexpr double kFollowReach_m = 80.0;
/// A street keeps its width where the fronts beside it come nearer or farther by less than this.
inline constexpr double kWidthStep_m = 0.01;

/// How points between tiles go along with them: by the mean of where each tile within
/// kFollowReach_m would carry the point, as with a part of itself.
///
/// A tile at distance d has the weight (1 - d / reach)^2 / (d + 1 m)^2. Where the nearest tile is
/// farther than half the reach, the motion fades to none at the reach.
/// Guarantees: 1. where all tiles near a point are moved by one map, the point is moved by that
/// map; 2. the field is continuous, and turned with the tiles if both are turned; 3. where no tile
/// moved, no point moves, to the last bit.
/// Paper: [ABVA08, Sec. 4] has no street network of its own: streets are what tiles leave.
class StreetFollowing {
 public:
  StreetFollowing(const tiles::TileLayout& before, const tiles::TileLayout& after);

  [[nodiscard]] Point operator()(Point p) const;
  /// Whether a tile that moved is in reach of the point.
  [[nodiscard]] bool reaches(Point p) const;
  /// What takes a tile from before to after; nullopt where it is gone.
  [[nodiscard]] const std::optional<Affine>& motion(std::uint32_t tile) const {
    return motions_[tile];
  }

 private:
  using TileIndex = Id<struct TileIndexTag>;
  std::vector<Polygon> shapes_;                 // before
  std::vector<std::optional<Affine>> motions_;  // per tile before
  std::vector<bool> is_moved_;
  IdGrid<TileIndex> grid_;
};

/// By how much the distance between the fronts of each street changes, metres: the mean over the
/// links across it of how far their two ends part, across the street. Streets without a change of
/// kWidthStep_m are left out.
std::map<StreetId, double> width_changes(const City& city, const tiles::TileLayout& before,
                                         const StreetFollowing& following);

}  // namespace plat::editing
