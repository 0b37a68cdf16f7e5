#include "streets/place_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plat::streets {
namespace {

constexpr std::uint32_t kLeafSize = 8;  ///< fewer are scanned faster than divided

/// Squared distance from `p` to the nearest point of the box; 0 inside.
double squared_distance(const Box& box, Point p) {
  const Point nearest{std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y)};
  return squared_length(p - nearest);
}

}  // namespace

PlaceTree::PlaceTree(std::span<const Point> places) : places_(places.begin(), places.end()) {
  order_.resize(places_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t PlaceTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Box box;
  for (std::uint32_t i = begin; i < end; ++i) box.add(places_[order_[i]]);
  nodes_.push_back({box, begin, end, 0, 0});
  if (end - begin <= kLeafSize) return number;
  const bool is_wide = box.width() >= box.height();
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double va = is_wide ? places_[a].x : places_[a].y;
                     const double vb = is_wide ? places_[b].x : places_[b].y;
                     return va != vb ? va < vb : a < b;
                   });
  const std::uint32_t first = build(begin, middle);
  const std::uint32_t second = build(middle, end);
  nodes_[number].first_child = first;
  nodes_[number].second_child = second;
  return number;
}

std::vector<std::uint32_t> PlaceTree::nearest(std::uint32_t of, std::size_t count) const {
  using Found = std::pair<double, std::uint32_t>;  // squared distance, number
  const Point center = places_[of];
  std::vector<Found> best;  // a heap, the worst on top
  std::vector<Found> open{{0.0, 0}};
  while (!open.empty() && count > 0) {
    const auto [room, number] = open.back();
    open.pop_back();
    const Node& node = nodes_[number];
    if (best.size() == count && room > best.front().first) continue;
    if (node.second_child != 0) {
      Found near{squared_distance(nodes_[node.first_child].box, center), node.first_child};
      Found far{squared_distance(nodes_[node.second_child].box, center), node.second_child};
      if (far < near) std::swap(near, far);
      open.push_back(far);
      open.push_back(near);
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (order_[i] == of) continue;
      const Found found{squared_length(places_[order_[i]] - center), order_[i]};
      if (best.size() == count && !(found < best.front())) continue;
      if (best.size() == count) {
        std::pop_heap(best.begin(), best.end());
        best.pop_back();
      }
      best.push_back(found);
      std::push_heap(best.begin(), best.end());
    }
  }
  std::sort_heap(best.begin(), best.end());
  std::vector<std::uint32_t> out;
  out.reserve(best.size());
  for (const Found& found : best) out.push_back(found.second);
  return out;
}

}  // namespace plat::streets
