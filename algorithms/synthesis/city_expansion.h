#pragma once

#include <cstdint>
#include <span>
#include <tuple>

#include "core/failure.h"
#include "core/options.h"
#include "core/polygon.h"
#include "streets/exemplar.h"
#include "streets/street_grower.h"
#include "synthesis/point_set.h"

namespace plat::synthesis {

/// Where the first copy of the example lies.
enum class CopyPlace : std::uint8_t {
  kCentred,   ///< the middle of its box in the centroid of the region
  kAsPlaced,  ///< where the example lies
};

struct ExpansionOptions {
  Spacing spacing{};
  double clearance_share_01 = 0.5;
  double reach_m = 0.0;
  CopyPlace copy_place = CopyPlace::kCentred;
  static constexpr auto fields() {
    return std::tuple{
        Field{"clearance_share_01", &ExpansionOptions::clearance_share_01, 0.0, 2.0,
              "New points are no closer to existing streets than this share of their mean distance "
              "to the next intersection."},
        Field{"reach_m", &ExpansionOptions::reach_m, 0.0, 1000.0,
              "New streets may leave the region by this much, in m, to meet existing ones."},
        EnumField{
            "copy_place",
            &ExpansionOptions::copy_place,
            {EnumName{"centred", CopyPlace::kCentred}, EnumName{"as_placed", CopyPlace::kAsPlaced}},
            "Where the first copy of the example lies."}};
  }
};

/// A city that is about to grow into a region.
struct Expansion {
  streets::GrowthSite site;       ///< no obstacles: the caller knows them
  streets::Exemplar of_existing;  ///< of site.existing
  std::size_t copies = 0;         ///< of the example, of which points were used
  std::size_t cut_streets = 0;    ///< existing streets of which something was taken away
};

/// Prepares the growth of a city into a region: the region is emptied of streets and filled with
/// points of an example.
///
/// Existing streets are cut at the region's boundary (network_cut.h), and streets that end there or
/// within reach of it are open ends. Copies of the example, as it lies, are laid out in rows and
/// columns of its oriented box until the region is covered; where copies meet, the spacing holds
/// and the one nearer to the first copy stays (point_join.h). Points outside the region, or too
/// near to an existing street, are left out. Along the seam, the variances of distances and turns
/// of new points and open ends are at least those of unrelated fabrics, a uniform distribution over
/// one mean distance to each side, and an open end takes of the levels of the new point next to it
/// the one nearest to its own: where nothing is loosened, streets of the two do not find each
/// other. A box without width is as wide as the mean distance to the next intersection.
///
/// Guarantees: 1. points lie inside the region;  2. every point keeps its clearance from existing
/// streets;  3. streets that do not enter the region are unchanged;  4. open ends lie within reach
/// of the region, those of cut streets included;  5. `boundary` is the region, widened by the
/// reach;  6. an example larger than the region is used once, one that fits is not stretched;  7.
/// no variance is lowered, and points farther from the streets than a mean distance and the
/// clearance have the example's attributes. Pre: every existing street has a width
/// (street_width.h).
/// @param parcels  of the city, for the attributes of `of_existing`
/// @returns Failure for a region that is not a simple polygon
/// Paper: [AVB08, Sec. 4.2, "expand", and Fig. 9]
/// Deviation: copies in rows and columns, clearance and the seam are ours (ADR 0029)
Expected<Expansion> expand(const streets::StreetNetwork& existing, std::span<const Polygon> parcels,
                           const Polygon& region,
                           std::span<const streets::IntersectionPoint> example,
                           const ExpansionOptions& options = {},
                           const streets::ExemplarOptions& exemplar = {});

}  // namespace plat::synthesis
