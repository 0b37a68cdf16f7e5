#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "blocks/block.h"
#include "core/oriented_box.h"
#include "parcels/parcel.h"

namespace plat::testing {

/// A rectangle from the origin, as a block whose four sides face streets 0 .. 3 (bottom, right,
/// top, left).
inline blocks::Block rectangle_block(double length_m, double depth_m) {
  return blocks::block_from_contour(
      BlockId{}, Polygon{{{0, 0}, {length_m, 0}, {length_m, depth_m}, {0, depth_m}}, {}});
}

/// The block with only the outer edges in `edges` facing a street.
inline blocks::Block with_streets_on(blocks::Block block, const std::vector<std::uint32_t>& edges) {
  for (std::uint32_t i = 0; i < block.edges[0].size(); ++i) {
    if (std::find(edges.begin(), edges.end(), i) == edges.end()) block.edges[0][i] = {};
  }
  return block;
}

/// How much of the polygon's outline runs along street edges of the block, metres: by distance, so
/// without any code of the subdividers.
inline double frontage_by_distance_m(const blocks::Block& block, const Polygon& shape) {
  constexpr double kNear_m = 0.005;
  double sum = 0.0;
  for_each_edge(shape, [&](const Segment& s) {
    for (std::size_t r = 0; r < block.edges.size(); ++r) {
      const Ring& ring = blocks::ring_at(block, r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Segment edge{ring[i], ring[(i + 1) % ring.size()]};
        if (!block.edges[r][i].is_street()) continue;
        if (distance(edge, s.a) < kNear_m && distance(edge, s.b) < kNear_m) {
          sum += length(s);
          return;
        }
      }
    }
  });
  return sum;
}

/// Areas, largest first.
inline std::vector<double> sorted_areas(const std::vector<parcels::Parcel>& parcels) {
  std::vector<double> out;
  for (const parcels::Parcel& p : parcels) out.push_back(area_m2(p.shape));
  std::sort(out.rbegin(), out.rend());
  return out;
}

/// How a polygon is changed into its twin: moves keep the working grid.
enum class Twin { kTranslated, kTurnedBy90, kMirrored, kRotatedStart };

inline Point twin_of(Point p, Twin twin) {
  switch (twin) {
    case Twin::kTranslated:
      return p + Point{1234.5, -321.25};
    case Twin::kTurnedBy90:
      return perpendicular(p);
    case Twin::kMirrored:
      return {-p.x, p.y};
    case Twin::kRotatedStart:
      return p;
  }
  return p;
}

inline Polygon twin_of(const Polygon& polygon, Twin twin) {
  Polygon out;
  const auto change = [&](const Ring& ring) {
    Ring changed;
    for (const Point p : ring) changed.push_back(twin_of(p, twin));
    if (twin == Twin::kMirrored) std::reverse(changed.begin(), changed.end());
    if (twin == Twin::kRotatedStart)
      std::rotate(changed.begin(), changed.begin() + 1, changed.end());
    return changed;
  };
  out.outer = change(polygon.outer);
  for (const Ring& hole : polygon.holes) out.holes.push_back(change(hole));
  return out;
}

}  // namespace plat::testing
