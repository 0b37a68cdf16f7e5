#include "core/working_grid.h"

#include <algorithm>

namespace plat {

Ring drop_collinear(std::span<const Point> ring) {
  Ring out(ring.begin(), ring.end());
  // Dropping a vertex can make its neighbours collinear or equal, so repeat until nothing changes.
  for (bool changed = true; changed && out.size() >= 3;) {
    changed = false;
    Ring next;
    next.reserve(out.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Point before = next.empty() ? out.back() : next.back();
      const Point after = out[i + 1 == out.size() ? 0 : i + 1];
      if (orientation(before, out[i], after) == 0.0) {
        changed = true;
      } else {
        next.push_back(out[i]);
      }
    }
    out = std::move(next);
  }
  if (out.size() < 3) out.clear();
  return out;
}

Ring snap_ring(std::span<const Point> ring) {
  Ring snapped;
  snapped.reserve(ring.size());
  for (const Point p : ring) {
    const Point s = snap(p);
    if (snapped.empty() || snapped.back() != s) snapped.push_back(s);
  }
  while (snapped.size() > 1 && snapped.back() == snapped.front()) snapped.pop_back();
  return drop_collinear(snapped);
}

Polygon snap_polygon(const Polygon& polygon) {
  Polygon out;
  out.outer = snap_ring(polygon.outer);
  if (signed_area_m2(out.outer) < 0.0) std::reverse(out.outer.begin(), out.outer.end());
  for (const Ring& hole : polygon.holes) {
    Ring ring = snap_ring(hole);
    if (ring.empty()) continue;
    if (signed_area_m2(ring) > 0.0) std::reverse(ring.begin(), ring.end());
    out.holes.push_back(std::move(ring));
  }
  return out;
}

}  // namespace plat
