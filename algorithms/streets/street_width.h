#pragma once

#include <span>

#include "core/parallel.h"
#include "streets/segment_index.h"
#include "streets/street_network.h"

namespace plat::streets {

struct WidthOptions {
  double lane_width_m = 3.25;     ///< of one lane
  double pavement_m = 2.5;        ///< on each side of the lanes, up to the plots
  double min_width_m = 2.0;       ///< a narrower gap is a joint between plots, not a street
  double max_width_m = 60.0;      ///< a wider gap is open land, not a street
  double sample_step_m = 8.0;     ///< between the places where a gap is measured
  double default_width_m = 12.0;  ///< where nothing else is known
};

/// Gives every street its width and says where it comes from: the source's width field; else its
/// lanes times a lane width, and pavements; else the gap between the `land` polygons on both sides,
/// the median over samples along the street; else the table by class (street_classes.h); else a
/// default. `land`: parcels or blocks, may be empty; rings oriented as in Polygon.
void assign_widths(StreetNetwork& network, std::span<const Polygon> land,
                   const WidthOptions& options = {}, Jobs jobs = {});

/// The boundaries of polygons, interior on the left of every segment: what gaps are measured
/// against.
SegmentIndex boundary_index(std::span<const Polygon> land);

/// The free distance from `origin` along the unit vector `direction` to the first boundary that is
/// entered there; nullopt where none is within `max_m`, or where `origin` lies on land (the first
/// boundary is then left, not entered).
std::optional<double> free_distance_m(const SegmentIndex& boundaries, Point origin, Point direction,
                                      double max_m);

}  // namespace plat::streets
