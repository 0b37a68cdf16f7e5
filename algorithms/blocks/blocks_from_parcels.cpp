#include "blocks/blocks_from_parcels.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "blocks/admission_internal.h"
#include "blocks/geos_internal.h"
#include "core/validity.h"
#include "core/working_grid.h"

namespace plat::blocks {
namespace {

std::vector<Segment> edges_of(const Polygon& polygon) {
  std::vector<Segment> edges;
  for_each_edge(polygon, [&](const Segment& s) { edges.push_back(s); });
  return edges;
}

bool are_within(const Segment& s, const Segment& t, double reach_m) {
  if (std::max(s.a.x, s.b.x) + reach_m < std::min(t.a.x, t.b.x) ||
      std::max(t.a.x, t.b.x) + reach_m < std::min(s.a.x, s.b.x) ||
      std::max(s.a.y, s.b.y) + reach_m < std::min(t.a.y, t.b.y) ||
      std::max(t.a.y, t.b.y) + reach_m < std::min(s.a.y, s.b.y)) {
    return false;
  }
  if (distance(s, t.a) <= reach_m || distance(s, t.b) <= reach_m || distance(t, s.a) <= reach_m ||
      distance(t, s.b) <= reach_m) {
    return true;
  }
  return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0.0 &&
         orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0.0;
}

bool are_within(const Polygon& p, const Polygon& q, double reach_m) {
  const std::vector<Segment> q_edges = edges_of(q);
  const Box near_q = box_of(q).expanded(reach_m);
  for (const Segment& s : edges_of(p)) {
    Box box;
    box.add(s.a);
    box.add(s.b);
    if (!box.intersects(near_q)) continue;
    for (const Segment& t : q_edges) {
      if (are_within(s, t, reach_m)) return true;
    }
  }
  return locate(p, q.outer.front()) == Side::kInside || locate(q, p.outer.front()) == Side::kInside;
}

/// Parcels that are connected over gaps up to `reach_m`, each group sorted, groups by first parcel.
std::vector<std::vector<std::uint32_t>> connected_groups(const std::vector<Polygon>& parcels,
                                                         double reach_m, Jobs jobs) {
  std::vector<Box> boxes;
  std::vector<std::uint32_t> by_left;
  for (std::uint32_t i = 0; i < parcels.size(); ++i) {
    boxes.push_back(box_of(parcels[i]));
    if (!parcels[i].outer.empty()) by_left.push_back(i);
  }
  std::sort(by_left.begin(), by_left.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(boxes[i].min.x, i) < std::pair(boxes[j].min.x, j);
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<std::uint32_t> active;
  for (const std::uint32_t i : by_left) {
    const Box grown = boxes[i].expanded(reach_m);
    std::erase_if(active, [&](std::uint32_t j) { return boxes[j].max.x < grown.min.x; });
    for (const std::uint32_t j : active) {
      if (grown.intersects(boxes[j])) pairs.emplace_back(j, i);
    }
    active.push_back(i);
  }
  const auto is_joined = parallel_map<char>(pairs.size(), jobs, [&](std::size_t k) {
    return static_cast<char>(
        are_within(parcels[pairs[k].first], parcels[pairs[k].second], reach_m));
  });
  std::vector<std::uint32_t> parent(parcels.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (is_joined[k] == 0) continue;
    const std::uint32_t a = root(pairs[k].first);
    const std::uint32_t b = root(pairs[k].second);
    parent[std::max(a, b)] = std::min(a, b);  // the root is the lowest of its group
  }
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::uint32_t> group_of(parcels.size(), 0);
  for (std::uint32_t i = 0; i < parcels.size(); ++i) {
    if (parcels[i].outer.empty()) continue;
    const std::uint32_t r = root(i);
    if (r == i) {
      group_of[i] = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back();
    }
    groups[group_of[r]].push_back(i);
  }
  return groups;
}

detail::Admitted close_group(const std::vector<Polygon>& parcels,
                             const std::vector<std::uint32_t>& group,
                             const ParcelUnionOptions& options) {
  const detail::Geos geos;
  std::vector<detail::GeosShape> grown;
  for (const std::uint32_t i : group)
    grown.push_back(geos.buffer(geos.from(parcels[i]).get(), options.closing_m));
  const auto united = geos.union_of(std::move(grown));
  const auto closed = geos.buffer(united.get(), -options.closing_m);
  const auto simple = geos.simplified(closed.get(), options.simplify_m);
  detail::Admitted out;
  for (const Polygon& region : geos.polygons_of(simple.get())) {
    detail::Admitted part =
        detail::admit_region(geos, region, options.min_area_m2, options.max_vertices);
    std::move(part.polygons.begin(), part.polygons.end(), std::back_inserter(out.polygons));
    std::move(part.refused.begin(), part.refused.end(), std::back_inserter(out.refused));
  }
  if (out.polygons.empty() && out.refused.empty()) {
    out.refused.push_back({{FailureCode::kEmptyGeometry, "the union of the parcels is empty"},
                           parcels[group.front()]});
  }
  return out;
}

}  // namespace

BlocksFromParcels blocks_from_parcels(std::span<const ObservedParcel> parcels,
                                      const ParcelUnionOptions& options, Jobs jobs) {
  BlocksFromParcels out;
  out.parcels.resize(parcels.size());
  out.block_of.resize(parcels.size());
  std::vector<std::optional<Failure>> refused(parcels.size());
  parallel_for(parcels.size(), jobs, [&](std::size_t i) {
    // A hole may touch the parcel's boundary in a point: that is how courtyards are surveyed.
    auto admitted = admit_polygon(parcels[i].shape, options.max_vertices);
    if (!admitted && admitted.error().code == FailureCode::kBadHole) {
      Polygon snapped = snap_polygon(parcels[i].shape);
      if (!find_ogc_defect(snapped)) admitted = std::move(snapped);
    }
    if (admitted) {
      out.parcels[i] = *std::move(admitted);
    } else {
      refused[i] = std::move(admitted.error());
    }
  });
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    if (refused[i])
      out.failures.push_back({parcels[i].id, *std::move(refused[i]), parcels[i].shape});
  }

