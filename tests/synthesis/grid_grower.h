#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "streets/street_grower.h"

namespace plat::testing {

/// Grows a street from each point to the next one east and to the next one north on exactly the
/// same line, existing nodes included. Enough for layouts of grids; keeps to no boundary.
class GridGrower {
 public:
  static constexpr std::string_view kName = "grid";
  static constexpr std::string_view kSummary = "next points along the axes";
  struct Options {
    double max_m = 1000.0;
    static constexpr auto fields() {
      return std::tuple{Field{"max_m", &Options::max_m, 1.0, 1e6, "length of a street"}};
    }
  };
  explicit GridGrower(const Options& options) : options_(options) {}
  [[nodiscard]] const Options& options() const { return options_; }

  [[nodiscard]] Expected<streets::Growth> grow(const streets::GrowthSite& site, Rng&) const {
    if (site.boundary && site.boundary->outer.size() < 3)
      return fail(FailureCode::kEmptyGeometry, "the boundary is no polygon");
    streets::Growth out;
    std::vector<Point>& nodes = out.network.nodes;
    nodes = site.existing.nodes;
    std::map<Point, const streets::IntersectionPoint*> style;
    for (const auto& point : site.points) {
      nodes.push_back(point.place);
      style.emplace(point.place, &point);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (streets::Street street : site.existing.streets) {
      street.from = node_at(nodes, street.line.front());
      street.to = node_at(nodes, street.line.back());
      out.network.streets.push_back(std::move(street));
    }
    std::vector<bool> is_reached(nodes.size(), false);
    const auto add = [&](std::uint32_t from, std::uint32_t to, bool is_row) {
      const auto it = style.find(nodes[from]);
      if (it == style.end() && !style.contains(nodes[to])) return;
      const auto& a = (it == style.end() ? style.at(nodes[to]) : it->second)->a;
      streets::Street street;
      street.id = {static_cast<std::uint32_t>(out.network.streets.size())};
      street.from = from;
      street.to = to;
      street.line = {nodes[from], nodes[to]};
      street.width_m = a.width_m;
      street.width_source = streets::WidthSource::kAttribute;
      out.network.streets.push_back(std::move(street));
      out.segments.push_back({a.hierarchy, is_row ? 0U : 1U});
      is_reached[from] = is_reached[to] = true;
    };
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      for (const bool is_row : {true, false}) {
        if (const auto to = next(nodes, n, is_row)) add(n, *to, is_row);
      }
    }
    for (std::uint32_t i = 0; i < site.points.size(); ++i) {
      if (!is_reached[node_at(nodes, site.points[i].place)]) out.left_alone.push_back(i);
    }
    return out;
  }

 private:
  static std::uint32_t node_at(const std::vector<Point>& nodes, Point place) {
    return static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), place) -
                                      nodes.begin());
  }
  [[nodiscard]] std::optional<std::uint32_t> next(const std::vector<Point>& nodes, std::uint32_t n,
                                                  bool is_row) const {
    std::optional<std::uint32_t> best;
    double least = options_.max_m;
    for (std::uint32_t m = 0; m < nodes.size(); ++m) {
      const Point d = nodes[m] - nodes[n];
      const double along = is_row ? d.x : d.y;
      if ((is_row ? d.y : d.x) != 0.0 || along <= 0.0 || along > least) continue;
      least = along;
      best = m;
    }
    return best;
  }

  Options options_;
};
static_assert(streets::StreetGrower<GridGrower> && Registrable<GridGrower>);

/// columns x rows points from `origin`, all of one style.
inline std::vector<streets::IntersectionPoint> grid_points(int columns, int rows, Point step_m,
                                                           std::optional<double> parcel_area_m2,
                                                           Point origin = {}) {
  std::vector<streets::IntersectionPoint> out;
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) {
      streets::IntersectionPoint point;
      point.place = origin + Point{step_m.x * c, step_m.y * r};
      point.a.hierarchy = 0;
      point.a.width_m = 10.0;
      point.a.distance_mean_m = step_m.x;
      point.b = point.a;
      point.b->hierarchy = 1;
      point.b->distance_mean_m = step_m.y;
      point.parcel_area_m2 = parcel_area_m2;
      out.push_back(point);
    }
  }
  return out;
}

}  // namespace plat::testing
