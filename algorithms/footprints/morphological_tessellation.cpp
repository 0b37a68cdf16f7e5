#include "footprints/morphological_tessellation.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/box.h"
#include "core/working_grid.h"
#include "parcels/partition.h"

namespace plat::footprints {
namespace {

// Inexact constructions suffice: a Voronoi node is rounded to the working grid anyway, and the
// coverage comes from noding, not from these coordinates.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Faces = CGAL::Triangulation_face_base_with_info_2<std::int32_t, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices, Faces>>;
using parcels::BlockPartition;

/// How far cuts reach beyond the block, so that they end outside for certain, metres.
constexpr double kReach_m = 10.0;
/// A sample moved inside by d may lie this much nearer to the outline: rounding to the grid.
constexpr double kSampleSlack_m = 2.0 * kGridStep_m;

struct Sample {
  Point point;
  std::uint32_t footprint = 0;
};

/// Points on the outline moved inside by `shrink_m`: symmetric along each edge, without those that
/// come nearer to another edge than the outline itself did.
void add_samples(const Polygon& footprint, std::uint32_t index, double shrink_m, double segment_m,
                 std::vector<Sample>& out) {
  const std::size_t before = out.size();
  for_each_edge(footprint, [&](const Segment& edge) {
    const double edge_length = length(edge);
    if (edge_length <= 0.0) return;
    const Point inward = shrink_m * perpendicular(normalized(edge.b - edge.a));
    const int count = std::max(1, static_cast<int>(std::ceil(edge_length / segment_m)));
    for (int i = 0; i < count; ++i) {
      const Point p = snap(lerp(edge.a, edge.b, (i + 0.5) / count) + inward);
      if (shrink_m > 0.0 && (locate(footprint, p) != Side::kInside ||
                             boundary_distance_m(footprint, p) < shrink_m - kSampleSlack_m))
        continue;
      out.push_back({p, index});
    }
  });
  if (out.size() == before) out.push_back({snap(interior_point(footprint)), index});
}

Triangulation triangulate(std::vector<Sample> samples) {
  // Overlapping footprints may share a sample: the first in the order of their place keeps it.
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return std::tie(a.point.x, a.point.y, a.footprint) <
           std::tie(b.point.x, b.point.y, b.footprint);
  });
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> points;
  for (const Sample& s : samples) {
    const Kernel::Point_2 p(s.point.x, s.point.y);
    if (points.empty() || points.back().first != p) points.emplace_back(p, s.footprint);
  }
  return {points.begin(), points.end()};
}

/// The part of a segment within a box (Liang and Barsky).
std::optional<Segment> clip(const Segment& s, const Box& box) {
  double low = 0.0;
  double high = 1.0;
  const Point d = s.b - s.a;
  const auto cut = [&](double direction, double room) {
    if (direction == 0.0) return room >= 0.0;
    const double t = room / direction;
    if (direction < 0.0) {
      low = std::max(low, t);
    } else {
      high = std::min(high, t);
    }
    return low <= high;
  };
  if (!cut(-d.x, s.a.x - box.min.x) || !cut(d.x, box.max.x - s.a.x) ||
      !cut(-d.y, s.a.y - box.min.y) || !cut(d.y, box.max.y - s.a.y))
    return std::nullopt;
  return Segment{low > 0.0 ? lerp(s.a, s.b, low) : s.a, high < 1.0 ? lerp(s.a, s.b, high) : s.b};
}

/// Keeps the ends and every point more than `tolerance_m` off (Douglas and Peucker).
void simplify(std::span<const Point> line, double tolerance_m, Polyline& out) {
  double farthest_m = tolerance_m;
  std::size_t at = 0;
  const Segment chord{line.front(), line.back()};
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const double d = distance(chord, line[i]);
    if (d > farthest_m) {
      farthest_m = d;
      at = i;
    }
  }
  if (at == 0) {
    out.push_back(line.back());
    return;
  }
  simplify(line.subspan(0, at + 1), tolerance_m, out);
  simplify(line.subspan(at), tolerance_m, out);
}

/// The Voronoi edges between samples of different footprints, as a graph of Voronoi nodes.
struct Ridges {
  std::vector<Point> nodes;
  std::vector<std::vector<std::uint32_t>> neighbours;

  std::uint32_t add_node(Point p) {
    nodes.push_back(p);
    neighbours.emplace_back();
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }
  void add_edge(std::uint32_t a, std::uint32_t b) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
};

