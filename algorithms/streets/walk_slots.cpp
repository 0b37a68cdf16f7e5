#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "streets/street_width.h"
#include "streets/walk_slots_internal.h"

namespace plat::streets::detail {
namespace {

std::uint32_t capacity_of(const PassingStreet& street, RandomWalkGrower::Connections rule) {
  switch (rule) {
    case RandomWalkGrower::Connections::kFour:
      return 2;
    case RandomWalkGrower::Connections::kObserved:
      return static_cast<std::uint32_t>(std::clamp(street.connections, 0, 2));
    case RandomWalkGrower::Connections::kUnlimited:
      return std::numeric_limits<std::uint32_t>::max();
  }
  return 0;
}

}  // namespace

WalkSlots::WalkSlots(const GrowthSite& site, const GrowthPlane& plane,
                     const RandomWalkGrower::Options& options) {
  for (const OpenEnd& end : site.open_ends) {
    slots_.push_back({.vertex = end.node,
                      .place = plane.vertices()[end.node],
                      .style = end.street,
                      .capacity = 1,
                      .heading = end.heading});
  }
  open_ends_ = static_cast<std::uint32_t>(slots_.size());
  for (std::uint32_t i = 0; i < site.points.size(); ++i) {
    const std::uint32_t vertex = plane.vertex_of_point(i);
    for (const PassingStreet& street : streets_of(site.points[i])) {
      slots_.push_back({.vertex = vertex,
                        .place = plane.vertices()[vertex],
                        .style = street,
                        .capacity = capacity_of(street, options.connections),
                        .heading = std::nullopt});
    }
  }
  parents_.resize(slots_.size());
  std::iota(parents_.begin(), parents_.end(), 0U);
}

void WalkSlots::connect(std::uint32_t from, std::optional<std::uint32_t> to, Point way) {
  ++slots_[from].connections;
  slots_[from].heading = -way;
  if (!to) return;
  ++slots_[*to].connections;
  slots_[*to].heading = way;
  parents_[street_of(*to)] = street_of(from);
}

std::uint32_t WalkSlots::street_of(std::uint32_t slot) {
  while (parents_[slot] != slot) {
    parents_[slot] = parents_[parents_[slot]];
    slot = parents_[slot];
  }
  return slot;
}

double clearance_m(const WalkSlot& from, const WalkSlot& to,
                   const RandomWalkGrower::Options& options) {
  const auto width_m = [](const WalkSlot& slot) {
    const double width = slot.style.width_m;
    return width > 0.0 && std::isfinite(width) ? width : WidthOptions{}.default_width_m;
  };
  return options.clearance_widths * 0.5 * (width_m(from) + width_m(to));
}

}  // namespace plat::streets::detail
