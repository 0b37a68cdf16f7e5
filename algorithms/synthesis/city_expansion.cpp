#include "synthesis/city_expansion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "blocks/geos_internal.h"
#include "core/oriented_box.h"
#include "core/validity.h"
#include "core/working_grid.h"
#include "streets/segment_index.h"
#include "synthesis/network_cut.h"
#include "synthesis/place_groups_internal.h"
#include "synthesis/point_join.h"

namespace plat::synthesis {
namespace {

using streets::IntersectionPoint;
using streets::OpenEnd;
using streets::PassingStreet;
using streets::StreetNetwork;

constexpr std::size_t kMaxRegionVertices = 100000;

/// Rows and columns of copies.
struct Tiling {
  Point first;   ///< translation of the first copy
  Point column;  ///< from a copy to the next along the box, and across it
  Point row;
  std::vector<std::pair<int, int>> cells;  ///< column and row, the first copy first

  [[nodiscard]] Point translation(std::pair<int, int> cell) const {
    return first +
           snap(static_cast<double>(cell.first) * column + static_cast<double>(cell.second) * row);
  }
};

Tiling tiling_of(std::span<const PlaceGroup> example, const Polygon& region, CopyPlace copy_place) {
  std::vector<Point> places;
  double mean_m = 0.0;
  for (const PlaceGroup& group : example) {
    places.push_back(group.place);
    mean_m += group.mean_distance_m / static_cast<double>(example.size());
  }
  const OrientedBox box = minimum_area_box(places);
  const Point across = perpendicular(box.axis);
  const Point step{box.length_m > 0.0 ? box.length_m : mean_m,
                   box.width_m > 0.0 ? box.width_m : mean_m};
  Tiling out;
  if (copy_place == CopyPlace::kCentred) out.first = snap(centroid(region) - box.center);
  out.column = step.x * box.axis;
  out.row = step.y * across;

  Box extent;  // of the region, seen from the middle of the first copy
  for (const Point p : region.outer) {
    const Point arm = p - (box.center + out.first);
    extent.add(Point{dot(arm, box.axis), dot(arm, across)});
  }
  const auto first_and_last = [](double low, double high, double width) {
    if (width <= 0.0) return std::pair(0, 0);
    return std::pair(static_cast<int>(std::floor(low / width + 0.5)),
                     static_cast<int>(std::ceil(high / width - 0.5)));
  };
  const auto [left, right] = first_and_last(extent.min.x, extent.max.x, step.x);
  const auto [bottom, top] = first_and_last(extent.min.y, extent.max.y, step.y);
  for (int row = bottom; row <= top; ++row) {
    for (int column = left; column <= right; ++column) out.cells.emplace_back(column, row);
  }
  std::ranges::sort(out.cells, {}, [](std::pair<int, int> cell) {
    return std::tuple(std::max(std::abs(cell.first), std::abs(cell.second)), cell.second,
                      cell.first);
  });
  return out;
}

/// Says which places may get points: in the region, clear of the existing streets.
class Clearance {
 public:
  Clearance(const StreetNetwork& existing, const Polygon& region, double share_01)
      : region_(region), share_01_(share_01), index_(segments_of(existing)) {}

  [[nodiscard]] bool admits(Point place, double mean_distance_m) const {
    if (locate(region_, place) != Side::kInside) return false;
    return is_clear(place, share_01_ * mean_distance_m);
  }
  [[nodiscard]] bool is_clear(Point place, double needed_m) const {
    const auto nearest = index_.nearest(place, needed_m, [](std::uint32_t) { return true; });
    return !nearest || nearest->distance_m >= needed_m;
  }

 private:
  static std::vector<Segment> segments_of(const StreetNetwork& network) {
    std::vector<Segment> out;
    for (const streets::Street& street : network.streets) {
      for (std::size_t i = 0; i + 1 < street.line.size(); ++i) {
        out.push_back({street.line[i], street.line[i + 1]});
      }
    }
    return out;
  }

