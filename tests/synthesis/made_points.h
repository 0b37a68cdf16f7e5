#pragma once

#include <cmath>

#include "core/rng.h"
#include "core/working_grid.h"
#include "synthesis/point_set.h"

namespace plat::synthesis::testing {

/// What a made point knows of its streets; `b` is one level below `a`.
struct MadeStyle {
  double distance_m = 100.0;
  double tortuosity = 1.0;
  double angle_rad = 0.0;
  double width_m = 10.0;
  double parcel_area_m2 = 400.0;
  int hierarchy = 0;
};

inline streets::IntersectionPoint made_point(Point place, const MadeStyle& style = {}) {
  const auto street = [&](int hierarchy) {
    return streets::PassingStreet{.hierarchy = hierarchy,
                                  .tortuosity = style.tortuosity,
                                  .distance_mean_m = style.distance_m,
                                  .distance_variance_m2 = 0.01 * style.distance_m,
                                  .angle_mean_rad = style.angle_rad,
                                  .angle_variance_rad2 = 0.1 * style.angle_rad,
                                  .width_m = style.width_m,
                                  .connections = 2};
  };
  streets::IntersectionPoint out;
  out.place = snap(place);
  out.a = street(style.hierarchy);
  out.b = street(style.hierarchy + 1);
  out.parcel_area_m2 = style.parcel_area_m2;
  return out;
}

/// Crossings of a grid of `columns` by `rows` streets.
inline PointSet grid_points(int columns, int rows, double spacing_m, Point origin = {},
                            const MadeStyle& style = {}) {
  PointSet out;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      out.push_back(made_point(origin + Point{x * spacing_m, y * spacing_m}, style));
    }
  }
  return out;
}

/// Places drawn uniformly in a rectangle.
inline PointSet scattered_points(Rng& rng, int count, Point low, Point high,
                                 const MadeStyle& style = {}) {
  PointSet out;
  for (int i = 0; i < count; ++i) {
    const double x = rng.uniform(low.x, high.x);
    out.push_back(made_point({x, rng.uniform(low.y, high.y)}, style));
  }
  return out;
}

}  // namespace plat::synthesis::testing
