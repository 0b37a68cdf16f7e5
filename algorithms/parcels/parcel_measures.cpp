#include "parcels/parcel_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/failure.h"
#include "core/oriented_box.h"

namespace plat::parcels {
namespace {

/// Edges closer in direction than this run along each other: cos 25 degrees lets a quantised 2 m
/// edge follow a straight one.
constexpr double kParallelCosine = 0.9;
/// Shorter edges have no direction worth comparing.
constexpr double kShortestEdge_m = 0.01;

struct Edge {
  Segment segment;
  Point direction;      // unit
  double length_m;      // at least kShortestEdge_m
  Box box;              // grown by the larger tolerance
  std::uint32_t owner;  // parcel, or kStreet
};
constexpr std::uint32_t kStreet = 0xffffffffU;

/// A part of an edge, metres from its start.
struct Stretch {
  std::size_t edge;
  double begin;
  double end;
};

/// The part of `edge` that lies within `gap_m` of `other`, measured across `edge`; empty where end
/// <= begin.
std::pair<double, double> stretch_along(const Edge& edge, const Segment& other, double gap_m) {
  const Point normal = perpendicular(edge.direction);
  double s0 = dot(other.a - edge.segment.a, edge.direction);
  double s1 = dot(other.b - edge.segment.a, edge.direction);
  double d0 = dot(other.a - edge.segment.a, normal);
  double d1 = dot(other.b - edge.segment.a, normal);
  if (s0 > s1) {
    std::swap(s0, s1);
    std::swap(d0, d1);
  }
  double begin = std::max(0.0, s0);
  double end = std::min(edge.length_m, s1);
  if (!(end > begin)) return {0.0, 0.0};
  // The offset d is linear in s: the part with |d| <= gap is one interval.
  const double slope = (d1 - d0) / (s1 - s0);
  if (slope == 0.0) return std::abs(d0) <= gap_m ? std::pair{begin, end} : std::pair{0.0, 0.0};
  const double at_low = s0 + (-gap_m - d0) / slope;
  const double at_high = s0 + (gap_m - d0) / slope;
  begin = std::max(begin, std::min(at_low, at_high));
  end = std::min(end, std::max(at_low, at_high));
  return {begin, end};
}

void add_edge(std::vector<Edge>& edges, const Segment& segment, std::uint32_t owner) {
  const double size = length(segment);
  if (size < kShortestEdge_m) return;
  Box box;
  box.add(segment.a);
  box.add(segment.b);
  edges.push_back(
      {segment, (segment.b - segment.a) / size, size, box.expanded(0.5 * kFrontageGap_m), owner});
}

/// Parcel edges and street edges of the contour, from left to right.
std::vector<Edge> sorted_edges(const blocks::Block& block, std::span<const Polygon> parcels) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    for_each_edge(parcels[i], [&](const Segment& segment) {
      add_edge(edges, segment, static_cast<std::uint32_t>(i));
    });
  }
  for (std::size_t r = 0; r < block.edges.size(); ++r) {
    const Ring& ring = blocks::ring_at(block, r);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!block.edges[r][i].is_street()) continue;
      add_edge(edges, {ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]}, kStreet);
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    if (a.box.min.x != b.box.min.x) return a.box.min.x < b.box.min.x;
    if (a.segment.a != b.segment.a) return a.segment.a < b.segment.a;
    if (a.segment.b != b.segment.b) return a.segment.b < b.segment.b;
    return a.owner < b.owner;
  });
  return edges;
}

/// A length that two parcels have in common, first < second.
struct Shared {
  std::uint32_t first;
  std::uint32_t second;
  double length_m;
};

struct Contacts {
  std::vector<Shared> shared;
  std::vector<Stretch> fronting;  // on parcel edges
};

