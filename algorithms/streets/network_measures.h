#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "streets/network_routes.h"
#include "streets/street_chains.h"
#include "streets/street_network.h"

namespace plat::streets {

struct NetworkMeasureOptions {
  RouteOptions routes;
  ChainOptions chains;                 ///< what a street is, for the number of streets
  std::optional<double> land_area_m2;  ///< what densities are per; the faces' union if not given
};

/// What is measured on a street network, observed or grown (docs/measures.md defines each with its
/// unit, range and bins). Samples have one value per node, edge, face or route.
struct NetworkMeasures {
  NetworkGraph graph;    ///< what nodes and edges are
  RouteMeasures routes;  ///< betweenness, and what was drawn

  std::vector<double> node_degree;
  std::vector<double> edge_length_m;
  std::vector<double> block_area_m2;
  std::vector<double> block_perimeter_m;
  std::vector<double> block_aspect_ratio;
  std::vector<double> block_rectangularity;
  std::vector<double> transport_ratio;

  std::size_t intersections = 0;  ///< nodes of degree 3 or more
  std::size_t dead_ends = 0;      ///< nodes of degree 1
  std::size_t streets = 0;        ///< chains, where a street goes on straight
  double land_area_m2 = 0.0;      ///< 0 where no face is and none was given
  double circuity = 0.0;
  double orientation_entropy_nats = 0.0;         ///< every edge counts once
  double orientation_entropy_length_nats = 0.0;  ///< every edge counts by its length
};

/// Measures a network.
///
/// Guarantees: 1. the same network and stream give the same measures;  2. splitting streets at
/// places where nothing else meets changes nothing but rounding;  3. moving, turning or mirroring
/// the network leaves all but entropies and what is drawn as it is, up to rounding; a triangle has
/// three boxes of least area, and keeps none of their aspect ratios.
/// Pre: none of its streets has zero length.
NetworkMeasures measure_network(const StreetNetwork& network, const NetworkMeasureOptions& options,
                                Rng& rng);

/// A measure with a distribution: what is compared by KS and Wasserstein.
struct NetworkSample {
  std::string_view name;  ///< the unit in it
  std::string_view unit;  ///< empty for a ratio or a count
  std::string_view title;
  bool is_count = false;
  const std::vector<double>& (*values)(const NetworkMeasures&);
};

/// A measure with one value per network; nothing where it has none (a density without land).
struct NetworkScalar {
  std::string_view name;
  std::string_view unit;
  std::string_view title;
  std::optional<double> (*value)(const NetworkMeasures&);
};

/// The lists behind tables, files and docs, in the order of the columns.
std::span<const NetworkSample> network_samples();
std::span<const NetworkScalar> network_scalars();

}  // namespace plat::streets
