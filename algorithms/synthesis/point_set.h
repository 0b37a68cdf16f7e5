#pragma once

#include <tuple>
#include <vector>

#include "core/options.h"
#include "streets/intersection_point.h"

namespace plat::synthesis {

/// What the layout operations work on: the attributed intersection points of a fragment, in any
/// order, which every operation keeps. Points at one place are one crossing of several streets.
using PointSet = std::vector<streets::IntersectionPoint>;

/// Mean of the distances to the next intersection over the streets of a point, metres.
double mean_distance_m(const streets::IntersectionPoint& point);

/// How close points of two sources may be: closer, they give slivers between streets, and one of
/// them gives way. Points of one source are as they were observed, and never too close.
struct Spacing {
  double share_01 = 0.35;
  double min_m = 5.0;
  static constexpr auto fields() {
    return std::tuple{Field{"spacing_share_01", &Spacing::share_01, 0.0, 1.0,
                            "Points of two sources are no closer than this share of the smaller of "
                            "their mean distances to the next intersection."},
                      Field{"spacing_min_m", &Spacing::min_m, 0.0, 100.0,
                            "Points of two sources are no closer than this, in m."}};
  }

  /// The distance that points with these mean distances keep, metres.
  [[nodiscard]] double between_m(double mean_distance_a_m, double mean_distance_b_m) const;
};

}  // namespace plat::synthesis
