#include "buildings/part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/failure.h"

namespace plat::buildings {

std::string_view name_of(PartClass part_class) {
  static constexpr std::array<std::string_view, 6> kNames{"left_end", "right_end", "middle",
                                                          "corner",   "tee",       "floor"};
  return kNames[static_cast<std::size_t>(part_class)];
}

std::string_view name_of(StemSide side) { return side == StemSide::kBack ? "back" : "front"; }

std::string_view name_of(PortRole role) {
  static constexpr std::array<std::string_view, 5> kNames{"left", "right", "stem", "bottom", "top"};
  return kNames[static_cast<std::size_t>(role)];
}

CutPlane cut_plane(const Port& port) {
  if (port.role == PortRole::kBottom || port.role == PortRole::kTop)
    return {port.position_m, {1, 0, 0}, {0, 1, 0}, port.outward};
  // Left of the walking direction, which enters at the left port and leaves at the others.
  const double sign = port.role == PortRole::kLeft ? -1.0 : 1.0;
  const Point3 across{-sign * port.outward.y, sign * port.outward.x, 0.0};
  return {port.position_m, across, {0, 0, 1}, port.outward};
}

std::vector<Port> ports_of(const PartShape& shape) {
  const auto along = [](PortRole role, Point3 outward, double arm_m) {
    return Port{role, arm_m * outward, outward, arm_m, {}};
  };
  const Port left = along(PortRole::kLeft, {-1, 0, 0}, shape.left_m);
  const Port right = along(PortRole::kRight, {1, 0, 0}, shape.right_m);
  switch (shape.part_class) {
    case PartClass::kLeftEnd:
      return {right};
    case PartClass::kRightEnd:
      return {left};
    case PartClass::kMiddle:
      return {along(PortRole::kLeft, {-1, 0, 0}, 0.0), right};
    case PartClass::kCorner:
      return {left,
              along(PortRole::kRight, {std::cos(shape.angle_rad), std::sin(shape.angle_rad), 0},
                    shape.right_m)};
    case PartClass::kTee:
      return {left, right,
              along(PortRole::kStem, {0, shape.stem_side == StemSide::kBack ? 1.0 : -1.0, 0},
                    shape.stem_m)};
    case PartClass::kFloor:
      return {along(PortRole::kBottom, {0, 0, -1}, 0.0),
              along(PortRole::kTop, {0, 0, 1}, shape.right_m)};
  }
  throw LogicError("unknown part class");
}

std::optional<std::size_t> find_port(const Part& part, PortRole role) {
  const auto at = std::ranges::find(part.ports, role, &Port::role);
  if (at == part.ports.end()) return std::nullopt;
  return static_cast<std::size_t>(at - part.ports.begin());
}

double attribute(const Part& part, const std::string& name) {
  const auto at = part.attributes.find(name);
  return at == part.attributes.end() ? 0.0 : at->second;
}

}  // namespace plat::buildings
