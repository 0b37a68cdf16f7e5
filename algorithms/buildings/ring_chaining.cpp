#include <algorithm>
#include <cmath>
#include <map>

#include "buildings/ring_chaining_internal.h"

namespace plat::buildings::detail {
namespace {

/// Of the edges that leave a point, the one that bounds the same corner of the inside as the edge
/// that comes in: the leftmost turn, so that regions which touch in a point stay apart.
std::size_t leftmost(Point from, Point at, const std::vector<Point>& candidates) {
  const Point in = at - from;
  const auto turn = [&](Point to) {
    const Point out = to - at;
    return std::atan2(cross(in, out), dot(in, out));
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    if (turn(candidates[i]) > turn(candidates[best])) best = i;
  }
  return best;
}

}  // namespace

std::optional<std::vector<Ring>> chain_rings(const std::vector<DirectedEdge>& edges) {
  std::map<Point, std::vector<Point>> next;
  for (const auto& [from, to] : edges) next[from].push_back(to);
  std::vector<Ring> rings;
  for (auto& [start, candidates] : next) {
    while (!candidates.empty()) {
      Ring ring{start};
      Point from = start;
      Point at = candidates.back();
      candidates.pop_back();
      while (at != start) {
        ring.push_back(at);
        const auto found = next.find(at);
        if (found == next.end() || found->second.empty()) return std::nullopt;
        const std::size_t pick = leftmost(from, at, found->second);
        from = at;
        at = found->second[pick];
        found->second.erase(found->second.begin() + static_cast<std::ptrdiff_t>(pick));
      }
      rings.push_back(std::move(ring));
    }
  }
  return rings;
}

std::vector<Polygon> regions_of(std::vector<Ring> rings) {
  std::vector<Polygon> regions;
  std::vector<Ring> holes;
  for (Ring& ring : rings) {
    if (ring.size() < 3) continue;
    if (signed_area_m2(ring) > 0.0) {
      regions.push_back({std::move(ring), {}});
    } else {
      holes.push_back(std::move(ring));
    }
  }
  for (Ring& hole : holes) {
    const Point inside = interior_point(Polygon{Ring(hole.rbegin(), hole.rend()), {}});
    Polygon* around = nullptr;
    for (Polygon& region : regions) {
      if (locate(region.outer, inside) == Side::kInside &&
          (around == nullptr || signed_area_m2(region.outer) < signed_area_m2(around->outer)))
        around = &region;
    }
    if (around != nullptr) around->holes.push_back(std::move(hole));
  }
  return regions;
}

}  // namespace plat::buildings::detail
