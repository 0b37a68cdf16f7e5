#include <fmt/format.h>

#include "blocks/admission_internal.h"
#include "core/planar_graph.h"
#include "core/validity.h"

namespace plat::blocks::detail {
namespace {

/// Wide enough to survive rounding to the grid of 1 mm, narrow against any survey.
constexpr double kOpening_m = 0.02;

}  // namespace

Admitted admit_region(const Geos& geos, const Polygon& region, double min_area_m2,
                      std::size_t max_vertices) {
  Admitted out;
  const auto accept = [&](Polygon polygon) {
    const double area = area_m2(polygon);
    if (area >= min_area_m2) {
      out.polygons.push_back(std::move(polygon));
    } else {
      out.refused.push_back({{FailureCode::kTooSmall,
                              fmt::format("{:.2f} m2, at least {} are wanted", area, min_area_m2)},
                             std::move(polygon)});
    }
  };
  auto admitted = admit_polygon(region, max_vertices);
  if (admitted && is_noded(*admitted)) {
    accept(*std::move(admitted));
    return out;
  }
  if (admitted) admitted = fail(FailureCode::kNotSimple, "comes within a grid step of itself");
  const FailureCode code = admitted.error().code;
  if (code == FailureCode::kNotSimple || code == FailureCode::kBadHole) {
    const GeosShape shape = geos.from(region);
    const GeosShape opened =
        geos.buffer(geos.buffer(shape.get(), -kOpening_m).get(), 0.5 * kOpening_m);
    const std::vector<Polygon> parts = geos.polygons_of(opened.get());
    for (const Polygon& part : parts) {
      auto retried = admit_polygon(part, max_vertices);
      if (retried) {
        accept(*std::move(retried));
      } else {
        out.refused.push_back({std::move(retried.error()), part});
      }
    }
    if (!parts.empty()) return out;
  }
  out.refused.push_back({std::move(admitted.error()), region});
  return out;
}

}  // namespace plat::blocks::detail