Point to_point(const Kernel::Point_2& p) { return {p.x(), p.y()}; }

Ridges find_ridges(Triangulation& triangulation, const Box& reach) {
  Ridges out;
  for (auto face : triangulation.all_face_handles()) face->info() = -1;
  const auto node_of = [&](Triangulation::Face_handle face) {
    if (face->info() < 0) {
      const auto& t = triangulation.triangle(face);
      face->info() =
          static_cast<std::int32_t>(out.add_node(to_point(CGAL::circumcenter(t[0], t[1], t[2]))));
    }
    return static_cast<std::uint32_t>(face->info());
  };
  // A ray, or a whole line where all samples are collinear, is cut off where it leaves the reach.
  const double far_m = 2.0 * (reach.width() + reach.height());
  for (const auto& edge : triangulation.finite_edges()) {
    const auto a = edge.first->vertex(Triangulation::cw(edge.second));
    const auto b = edge.first->vertex(Triangulation::ccw(edge.second));
    if (a->info() == b->info()) continue;
    const Point pa = to_point(a->point());
    const Point pb = to_point(b->point());
    const Point middle = midpoint(pa, pb);
    const Point along = far_m * normalized(perpendicular(pb - pa));
    if (triangulation.dimension() < 2) {
      out.add_edge(out.add_node(middle - along), out.add_node(middle + along));
      continue;
    }
    const auto left = edge.first;
    const auto right = left->neighbor(edge.second);
    if (!triangulation.is_infinite(left) && !triangulation.is_infinite(right)) {
      out.add_edge(node_of(left), node_of(right));
      continue;
    }
    const bool is_left_infinite = triangulation.is_infinite(left);
    const auto finite = is_left_infinite ? right : left;
    const auto third = to_point(
        finite
            ->vertex(is_left_infinite ? triangulation.mirror_index(left, edge.second) : edge.second)
            ->point());
    const Point outward = orientation(pa, pb, third) > 0.0 ? -along : along;
    const std::uint32_t start = node_of(finite);
    out.add_edge(start, out.add_node(out.nodes[start] + outward));
  }
  return out;
}

/// The ridges as chains between junctions, simplified, within reach of the block.
std::vector<Segment> cuts_along(const Ridges& ridges, double simplify_m, const Box& reach) {
  std::vector<Segment> cuts;
  const auto add_chain = [&](const Polyline& chain) {
    // What leaves the reach is split off: its nodes may lie anywhere.
    Polyline run;
    const auto flush = [&] {
      if (run.size() > 1) {
        Polyline simple{run.front()};
        simplify(run, simplify_m, simple);
        for (std::size_t i = 0; i + 1 < simple.size(); ++i)
          cuts.push_back({snap(simple[i]), snap(simple[i + 1])});
      }
      run.clear();
    };
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::optional<Segment> part = clip({chain[i], chain[i + 1]}, reach);
      if (!part || (!run.empty() && run.back() != part->a)) flush();
      if (!part) continue;
      if (run.empty()) run.push_back(part->a);
      run.push_back(part->b);
    }
    flush();
  };
  std::vector<std::vector<bool>> is_used(ridges.nodes.size());
  for (std::size_t n = 0; n < ridges.nodes.size(); ++n)
    is_used[n].resize(ridges.neighbours[n].size());
  const auto take = [&](std::uint32_t from, std::size_t slot) {
    const std::uint32_t to = ridges.neighbours[from][slot];
    is_used[from][slot] = true;
    for (std::size_t i = 0; i < ridges.neighbours[to].size(); ++i) {
      if (ridges.neighbours[to][i] == from && !is_used[to][i]) {
        is_used[to][i] = true;
        break;
      }
    }
    return to;
  };
  const auto walk = [&](std::uint32_t start, std::size_t slot) {
    Polyline chain{ridges.nodes[start]};
    std::uint32_t at = take(start, slot);
    chain.push_back(ridges.nodes[at]);
    while (at != start && ridges.neighbours[at].size() == 2) {
      const std::size_t next = is_used[at][0] ? 1 : 0;
      if (is_used[at][next]) break;
      at = take(at, next);
      chain.push_back(ridges.nodes[at]);
    }
    add_chain(chain);
  };
  // From junctions and ends first; what is left then are closed chains.
  for (const bool is_closed_turn : {false, true}) {
    for (std::uint32_t n = 0; n < ridges.nodes.size(); ++n) {
      if (!is_closed_turn && ridges.neighbours[n].size() == 2) continue;
      for (std::size_t slot = 0; slot < ridges.neighbours[n].size(); ++slot) {
        if (!is_used[n][slot]) walk(n, slot);
      }
    }
  }
  return cuts;
}

