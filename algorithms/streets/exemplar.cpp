#include "streets/exemplar.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "streets/segment_index.h"
#include "streets/street_style.h"

namespace plat::streets {
namespace {

/// A chain at a node: it passes, or it ends there.
struct Visit {
  std::uint32_t chain = 0;
  int connections = 0;  ///< 2 where it passes, 1 where it ends
};

/// How many of a chain's nodes are places of their own: the last one of a closed chain is its
/// first.
std::size_t stop_count(const StreetChain& chain) {
  return chain.is_closed ? chain.pieces.size() : chain.nodes.size();
}

std::vector<std::vector<Visit>> visits_by_node(const StreetNetwork& network,
                                               const std::vector<StreetChain>& chains) {
  std::vector<std::vector<Visit>> visits(network.nodes.size());
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    const StreetChain& chain = chains[c];
    for (std::size_t i = 0; i < stop_count(chain); ++i) {
      const bool is_end = !chain.is_closed && (i == 0 || i + 1 == chain.nodes.size());
      visits[chain.nodes[i]].push_back({c, is_end ? 1 : 2});
    }
  }
  return visits;
}

/// A node that one chain only passes is where its shape or an attribute changes.
bool is_intersection(const std::vector<Visit>& visits) {
  return visits.size() > 1 || (visits.size() == 1 && visits.front().connections == 1);
}

std::vector<PassingStreet> styles_of(const StreetNetwork& network,
                                     const std::vector<StreetChain>& chains,
                                     const std::vector<std::vector<Visit>>& visits) {
  std::vector<PassingStreet> styles;
  styles.reserve(chains.size());
  std::vector<std::size_t> stops;
  for (const StreetChain& chain : chains) {
    stops.clear();
    for (std::size_t i = 0; i < stop_count(chain); ++i) {
      if (is_intersection(visits[chain.nodes[i]])) stops.push_back(i);
    }
    styles.push_back(style_of(network, chain, stops));
  }
  return styles;
}

/// Finds the mean area of the parcels near a place.
class ParcelSurroundings {
 public:
  ParcelSurroundings(std::span<const Polygon> parcels, double radius_m)
      : centroids_(centroids_of(parcels)), radius_m_(radius_m) {
    for (const Polygon& parcel : parcels) areas_m2_.push_back(area_m2(parcel));
  }

  [[nodiscard]] std::optional<double> mean_area_m2(Point place) const {
    double sum_m2 = 0.0;
    std::size_t count = 0;
    centroids_.for_each_near(Box{place, place}.expanded(radius_m_), [&](std::uint32_t i) {
      if (!(distance(centroids_.segments()[i].a, place) < radius_m_)) return;
      sum_m2 += areas_m2_[i];
      ++count;
    });
    if (count == 0) return std::nullopt;
    return sum_m2 / static_cast<double>(count);
  }

 private:
  static SegmentIndex centroids_of(std::span<const Polygon> parcels) {
    std::vector<Segment> out;
    out.reserve(parcels.size());
    for (const Polygon& parcel : parcels) {
      const Point middle = centroid(parcel);
      out.push_back({middle, middle});  // lies in one cell, and is visited once
    }
    return SegmentIndex(std::move(out));
  }

  SegmentIndex centroids_;
  std::vector<double> areas_m2_;
  double radius_m_;
};

PassingStreet street_at(const std::vector<PassingStreet>& styles, const Visit& visit) {
  PassingStreet street = styles[visit.chain];
  street.connections = visit.connections;
  return street;
}

/// The points of one node: its visits in the order of their hierarchy, two by two.
void add_points(Exemplar& exemplar, std::span<const double> lengths_m, Point place,
                std::vector<Visit> visits, std::optional<double> parcel_area_m2) {
  std::sort(visits.begin(), visits.end(), [&](const Visit& a, const Visit& b) {
    const auto key = [&](const Visit& v) {
      return std::tuple(exemplar.chains[v.chain].hierarchy, -v.connections, -lengths_m[v.chain],
                        v.chain);
    };
    return key(a) < key(b);
  });
  for (std::size_t i = 0; i < visits.size(); i += 2) {
    IntersectionPoint point{place, street_at(exemplar.styles, visits[i]), {}, parcel_area_m2};
    Exemplar::Chains chains{visits[i].chain, {}};
    if (i + 1 < visits.size()) {
      point.b = street_at(exemplar.styles, visits[i + 1]);
      chains.b = visits[i + 1].chain;
    }
    exemplar.points.push_back(point);
    exemplar.chains_of_point.push_back(chains);
  }
}

}  // namespace

Exemplar exemplar_of(const StreetNetwork& network, std::span<const Polygon> parcels,
                     const ExemplarOptions& options) {
  Exemplar exemplar;
  exemplar.chains = chains_of(network, options.chains);
  assign_hierarchy(network, exemplar.chains, options.hierarchy);
  const auto visits = visits_by_node(network, exemplar.chains);
  exemplar.styles = styles_of(network, exemplar.chains, visits);
  std::vector<double> lengths_m;
  for (const StreetChain& chain : exemplar.chains) lengths_m.push_back(length_m(network, chain));
  const ParcelSurroundings surroundings(parcels, options.parcel_radius_m);
  std::vector<std::size_t> by_place(network.nodes.size());
  std::iota(by_place.begin(), by_place.end(), 0U);
  std::stable_sort(by_place.begin(), by_place.end(), [&](std::size_t a, std::size_t b) {
    return network.nodes[a] < network.nodes[b];
  });
  for (const std::size_t node : by_place) {
    if (!is_intersection(visits[node])) continue;
    const Point place = network.nodes[node];
    add_points(exemplar, lengths_m, place, visits[node], surroundings.mean_area_m2(place));
  }
  return exemplar;
}

std::vector<OpenEnd> open_ends_of(const StreetNetwork& existing, const Exemplar& exemplar) {
  expects(exemplar.styles.size() == exemplar.chains.size(), "an exemplar has a style per chain");
  std::vector<OpenEnd> ends;
  const auto add = [&](std::size_t chain, std::uint32_t node, StreetChain::Piece last) {
    expects(last.street < existing.streets.size(), "the exemplar is of the existing network");
    PassingStreet street = exemplar.styles[chain];
    street.connections = 1;
    ends.push_back({node, street, -heading_of(existing.streets[last.street], last.is_reversed)});
  };
  for (std::size_t c = 0; c < exemplar.chains.size(); ++c) {
    const StreetChain& chain = exemplar.chains[c];
    if (chain.is_closed) continue;
    add(c, chain.nodes.front(), chain.pieces.front());
    // The last piece, seen from its end.
    add(c, chain.nodes.back(), {chain.pieces.back().street, !chain.pieces.back().is_reversed});
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const OpenEnd& a, const OpenEnd& b) { return a.node < b.node; });
  return ends;
}

}  // namespace plat::streets
