#include "synthesis/point_join.h"

#include <cstdint>
#include <vector>

#include "synthesis/place_groups_internal.h"

namespace plat::synthesis {

PointSet join(std::span<const PointSet> sets, const Spacing& spacing) {
  std::vector<std::vector<PlaceGroup>> groups;
  std::vector<PlaceGroup> all;
  for (const PointSet& set : sets) {
    groups.push_back(groups_of(set));
    all.insert(all.end(), groups.back().begin(), groups.back().end());
  }
  PlaceIndex kept(cell_for_m(all, spacing));
  std::vector<double> kept_mean_distance_m;
  PointSet out;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    std::vector<bool> stays(sets[s].size(), false);
    std::vector<const PlaceGroup*> new_ones;
    for (const PlaceGroup& group : groups[s]) {
      const double own_m = group.mean_distance_m;
      bool is_free = true;
      kept.for_each_nearer(group.place, spacing.between_m(own_m, own_m),
                           [&](std::uint32_t other, double apart_m) {
                             if (apart_m < spacing.between_m(own_m, kept_mean_distance_m[other]))
                               is_free = false;
                           });
      if (!is_free) continue;
      for (const std::uint32_t i : group.points) stays[i] = true;
      new_ones.push_back(&group);
    }
    for (const PlaceGroup* group : new_ones) {
      kept.add(group->place, static_cast<std::uint32_t>(kept_mean_distance_m.size()));
      kept_mean_distance_m.push_back(group->mean_distance_m);
    }
    for (std::size_t i = 0; i < sets[s].size(); ++i) {
      if (stays[i]) out.push_back(sets[s][i]);
    }
  }
  return out;
}

}  // namespace plat::synthesis