  const Polygon& region_;
  double share_01_;
  streets::SegmentIndex index_;
};

/// The copies' points that are admitted, a set per copy that has any.
std::vector<PointSet> copies_of(std::span<const IntersectionPoint> example, const Polygon& region,
                                const Clearance& clearance, CopyPlace copy_place) {
  const std::vector<PlaceGroup> groups = groups_of(example);
  const Tiling tiling = tiling_of(groups, region, copy_place);
  std::vector<PointSet> out;
  for (const auto& cell : tiling.cells) {
    const Point translation = tiling.translation(cell);
    std::vector<bool> is_admitted(example.size(), false);
    for (const PlaceGroup& group : groups) {
      const bool is_free = clearance.admits(group.place + translation, group.mean_distance_m);
      for (const std::uint32_t i : group.points) is_admitted[i] = is_free;
    }
    PointSet copy;
    for (std::size_t i = 0; i < example.size(); ++i) {
      if (!is_admitted[i]) continue;
      copy.push_back(example[i]);
      copy.back().place = example[i].place + translation;
    }
    if (!copy.empty()) out.push_back(std::move(copy));
  }
  return out;
}

/// The region grown by `reach_m`; holes shrink. The region itself where nothing is left to grow.
Polygon widened(const Polygon& region, double reach_m) {
  if (reach_m <= 0.0) return region;
  const blocks::detail::Geos geos;
  const auto shape = geos.from(region);
  const auto wide = geos.buffer(shape.get(), reach_m);
  std::vector<Polygon> polygons = geos.polygons_of(wide.get());
  expects(polygons.size() == 1, "a polygon grows to one polygon");
  return snap_polygon(polygons.front());
}

std::vector<OpenEnd> ends_within(std::vector<OpenEnd> ends, const StreetNetwork& network,
                                 const Polygon& boundary) {
  std::erase_if(ends, [&](const OpenEnd& end) {
    return locate(boundary, network.nodes[end.node]) == Side::kOutside;
  });
  return ends;
}

/// Variance of a uniform distribution, in squares of its width: what is left open where two fabrics
/// meet that know nothing of each other, by how much of a block the next crossing is nearer or
/// farther, and to which side of straight on it lies.
constexpr double kUniformVariance = 1.0 / 12.0;

void loosen(PassingStreet& street, double mean_distance_m) {
  street.distance_variance_m2 =
      std::max(street.distance_variance_m2, kUniformVariance * mean_distance_m * mean_distance_m);
  street.angle_variance_rad2 = std::max(street.angle_variance_rad2, kUniformVariance);
}

/// Lets the outermost new points and the open ends find each other: their streets' distances and
/// turns may vary as where unrelated fabrics meet, and an end takes, of the levels of the new point
/// next to it, the one nearest to its own.
void loosen_seam(streets::GrowthSite& site, const Clearance& clearance, double clearance_share_01) {
  std::vector<const IntersectionPoint*> outermost;
  for (IntersectionPoint& point : site.points) {
    const double mean_m = mean_distance_m(point);
    if (clearance.is_clear(point.place, (clearance_share_01 + 1.0) * mean_m)) continue;
    loosen(point.a, mean_m);
    if (point.b) loosen(*point.b, mean_m);
    outermost.push_back(&point);
  }
  for (OpenEnd& end : site.open_ends) {
    const Point place = site.existing.nodes[end.node];
    const auto nearest = std::ranges::min_element(outermost, {}, [&](const IntersectionPoint* p) {
      return squared_length(p->place - place);
    });
    if (nearest == outermost.end()) continue;
    const double mean_m = mean_distance_m(**nearest);
    end.street.distance_mean_m = (clearance_share_01 + 0.5) * mean_m;
    loosen(end.street, mean_m);
    const std::vector<PassingStreet> known = streets::streets_of(**nearest);
    end.street.hierarchy = std::ranges::min_element(known, {}, [&](const PassingStreet& street) {
                             return std::abs(street.hierarchy - end.street.hierarchy);
                           })->hierarchy;
  }
}

}  // namespace

Expected<Expansion> expand(const StreetNetwork& existing, std::span<const Polygon> parcels,
                           const Polygon& region, std::span<const IntersectionPoint> example,
                           const ExpansionOptions& options,
                           const streets::ExemplarOptions& exemplar) {
  const Expected<Polygon> admitted = admit_polygon(region, kMaxRegionVertices);
  if (!admitted) return tl::unexpected<Failure>(admitted.error());
  NetworkCut cut = cut_out(existing, *admitted);
  Expansion out;
  out.cut_streets = cut.cut_streets;
  out.of_existing = streets::exemplar_of(cut.network, parcels, exemplar);
  out.site.boundary = widened(cut.region, options.reach_m);
  out.site.open_ends = ends_within(streets::open_ends_of(cut.network, out.of_existing), cut.network,
                                   *out.site.boundary);
  const Clearance clearance(cut.network, cut.region, options.clearance_share_01);
  const std::vector<PointSet> copies =
      copies_of(example, cut.region, clearance, options.copy_place);
  out.copies = copies.size();
  out.site.points = join(copies, options.spacing);
  out.site.existing = std::move(cut.network);
  loosen_seam(out.site, clearance, options.clearance_share_01);
  return out;
}

}  // namespace plat::synthesis
