#include "streets/growth_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/working_grid.h"

namespace plat::streets {
namespace {

bool is_usable_place(Point p) {
  return std::abs(p.x) <= kGridExtent_m && std::abs(p.y) <= kGridExtent_m;
}

std::string coordinates(Point p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
}

std::optional<Failure> find_defect(const std::string& owner, const PassingStreet& street) {
  const std::array<std::pair<const char*, double>, 5> numbers{
      {{"tortuosity", street.tortuosity},
       {"distance_mean_m", street.distance_mean_m},
       {"distance_variance_m2", street.distance_variance_m2},
       {"angle_mean_rad", street.angle_mean_rad},
       {"angle_variance_rad2", street.angle_variance_rad2}}};
  for (const auto& [name, value] : numbers) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      return Failure{FailureCode::kOutOfRange,
                     owner + ": " + name + " = " + std::to_string(value) + ", allowed 0 or more"};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Failure> find_defect(const GrowthSite& site) {
  const auto not_finite = [](const std::string& what, Point p) {
    return Failure{FailureCode::kNotFinite,
                   what + " " + coordinates(p) + ": not finite, or beyond " +
                       std::to_string(kGridExtent_m) + " m of the frame's origin"};
  };
  for (std::size_t i = 0; i < site.points.size(); ++i) {
    if (!is_usable_place(site.points[i].place))
      return not_finite("point " + std::to_string(i), site.points[i].place);
    for (const PassingStreet& street : streets_of(site.points[i])) {
      if (auto defect = find_defect("point " + std::to_string(i), street)) return defect;
    }
  }
  for (const Point p : site.existing.nodes) {
    if (!is_usable_place(p)) return not_finite("existing node", p);
  }
  const std::size_t nodes = site.existing.nodes.size();
  const auto no_node = [&](const std::string& what, std::uint32_t node) {
    return Failure{FailureCode::kUnknownEntity, what + " is at node " + std::to_string(node) +
                                                    ", the existing network has " +
                                                    std::to_string(nodes)};
  };
  for (std::size_t i = 0; i < site.existing.streets.size(); ++i) {
    const Street& street = site.existing.streets[i];
    const std::string name = "existing street " + std::to_string(i);
    if (std::max(street.from, street.to) >= nodes)
      return no_node(name, std::max(street.from, street.to));
    for (const Point p : street.line) {
      if (!is_usable_place(p)) return not_finite(name, p);
    }
    if (street.line.size() < 2 || street.line.front() != site.existing.nodes[street.from] ||
        street.line.back() != site.existing.nodes[street.to]) {
      return Failure{FailureCode::kEmptyGeometry, name + ": its line does not join its nodes"};
    }
  }
  for (std::size_t i = 0; i < site.open_ends.size(); ++i) {
    const OpenEnd& end = site.open_ends[i];
    const std::string name = "open end " + std::to_string(i);
    if (end.node >= nodes) return no_node(name, end.node);
    if (!is_usable_place(end.heading)) return not_finite(name + " heads for", end.heading);
    if (auto defect = find_defect(name, end.street)) return defect;
  }
  for (const Polygon& obstacle : site.obstacles) {
    std::optional<Failure> defect;
    for_each_edge(obstacle, [&](const Segment& edge) {
      if (!defect && !is_usable_place(edge.a)) defect = not_finite("obstacle", edge.a);
    });
    if (defect) return defect;
  }
  return std::nullopt;
}

}  // namespace plat::streets
