#include "similarity/shape_admission.h"

#include <fmt/format.h>

#include <cmath>

namespace plat::similarity {

std::optional<Failure> find_shape_defect(const LabelledShape& shape) {
  const Ring& outer = shape.polygon.outer;
  expects(shape.edges.empty() || shape.edges.size() == outer.size(), "a label per edge, or none");
  bool is_finite = true;
  const auto visit = [&](const Ring& ring) {
    for (const Point p : ring) is_finite = is_finite && std::isfinite(p.x) && std::isfinite(p.y);
  };
  visit(outer);
  for (const Ring& hole : shape.polygon.holes) visit(hole);
  if (!is_finite) return Failure{FailureCode::kNotFinite, "a coordinate is not a number"};
  if (outer.size() < 3)
    return Failure{FailureCode::kTooSmall, fmt::format("{} vertices: no area", outer.size())};
  const double outline_m2 = signed_area_m2(outer);
  if (outline_m2 < 0.0) return Failure{FailureCode::kNotSimple, "the outer ring runs clockwise"};
  const double region_m2 = area_m2(shape.polygon);
  if (!(std::isnormal(region_m2) && region_m2 > 0.0))
    return Failure{FailureCode::kTooSmall, fmt::format("an area of {} m2", region_m2)};
  return std::nullopt;
}

}  // namespace plat::similarity
