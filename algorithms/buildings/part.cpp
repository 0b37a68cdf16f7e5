#include "buildings/part.h"

#include <fmt/format.h>

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

namespace {

/// Names the caps of a part and extracts its sections.
/// @returns whether every port has a cap
bool cut_ports(Part& part) {
  bool has_caps = true;
  for (Face& face : part.mesh.faces) face.port.reset();
  for (std::size_t i = 0; i < part.ports.size(); ++i) {
    Port& port = part.ports[i];
    const CutPlane plane = cut_plane(port);
    for (const std::size_t face : cap_faces(part.mesh, plane))
      part.mesh.faces[face].port = static_cast<std::uint32_t>(i);
    port.section = cap_section(part.mesh, plane);
    if (port.section.regions.empty()) {
      has_caps = false;
      port.section = slice_section(part.mesh, plane);
    }
    if (port.section.regions.empty())
      throw InputError(fmt::format(
          "part {}: the mesh does not reach its {} port at ({:.3f}, {:.3f}, {:.3f})", part.name,
          name_of(port.role), port.position_m.x, port.position_m.y, port.position_m.z));
  }
  return has_caps;
}

/// Names become file names.
void expect_good_name(const std::string& name) {
  const bool is_good = !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
  if (!is_good || name.front() == '.')
    throw InputError(fmt::format(
        "part \"{}\": names are letters, digits, \"_\", \"-\" and \".\", not in front", name));
}

void expect_good_shape(const std::string& name, const PartShape& shape) {
  const bool has_left = shape.part_class == PartClass::kRightEnd ||
                        shape.part_class == PartClass::kCorner ||
                        shape.part_class == PartClass::kTee;
  const bool has_right = shape.part_class != PartClass::kRightEnd;
  const auto expect_length = [&](bool is_used, double length_m, std::string_view what) {
    if (is_used ? length_m > 0.0 && std::isfinite(length_m) : length_m == 0.0) return;
    throw InputError(fmt::format("part {}: {} = {} m, {} for a part of class {}", name, what,
                                 length_m, is_used ? "must be positive" : "must be 0",
                                 name_of(shape.part_class)));
  };
  expect_length(has_left, shape.left_m, "left arm");
  expect_length(has_right, shape.right_m, "right arm, length or height");
  expect_length(shape.part_class == PartClass::kTee, shape.stem_m, "stem arm");
  if (shape.part_class == PartClass::kCorner &&
      !(std::abs(shape.angle_rad) > 0.0 && std::abs(shape.angle_rad) < std::numbers::pi))
    throw InputError(fmt::format("part {}: angle = {} degrees, allowed -180 to 180 and not 0", name,
                                 shape.angle_rad * 180.0 / std::numbers::pi));
}

/// "length_m" or "height_m", which follow from the shape.
void set_lengths(Part& part) {
  const PartShape& shape = part.shape;
  if (shape.part_class == PartClass::kFloor) {
    part.attributes["height_m"] = shape.right_m;
  } else {
    part.attributes["length_m"] = shape.left_m + shape.right_m + shape.stem_m;
  }
}

/// A multiple of the quantum, as the nearest double to its decimal: 3 * 0.2 would be
/// 0.6000000000000001.
double multiple(double count, double quantum_m) {
  return std::round(count * quantum_m * 1e9) / 1e9;
}

double nearest_multiple(double length_m, double quantum_m) {
  return multiple(std::max(1.0, std::round(length_m / quantum_m)), quantum_m);
}

/// Moves the vertices in each port plane outwards, to the next multiple of the arm.
void extend_arms(Part& part, double quantum_m) {
  const std::array<double*, 3> arms{&part.shape.left_m, &part.shape.right_m, &part.shape.stem_m};
  for (const Port& port : part.ports) {
    double& arm = *arms[static_cast<std::size_t>(port.role)];  // left, right, stem
    const double moved_m = multiple(std::ceil(arm / quantum_m), quantum_m) - arm;
    const CutPlane plane = cut_plane(port);
    for (Point3& p : part.mesh.vertices) {
      if (std::abs(dot(p - plane.origin, plane.outward)) <= kCapTolerance_m)
        p = p + moved_m * plane.outward;
    }
    arm += moved_m;
  }
}

void scale_along_axis(Part& part, double quantum_m) {
  const bool is_floor = part.shape.part_class == PartClass::kFloor;
  double& length =
      part.shape.part_class == PartClass::kRightEnd ? part.shape.left_m : part.shape.right_m;
  const double new_length = nearest_multiple(length, quantum_m);
  const double factor = new_length / length;
  for (Point3& p : part.mesh.vertices) (is_floor ? p.z : p.x) *= factor;
  length = new_length;
}

}  // namespace

Part make_part(std::string name, const PartShape& shape, Mesh mesh,
               std::map<std::string, double> attributes) {
  expect_good_name(name);
  expect_good_shape(name, shape);
  Part part{std::move(name), shape, std::move(mesh), ports_of(shape), std::move(attributes)};
  const std::optional<MeshDefect> defect = find_defect(part.mesh);
  if (!defect || defect->kind != MeshDefectKind::kBadIndex) drop_unused_materials(part.mesh);
  const bool is_open = defect && defect->kind == MeshDefectKind::kOpen;
  if (defect && !is_open)
    throw InputError(
        fmt::format("part {}: the mesh does not bound a solid: {}", part.name, defect->message));
  const bool has_caps = cut_ports(part);
  if (!has_caps && !is_open)
    throw InputError(
        fmt::format("part {}: the mesh is closed, but has no face in a port's plane; "
                    "it may reach beyond it",
                    part.name));
  if (has_caps && is_open)
    throw InputError(fmt::format("part {}: the mesh is open, and not at a port: {}", part.name,
                                 defect->message));
  set_lengths(part);
  return part;
}

bool is_quantised(const Part& part, double quantum_m) {
  const auto is_multiple = [&](double length_m) {
    return std::abs(length_m / quantum_m - std::round(length_m / quantum_m)) <= kQuantumTolerance;
  };
  return is_multiple(part.shape.left_m) && is_multiple(part.shape.right_m) &&
         is_multiple(part.shape.stem_m);
}

Quantised quantised(const Part& part, double quantum_m) {
  if (is_quantised(part, quantum_m)) return {part, 1.0};
  Quantised out{part, 1.0};
  const PartShape& old = part.shape;
  if (old.part_class == PartClass::kCorner || old.part_class == PartClass::kTee) {
    extend_arms(out.part, quantum_m);
  } else {
    scale_along_axis(out.part, quantum_m);
  }
  const PartShape& now = out.part.shape;
  out.factor = (now.left_m + now.right_m + now.stem_m) / (old.left_m + old.right_m + old.stem_m);
  std::vector<Port> ports = ports_of(now);
  for (std::size_t i = 0; i < ports.size(); ++i) ports[i].section = part.ports[i].section;
  out.part.ports = std::move(ports);
  set_lengths(out.part);
  return out;
}

}  // namespace plat::buildings
