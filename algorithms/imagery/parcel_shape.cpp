#include "imagery/parcel_shape.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/failure.h"
#include "parcels/parcel.h"

namespace plat::imagery {
namespace {

constexpr std::array kSymmetries{Symmetry::kKept, Symmetry::kTurned, Symmetry::kMirroredAlong,
                                 Symmetry::kMirroredAcross};

constexpr BoxSides exchanged(BoxSides sides, BoxSides a, BoxSides b) {
  const auto rest = static_cast<BoxSides>(sides & ~(a | b));
  return static_cast<BoxSides>(rest | ((sides & a) != 0 ? b : 0) | ((sides & b) != 0 ? a : 0));
}

bool turns_along(Symmetry s) { return s == Symmetry::kTurned || s == Symmetry::kMirroredAlong; }
bool turns_across(Symmetry s) { return s == Symmetry::kTurned || s == Symmetry::kMirroredAcross; }

/// Index of the side, in the order of its bits, that looks most in the direction `outward`.
std::size_t side_towards(const OrientedBox& box, Point outward) {
  const Point v = perpendicular(box.axis);
  const std::array normals{-v, box.axis, v, -box.axis};
  std::size_t best = 0;
  for (std::size_t i = 1; i < normals.size(); ++i) {
    if (dot(normals[i], outward) > dot(normals[best], outward)) best = i;
  }
  return best;
}

BoxSides street_sides_of(const OrientedBox& box, std::span<const Segment> fronts) {
  std::array<double, 4> front_m{};
  for (const Segment& front : fronts) {
    const Point outward = -perpendicular(front.b - front.a);
    front_m[side_towards(box, outward)] += length(front);
  }
  const std::array side_m{box.length_m, box.width_m, box.length_m, box.width_m};
  const auto longest =
      static_cast<std::size_t>(std::max_element(front_m.begin(), front_m.end()) - front_m.begin());
  BoxSides sides = kNoSide;
  for (std::size_t i = 0; i < front_m.size(); ++i) {
    if (front_m[i] < parcels::kStreetAccess_m) continue;
    if (i == longest || front_m[i] >= kFrontShare_01 * side_m[i])
      sides = static_cast<BoxSides>(sides | (1U << i));
  }
  return sides;
}

}  // namespace

BoxSides moved_sides(BoxSides sides, Symmetry symmetry) {
  if (turns_along(symmetry)) sides = exchanged(sides, kStart, kEnd);
  if (turns_across(symmetry)) sides = exchanged(sides, kBelow, kAbove);
  return sides;
}

BoxSides front_class(BoxSides sides, Mirroring mirroring) {
  BoxSides least = sides;
  for (const Symmetry s : kSymmetries) {
    if (is_mirrored(s) && mirroring == Mirroring::kForbidden) continue;
    least = std::min(least, moved_sides(sides, s));
  }
  return least;
}

std::optional<Symmetry> symmetry_between(BoxSides source, BoxSides target, Mirroring mirroring) {
  for (const Symmetry s : kSymmetries) {
    if (is_mirrored(s) && mirroring == Mirroring::kForbidden) continue;
    if (moved_sides(source, s) == target) return s;
  }
  return std::nullopt;
}

ParcelShape shape_of(Polygon polygon, std::optional<std::span<const Segment>> fronts) {
  ParcelShape shape;
  shape.box = minimum_area_box(polygon);
  expects(shape.box.width_m > 0.0, "a parcel has an area");
  if (fronts) shape.street_sides = street_sides_of(shape.box, *fronts);
  shape.polygon = std::move(polygon);
  return shape;
}

BoxFrame::BoxFrame(const OrientedBox& box, Symmetry symmetry)
    : along_(turns_along(symmetry) ? -box.axis : box.axis),
      across_(turns_across(symmetry) ? -perpendicular(box.axis) : perpendicular(box.axis)),
      length_m_(box.length_m),
      width_m_(box.width_m) {
  origin_ = box.center - 0.5 * length_m_ * along_ - 0.5 * width_m_ * across_;
}

Point BoxFrame::to_frame(Point world) const {
  return {dot(world - origin_, along_), dot(world - origin_, across_)};
}

Point BoxFrame::to_world(Point frame) const {
  return origin_ + frame.x * along_ + frame.y * across_;
}

}  // namespace plat::imagery
