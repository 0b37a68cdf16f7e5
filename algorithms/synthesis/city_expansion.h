#pragma once

#include <span>
#include <tuple>

#include "core/failure.h"
#include "core/options.h"
#include "core/polygon.h"
#include "streets/exemplar.h"
#include "streets/street_grower.h"
#include "synthesis/point_set.h"

namespace plat::synthesis {

struct ExpansionOptions {
  Spacing spacing;
  double clearance_share_01 = 0.5;
  double reach_m = 0.0;
  static constexpr auto fields() {
    return std::tuple{
        Field{"clearance_share_01", &ExpansionOptions::clearance_share_01, 0.0, 2.0,
              "New points are no closer to existing streets than this share of their mean distance "
              "to the next intersection."},
        Field{"reach_m", &ExpansionOptions::reach_m, 0.0, 1000.0,
              "New streets may leave the region by this much, in m, to meet existing ones."}};
  }
};

/// Prepares the growth of a city into a region: the region is emptied of streets and filled with
/// points of an example.
///
/// Existing streets are cut at the region's boundary; what lies inside is left out, and the cut
/// ends are open ends. Copies of the example, as it lies, are laid out in rows and columns of its
/// oriented box, one of them in the middle of the region, until the region is covered; where copies
/// meet, the spacing holds (join()). Points outside the region, or too near to an existing street,
/// are left out.
///
/// Guarantees: 1. points lie inside the region;  2. every point keeps its clearance from existing
/// streets;  3. streets outside the region are unchanged;  4. open ends lie within reach of the
/// region, those of cut streets included;  5. `boundary` is the region, widened by the reach.
/// @returns Failure for a region that is not a polygon, or an example without points
/// Paper: [AVB08, Sec. 4.2, "expand", and Fig. 9]
/// Deviation: tiling and clearance are ours (ADR 0029)
Expected<streets::GrowthSite> expand(const streets::StreetNetwork& existing, const Polygon& region,
                                     std::span<const streets::IntersectionPoint> example,
                                     const ExpansionOptions& options = {},
                                     const streets::ExemplarOptions& exemplar = {});

}  // namespace plat::synthesis