Contacts find_contacts(const std::vector<Edge>& edges) {
  Contacts out;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (edges[j].box.min.x > edges[i].box.max.x) break;
      if (edges[i].owner == edges[j].owner || !edges[i].box.intersects(edges[j].box)) continue;
      const double cosine = dot(edges[i].direction, edges[j].direction);
      if (edges[i].owner == kStreet || edges[j].owner == kStreet) {
        // Parcel and block both have their land on the left: they run the same way.
        if (cosine < kParallelCosine) continue;
        const std::size_t own = edges[i].owner == kStreet ? j : i;
        const auto [begin, end] =
            stretch_along(edges[own], edges[own == i ? j : i].segment, kFrontageGap_m);
        if (end > begin) out.fronting.push_back({own, begin, end});
        continue;
      }
      if (cosine > -kParallelCosine) continue;
      const bool is_ordered = edges[i].owner < edges[j].owner;
      const std::size_t base = edges[i].length_m >= edges[j].length_m ? i : j;
      const auto [begin, end] =
          stretch_along(edges[base], edges[base == i ? j : i].segment, kSharedGap_m);
      if (end > begin) {
        const Edge& first = is_ordered ? edges[i] : edges[j];
        const Edge& second = is_ordered ? edges[j] : edges[i];
        out.shared.push_back({first.owner, second.owner, end - begin});
      }
    }
  }
  return out;
}

using NeighbourPair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs of parcels with enough common boundary, sorted.
std::vector<NeighbourPair> neighbour_pairs(std::vector<Shared> shared) {
  std::sort(shared.begin(), shared.end(), [](const Shared& a, const Shared& b) {
    if (a.first != b.first) return a.first < b.first;
    if (a.second != b.second) return a.second < b.second;
    return a.length_m < b.length_m;  // sums must not depend on the order of the parcels
  });
  std::vector<NeighbourPair> pairs;
  for (std::size_t i = 0; i < shared.size();) {
    double sum = 0.0;
    std::size_t j = i;
    for (; j < shared.size() && shared[j].first == shared[i].first &&
           shared[j].second == shared[i].second;
         ++j)
      sum += shared[j].length_m;
    if (sum >= kSharedLength_m) pairs.emplace_back(shared[i].first, shared[i].second);
    i = j;
  }
  return pairs;
}

/// Where several street edges face the same part of a parcel's edge, that part counts once.
std::vector<Stretch> without_overlap(std::vector<Stretch> fronting) {
  std::sort(fronting.begin(), fronting.end(), [](const Stretch& a, const Stretch& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.begin < b.begin;
  });
  std::vector<Stretch> apart;
  for (const Stretch& stretch : fronting) {
    const bool continues = !apart.empty() && apart.back().edge == stretch.edge;
    const double begin = continues ? std::max(apart.back().end, stretch.begin) : stretch.begin;
    if (stretch.end > begin) apart.push_back({stretch.edge, begin, stretch.end});
  }
  return apart;
}

void add_frontage(std::vector<Stretch> fronting, const std::vector<Edge>& edges,
                  std::vector<ParcelMeasures>& measures) {
  const std::vector<Stretch> apart = without_overlap(std::move(fronting));
  for (std::size_t i = 0; i < apart.size();) {
    const std::size_t edge = apart[i].edge;
    double covered = 0.0;
    for (; i < apart.size() && apart[i].edge == edge; ++i) covered += apart[i].end - apart[i].begin;
    measures[edges[edge].owner].frontage_m += covered;
  }
}

int count_corners(const Ring& ring) {
  static const double cosine_limit = std::cos(kCornerTurn_deg * std::numbers::pi / 180.0);
  int corners = 0;
  Point before;
  // The last edge with a length comes before the first vertex.
  for (std::size_t i = ring.size(); i-- > 0 && before == Point{};)
    before = normalized(ring[(i + 1) % ring.size()] - ring[i]);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point edge = normalized(ring[(i + 1) % ring.size()] - ring[i]);
    if (edge == Point{}) continue;
    if (dot(before, edge) < cosine_limit) ++corners;
    before = edge;
  }
  return corners;
}

ParcelMeasures measure_shape(const Polygon& parcel) {
  ParcelMeasures m;
  m.area_m2 = area_m2(parcel);
  expects(m.area_m2 > 0.0, "a parcel has an area");
  m.perimeter_m = perimeter_m(parcel);
  const OrientedBox box = minimum_area_box(parcel);
  m.width_m = box.width_m;
  m.aspect_ratio = box.aspect_ratio();
  m.compactness = 4.0 * std::numbers::pi * m.area_m2 / (m.perimeter_m * m.perimeter_m);
  m.rectangularity = m.area_m2 / box.area_m2();
  m.corners = count_corners(parcel.outer);
  return m;
}

}  // namespace