/// Joins neighbouring regions of the same footprint until there are none.
void join_equals(BlockPartition& partition, std::vector<std::uint32_t>& label) {
  for (const std::uint32_t region : partition.regions()) {
    if (partition.region_of_cell(region) != region) continue;  // joined meanwhile
    for (bool has_joined = true; has_joined;) {
      has_joined = false;
      for (const auto& border : partition.borders(region)) {
        if (label[border.neighbour] != label[region]) continue;
        partition.join(region, border.neighbour);
        has_joined = true;
      }
    }
  }
}

/// Of several regions of one footprint only the largest stays; the others go to their longest
/// neighbour, smallest first.
void keep_largest(BlockPartition& partition, std::vector<std::uint32_t>& label) {
  std::map<std::uint32_t, std::uint32_t> largest;
  for (const std::uint32_t region : partition.regions()) {
    const auto [it, is_new] = largest.try_emplace(label[region], region);
    if (!is_new && partition.area_m2(region) > partition.area_m2(it->second)) it->second = region;
  }
  std::vector<std::pair<double, std::uint32_t>> extra;
  for (const std::uint32_t region : partition.regions()) {
    if (largest.at(label[region]) != region) extra.emplace_back(partition.area_m2(region), region);
  }
  std::sort(extra.begin(), extra.end());
  for (const auto& [area, region] : extra) {
    if (const auto neighbour = partition.longest_neighbour(region))
      partition.join(*neighbour, region);
  }
}

}  // namespace

Expected<Tessellation> MorphologicalTessellation::tessellate(
    const blocks::Block& block, std::span<const Polygon> footprints) const {
  Tessellation out;
  std::vector<Sample> samples;
  for (std::uint32_t i = 0; i < footprints.size(); ++i) {
    const Polygon shape = snap_polygon(footprints[i]);
    const double area = shape.outer.size() < 3 ? 0.0 : area_m2(shape);
    if (area <= 0.0 || area < options_.min_footprint_m2) continue;
    add_samples(shape, i, options_.shrink_m, options_.segment_m, samples);
  }
  if (samples.empty()) {
    return fail(FailureCode::kNoObservation,
                fmt::format("none of {} footprints in the block reaches {} m2", footprints.size(),
                            options_.min_footprint_m2));
  }
  Triangulation triangulation = triangulate(std::move(samples));
  const Box reach = box_of(block.contour).expanded(kReach_m);
  const std::vector<Segment> cuts =
      cuts_along(find_ridges(triangulation, reach), options_.simplify_m, reach);
  auto partition = BlockPartition::cut(block, cuts);
  if (!partition) return tl::unexpected(partition.error());

  std::vector<std::uint32_t> label(partition->cell_count());
  for (std::uint32_t cell = 0; cell < label.size(); ++cell) {
    const Point p = interior_point(partition->cell_polygon(cell));
    label[cell] = triangulation.nearest_vertex(Kernel::Point_2(p.x, p.y))->info();
  }
  join_equals(*partition, label);
  keep_largest(*partition, label);

  const std::vector<std::uint32_t> regions = partition->regions();
  std::vector<parcels::Parcel> plots = partition->parcels();
  expects(plots.size() == regions.size(), "one parcel per region");
  std::vector<std::pair<std::uint32_t, std::size_t>> order;
  order.reserve(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) order.emplace_back(label[regions[i]], i);
  std::sort(order.begin(), order.end());
  std::vector<bool> has_plot(footprints.size());
  for (const auto& [footprint, i] : order) {
    out.plots.push_back(
        {ParcelId{static_cast<std::uint32_t>(out.plots.size())}, std::move(plots[i].shape)});
    out.footprint_of_plot.push_back(footprint);
    has_plot[footprint] = true;
  }
  for (std::uint32_t i = 0; i < has_plot.size(); ++i) {
    if (!has_plot[i]) out.without_plot.push_back(i);
  }
  return out;
}

}  // namespace plat::footprints
