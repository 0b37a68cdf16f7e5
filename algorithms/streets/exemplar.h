#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/polygon.h"
#include "streets/intersection_point.h"
#include "streets/street_chains.h"
#include "streets/street_grower.h"
#include "streets/street_network.h"

namespace plat::streets {

struct ExemplarOptions {
  ChainOptions chains;
  HierarchyOptions hierarchy;
  double parcel_radius_m = 60.0;  ///< parcels whose centroid is nearer than this are nearby
};

/// What can be copied from an observed street network: its intersection points with their
/// attributes.
struct Exemplar {
  std::vector<IntersectionPoint> points;  ///< sorted by place
  std::vector<StreetChain> chains;        ///< of the network it was taken from
  /// Per point the chains that are its streets a and b, for drawings and measures; growth does not
  /// see them.
  struct Chains {
    std::uint32_t a = 0;
    std::optional<std::uint32_t> b;
  };
  std::vector<Chains> chains_of_point;
};

/// Takes the attributed intersection points from a network.
/// Pre: every street has a width (street_width.h).
/// Paper: [AVB08, Sec. 3.1.1 and 5]
Exemplar exemplar_of(const StreetNetwork& network, std::span<const Polygon> parcels,
                     const ExemplarOptions& options = {});

/// Where the streets of `existing` may go on: at each of its nodes, every chain that ends there.
std::vector<OpenEnd> open_ends_of(const StreetNetwork& existing, const Exemplar& exemplar);

}  // namespace plat::streets
