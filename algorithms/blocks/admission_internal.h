#pragma once

#include <vector>

#include "blocks/geos_internal.h"
#include "core/failure.h"

namespace plat::blocks::detail {

/// Strictly simple polygons on the working grid from a region that GEOS returned: as it is where it
/// passes; else opened by `kOpening_m`, which parts what only touches in a point.
struct Admitted {
  std::vector<Polygon> polygons;
  struct Refused {
    Failure failure;
    Polygon shape;
  };
  std::vector<Refused> refused;
};
Admitted admit_region(const Geos& geos, const Polygon& region, double min_area_m2,
                      std::size_t max_vertices);

}  // namespace plat::blocks::detail
