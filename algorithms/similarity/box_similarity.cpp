#include "similarity/box_similarity.h"

#include <fmt/format.h>
#include <cmath>

#include "similarity/shape_admission.h"

namespace plat::similarity {
namespace {

/// Carries the unit square's axes to a box: the first along it, the second across, to the left.
Affine frame_of(const OrientedBox& box) {
  const Point along = box.length_m * box.axis;
  const Point across = box.width_m * perpendicular(box.axis);
  return {along.x, across.x, along.y, across.y, box.center};
}

}  // namespace

BoxCoordinates box_coordinates(const OrientedBox& box, const BoxWeights& weights) {
  return {weights.area * std::log(box.area_m2()), weights.aspect * std::log(box.aspect_ratio())};
}

Expected<BoxSimilarity::Prepared> BoxSimilarity::prepare(const LabelledShape& shape) const {
  if (auto defect = find_shape_defect(shape)) return tl::unexpected(std::move(*defect));
  const OrientedBox box = minimum_area_box(shape.polygon);
  if (!std::isnormal(box.area_m2()) || !std::isfinite(box.aspect_ratio()))
    return fail(FailureCode::kTooSmall,
                fmt::format("a bounding box of {} by {} m", box.length_m, box.width_m));
  return Prepared{box, box_coordinates(box, {options_.area_weight, options_.aspect_weight})};
}

double BoxSimilarity::distance(const Prepared& a, const Prepared& b) const {
  return std::sqrt(squared_distance(a.coordinates, b.coordinates));
}

ShapeComparison BoxSimilarity::compare(const Prepared& a, const Prepared& b) const {
  ShapeComparison out{distance(a, b), std::nullopt, {}};
  if (const auto back = frame_of(a.box).inverse()) out.transformation = frame_of(b.box) * *back;
  return out;
}

SimilarityClaims BoxSimilarity::claims() const {
  return {.is_symmetric = true, .common_scale = true, .collinear_vertices = true};
}

}  // namespace plat::similarity
