#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/polygon.h"
#include "streets/intersection_point.h"
#include "streets/street_chains.h"
#include "streets/street_grower.h"
#include "streets/street_hierarchy.h"
#include "streets/street_network.h"

namespace plat::streets {

struct ExemplarOptions {
  ChainOptions chains{};
  HierarchyOptions hierarchy{};
  double parcel_radius_m = 60.0;  ///< parcels whose centroid is nearer than this are nearby
  /// Those of chains and hierarchy have lists of their own.
  static constexpr auto fields() {
    return std::tuple{Field{"parcel_radius_m", &ExemplarOptions::parcel_radius_m, 1.0, 1000.0,
                            "Parcels whose centroid is nearer than this to a point are nearby."}};
  }
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
  std::vector<PassingStreet> styles;  ///< one per chain; its `connections` say nothing
};

/// Takes the attributed intersection points from a network.
///
/// Guarantees: 1. a point lies at every node where chains meet or where one ends, and at no other;
/// 2. at such a node every passage and every end of a chain is the street of exactly one point, so
/// that the connections of a node's points add up to its degree;  3. they are paired in the order
/// of their hierarchy, at equal hierarchy those that pass before those that end, then the longer: n
/// of them make ceil(n / 2) points at one place;  4. all points of a chain carry its style, but for
/// the connections;  5. nothing depends on the order or the sense of the network's streets.
/// A chain that comes by a node twice (a loop that ends on its own stem) counts twice there, and
/// may be both streets of a point. A closed chain that meets no other has no point.
/// Pre: every street has a width (street_width.h); the parcels' coordinates are finite.
/// Complexity: O(n log n), and the parcels nearby.
/// Paper: [AVB08, Sec. 3.1.1 and 5].
/// Deviation: the paper takes all pair-wise intersections; at a crossing of n streets each would
/// then have n - 1 times the connections that were observed (ADR 0026).
Exemplar exemplar_of(const StreetNetwork& network, std::span<const Polygon> parcels,
                     const ExemplarOptions& options = {});

/// Where the streets of `existing` may go on: at each of its nodes, every chain that ends there,
/// straight on from its last piece. Sorted by node, then chain.
/// Pre: `exemplar` was taken from `existing`.
std::vector<OpenEnd> open_ends_of(const StreetNetwork& existing, const Exemplar& exemplar);

}  // namespace plat::streets
