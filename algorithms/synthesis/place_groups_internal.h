#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/point.h"
#include "streets/intersection_point.h"
#include "synthesis/point_set.h"

namespace plat::synthesis {

/// Points at one place: they come and go together.
struct PlaceGroup {
  Point place;
  std::vector<std::uint32_t> points;  ///< indices, ascending
  double mean_distance_m = 0.0;       ///< over the points
};

/// The distinct places of a set, in the order of their first point.
inline std::vector<PlaceGroup> groups_of(std::span<const streets::IntersectionPoint> points) {
  std::map<Point, std::size_t, bool (*)(Point, Point)> number(
      [](Point a, Point b) { return a < b; });
  std::vector<PlaceGroup> out;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto [at, is_new] = number.emplace(points[i].place, out.size());
    if (is_new) out.push_back({points[i].place, {}, 0.0});
    PlaceGroup& group = out[at->second];
    group.points.push_back(i);
    group.mean_distance_m += mean_distance_m(points[i]);
  }
  for (PlaceGroup& group : out) group.mean_distance_m /= static_cast<double>(group.points.size());
  return out;
}

/// Numbered places in square cells, to find those near a place. Visits them in an order that
/// depends on the places and on the order of adding alone.
class PlaceIndex {
 public:
  /// @param cell_m  about the distance that is asked for, > 0
  explicit PlaceIndex(double cell_m) : cell_m_(cell_m) {}

  void add(Point place, std::uint32_t number) { cells_[cell_of(place)].push_back({place, number}); }

  /// Calls `visit(number, distance_m)` for every place nearer than `radius_m`.
  template <class Visit>
  void for_each_nearer(Point place, double radius_m, Visit visit) const {
    const auto look = [&](const Entries& entries) {
      for (const auto& [other, number] : entries) {
        const double apart_m = distance(place, other);
        if (apart_m < radius_m) visit(number, apart_m);
      }
    };
    const Cell low = cell_of(place - Point{radius_m, radius_m});
    const Cell high = cell_of(place + Point{radius_m, radius_m});
    const double columns = static_cast<double>(high.first - low.first) + 1.0;
    const double rows = static_cast<double>(high.second - low.second) + 1.0;
    if (columns * rows > static_cast<double>(cells_.size())) {
      for (const auto& [cell, entries] : cells_) look(entries);
      return;
    }
    for (std::int64_t x = low.first; x <= high.first; ++x) {
      for (std::int64_t y = low.second; y <= high.second; ++y) {
        const auto found = cells_.find({x, y});
        if (found != cells_.end()) look(found->second);
      }
    }
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  using Entries = std::vector<std::pair<Point, std::uint32_t>>;

  [[nodiscard]] Cell cell_of(Point place) const {
    return {static_cast<std::int64_t>(std::floor(place.x / cell_m_)),
            static_cast<std::int64_t>(std::floor(place.y / cell_m_))};
  }

  double cell_m_;
  std::map<Cell, Entries> cells_;
};

/// A cell for an index of places that keep this spacing: its largest distance for the median group.
inline double cell_for_m(std::span<const PlaceGroup> groups, const Spacing& spacing) {
  constexpr double kLeastCell_m = 10.0;
  std::vector<double> distances_m;
  for (const PlaceGroup& group : groups) distances_m.push_back(group.mean_distance_m);
  if (distances_m.empty()) return kLeastCell_m;
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::ranges::nth_element(distances_m, middle);
  return std::max(kLeastCell_m, spacing.between_m(*middle, *middle));
}

}  // namespace plat::synthesis
