#pragma once

#include <cstdint>
#include <vector>

#include "core/oriented_box.h"
#include "core/rng.h"
#include "imagery/map_layers.h"

namespace plat::imagery {

/// A parcel as a gardener sees it: which way the street is, and what stands on it.
struct Plot {
  Polygon shape;
  OrientedBox box;
  Point front{0.0, -1.0};  ///< the unit vector along an axis of the box that points to the street
  bool has_front = false;  ///< whether a street is near; else `front` is a guess
  std::vector<Footprint> buildings;

  /// How far the plot reaches towards the street and to the left of it, from the frame's origin.
  struct Extent {
    double back, front, right, left;
  };
  [[nodiscard]] Extent extent() const;
  [[nodiscard]] bool is_built(Point p, double margin_m) const;
  [[nodiscard]] double built_m2() const;
};

/// One plot per parcel that has an area, in their order, with the buildings whose middle lies on
/// it.
std::vector<Plot> make_plots(const MapLayers& layers);

/// Stands a house on every plot without one that has room: a box behind a front garden, several
/// large ones where the plot is large. They are assumed: no map has them.
void assume_houses(std::vector<Plot>& plots, std::uint64_t seed);

/// The part of a ring where dot(p, normal) <= limit. Of a ring that is not convex pieces may hang
/// together by lines without area.
Ring clipped(const Ring& ring, Point normal, double limit);

}  // namespace plat::imagery
