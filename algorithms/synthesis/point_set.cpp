#include "synthesis/point_set.h"

#include <algorithm>

namespace plat::synthesis {

double mean_distance_m(const streets::IntersectionPoint& point) {
  if (!point.b) return point.a.distance_mean_m;
  return 0.5 * (point.a.distance_mean_m + point.b->distance_mean_m);
}

double Spacing::between_m(double mean_distance_a_m, double mean_distance_b_m) const {
  return std::max(min_m, share_01 * std::min(mean_distance_a_m, mean_distance_b_m));
}

}  // namespace plat::synthesis