  const auto groups = connected_groups(out.parcels, 2.0 * options.closing_m, jobs);
  auto closed = parallel_map<detail::Admitted>(groups.size(), jobs, [&](std::size_t g) {
    return close_group(out.parcels, groups[g], options);
  });
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::size_t first = out.blocks.size();
    for (Polygon& contour : closed[g].polygons) {
      Block block;
      block.id = {static_cast<std::uint32_t>(out.blocks.size())};
      block.source_id = parcels[groups[g].front()].id;
      block.contour = std::move(contour);
      block.edges.emplace_back(block.contour.outer.size());
      for (const Ring& hole : block.contour.holes) block.edges.emplace_back(hole.size());
      out.blocks.push_back(std::move(block));
    }
    for (auto& [failure, shape] : closed[g].refused) {
      failure.message = "block of this parcel: " + failure.message;
      out.failures.push_back({parcels[groups[g].front()].id, std::move(failure), std::move(shape)});
    }
    for (const std::uint32_t i : groups[g]) {
      // The only block of the group, or the one around the parcel, or the nearest.
      double nearest_m = 0.0;
      for (std::size_t b = first; b < out.blocks.size(); ++b) {
        const Point inside =
            out.blocks.size() - first == 1 ? Point{} : interior_point(out.parcels[i]);
        const bool is_only = out.blocks.size() - first == 1;
        const double d = is_only || locate(out.blocks[b].contour, inside) != Side::kOutside
                             ? 0.0
                             : boundary_distance_m(out.blocks[b].contour, inside);
        if (!out.block_of[i] || d < nearest_m) {
          out.block_of[i] = out.blocks[b].id;
          nearest_m = d;
        }
      }
    }
  }
  return out;
}

}  // namespace plat::blocks
