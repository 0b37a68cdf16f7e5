#include "streets/growth_region.h"

#include <algorithm>
#include <cmath>

#include "core/exact_orientation.h"

namespace plat::streets {

GrowthRegion::GrowthRegion(const Polygon& polygon) : box_(box_of(polygon)) {
  for_each_edge(polygon, [&](const Segment& edge) { edges_.push_back(edge); });
  // As many rows as edges: a ring of edges of similar length has a few in each.
  rows_.resize(std::max<std::size_t>(edges_.size(), 1));
  if (!edges_.empty() && box_.height() > 0.0) {
    row_m_ = box_.height() / static_cast<double>(rows_.size());
  }
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    const auto [low, high] = std::minmax(edges_[i].a.y, edges_[i].b.y);
    for (std::size_t row = row_of(low); row <= row_of(high); ++row) rows_[row].push_back(i);
  }
}

std::size_t GrowthRegion::row_of(double y) const {
  const double row = std::floor((y - box_.min.y) / row_m_);
  return static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(rows_.size() - 1)));
}

Side GrowthRegion::locate(Point p) const {
  if (!box_.contains(p)) return Side::kOutside;
  bool is_inside = false;
  for (const std::uint32_t i : rows_[row_of(p.y)]) {
    const Segment& edge = edges_[i];
    if (lies_on(edge, p)) return Side::kBoundary;
    if ((edge.a.y > p.y) == (edge.b.y > p.y)) continue;
    const bool is_left = orientation_sign(edge.a, edge.b, p) > 0;
    if (is_left == (edge.b.y > edge.a.y)) is_inside = !is_inside;
  }
  return is_inside ? Side::kInside : Side::kOutside;
}

bool GrowthRegion::keeps_off(const Segment& segment, Side barred) const {
  // Cut at the region's vertices, the segment is on one side of the boundary, or on it, between
  // cut and cut: the middle says on which.
  std::vector<Point> cuts{segment.a, segment.b};
  const auto [low, high] = std::minmax(segment.a.y, segment.b.y);
  for (std::size_t row = row_of(low); row <= row_of(high); ++row) {
    for (const std::uint32_t i : rows_[row]) {
      if (cross_properly(edges_[i], segment)) return false;
      if (lies_on(segment, edges_[i].a)) cuts.push_back(edges_[i].a);
      if (lies_on(segment, edges_[i].b)) cuts.push_back(edges_[i].b);
    }
  }
  std::sort(cuts.begin(), cuts.end());  // lexicographic is along the segment
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (locate(midpoint(cuts[i], cuts[i + 1])) == barred) return false;
  }
  return locate(segment.a) != barred && locate(segment.b) != barred;
}

}  // namespace plat::streets