std::vector<ParcelMeasures> measure_parcels(const blocks::Block& block,
                                            std::span<const Polygon> parcels) {
  std::vector<ParcelMeasures> measures;
  measures.reserve(parcels.size());
  for (const Polygon& parcel : parcels) measures.push_back(measure_shape(parcel));
  const std::vector<Edge> edges = sorted_edges(block, parcels);
  Contacts contacts = find_contacts(edges);
  for (const auto& [first, second] : neighbour_pairs(std::move(contacts.shared))) {
    ++measures[first].neighbours;
    ++measures[second].neighbours;
  }
  add_frontage(std::move(contacts.fronting), edges, measures);
  for (ParcelMeasures& m : measures) m.has_street_access = m.frontage_m >= kStreetAccess_m;
  return measures;
}

std::vector<int> parcel_rows(const blocks::Block& block, std::span<const Polygon> parcels) {
  const std::vector<Edge> edges = sorted_edges(block, parcels);
  Contacts contacts = find_contacts(edges);
  std::vector<ParcelMeasures> measures(parcels.size());
  add_frontage(std::move(contacts.fronting), edges, measures);
  const std::vector<NeighbourPair> pairs = neighbour_pairs(std::move(contacts.shared));
  std::vector<int> rows(parcels.size(), 0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = measures[i].frontage_m >= kStreetAccess_m ? 1 : 0;
  // Row after row; a block has few.
  for (int row = 1, added = 1; added > 0; ++row) {
    added = 0;
    const auto place_behind = [&](std::uint32_t front, std::uint32_t behind) {
      if (rows[front] != row || rows[behind] != 0) return;
      rows[behind] = row + 1;
      ++added;
    };
    for (const auto& [first, second] : pairs) {
      place_behind(first, second);
      place_behind(second, first);
    }
  }
  return rows;
}

std::vector<std::vector<Segment>> street_fronts(const blocks::Block& block,
                                                std::span<const Polygon> parcels) {
  const std::vector<Edge> edges = sorted_edges(block, parcels);
  std::vector<std::vector<Segment>> fronts(parcels.size());
  for (const Stretch& stretch : without_overlap(find_contacts(edges).fronting)) {
    const Edge& edge = edges[stretch.edge];
    fronts[edge.owner].push_back({edge.segment.a + stretch.begin * edge.direction,
                                  edge.segment.a + stretch.end * edge.direction});
  }
  return fronts;
}

std::span<const MeasureColumn> measure_columns() {
  using M = const ParcelMeasures&;
  static constexpr std::array kColumns{
      MeasureColumn{"area_m2", "m2", "area", "Area", MeasureKind::kContinuous,
                    [](M m) { return m.area_m2; }},
      MeasureColumn{"perimeter_m", "m", "perimeter", "Perimeter", MeasureKind::kContinuous,
                    [](M m) { return m.perimeter_m; }},
      MeasureColumn{"width_m", "m", "minimum width", "none", MeasureKind::kContinuous,
                    [](M m) { return m.width_m; }},
      MeasureColumn{"aspect_ratio", "", "aspect ratio", "1 / Elongation", MeasureKind::kContinuous,
                    [](M m) { return m.aspect_ratio; }},
      MeasureColumn{"neighbours", "", "number of neighbours", "Neighbors, within the block",
                    MeasureKind::kInteger, [](M m) { return static_cast<double>(m.neighbours); }},
      MeasureColumn{"frontage_m", "m", "street frontage", "none", MeasureKind::kContinuous,
                    [](M m) { return m.frontage_m; }},
      MeasureColumn{"has_street_access", "", "street access", "none", MeasureKind::kFlag,
                    [](M m) { return m.has_street_access ? 1.0 : 0.0; }},
      MeasureColumn{"compactness", "", "compactness", "none", MeasureKind::kContinuous,
                    [](M m) { return m.compactness; }},
      MeasureColumn{"rectangularity", "", "rectangularity", "Rectangularity",
                    MeasureKind::kContinuous, [](M m) { return m.rectangularity; }},
      MeasureColumn{"corners", "", "number of corners", "Corners", MeasureKind::kInteger,
                    [](M m) { return static_cast<double>(m.corners); }},
  };
  return kColumns;
}

}  // namespace plat::parcels
