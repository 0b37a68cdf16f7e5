#include <algorithm>
#include <cmath>

#include "buildings/face_merging.h"
#include "buildings/row_builder_internal.h"

namespace plat::buildings::detail {
namespace {

constexpr double kPlinthProjection_m = 0.08;
constexpr double kBandProjection_m = 0.06;
/// Thickness of a roof at its eave, and of the walls of a parapet.
constexpr double kRoofEdge_m = 0.15;
constexpr double kParapetWall_m = 0.3;
/// A wall takes a bay more where it lacks less than this share of one: rounding only.
constexpr double kWholeBay = 1e-9;
/// What stays above the opening of an arcade, and beside it at a free end.
constexpr double kArcadeBeam_m = 0.7;
constexpr double kArcadePier_m = 0.7;

/// Grid lines so that the diagonals where two slopes meet run through grid points: at every x of
/// the range a y, and the other way around.
void mitre_grid(CellSolid& solid, double half_width_m, double x_of_corner, double direction) {
  const std::vector<double> xs = solid.xs();
  const std::vector<double> ys = solid.ys();
  for (const double x : xs) {
    const double run_m = direction * (x - x_of_corner);
    if (run_m <= 0.0 || run_m >= half_width_m) continue;
    solid.add_y(half_width_m - run_m);
    solid.add_y(run_m - half_width_m);
  }
  for (const double y : ys) {
    const double run_m = half_width_m - std::abs(y);
    if (run_m > 0.0) solid.add_x(x_of_corner + direction * run_m);
    if (run_m > 0.0) solid.add_y(-y);
  }
}

}  // namespace

double RowFamily::floor_m(std::size_t storey) const {
  double z = plinth_m;
  for (std::size_t i = 0; i < storey; ++i) z += storeys_m[i];
  return z;
}

double RowFamily::top_m() const {
  if (roof_slope == 0.0) return eave_top_m() + parapet_m;
  return eave_top_m() + kRoofEdge_m + roof_slope * half_width_m();
}

double RoofForm::height_m(double x, double y) const {
  double run_m = half_width_m - std::abs(y);
  if (left_hip) run_m = std::min(run_m, x - *left_hip);
  if (right_hip) run_m = std::min(run_m, *right_hip - x);
  if (stem_sign * y > 0.0) run_m = std::max(run_m, half_width_m - std::abs(x));
  return kRoofEdge_m + slope * run_m;
}

Box3 Wall::box(double s0, double s1, double n0, double n1, double z0, double z1) const {
  const auto [a0, a1] = std::minmax({along(s0), along(s1)});
  const auto [b0, b1] = std::minmax({plane + sign * n0, plane + sign * n1});
  if (is_across) return {{b0, a0, z0}, {b1, a1, z1}};
  return {{a0, b0, z0}, {a1, b1, z1}};
}

Point3 Wall::at(double s, double n, double z) const {
  const double a = along(s);
  const double b = plane + sign * n;
  return is_across ? Point3{b, a, z} : Point3{a, b, z};
}

Point3 Wall::outward() const { return is_across ? Point3{sign, 0, 0} : Point3{0, sign, 0}; }
Point3 Wall::across() const { return cross(Point3{0, 0, 1}, outward()); }

Wall straight_wall(const RowFamily& family, double x0, double x1, bool is_front) {
  return {.is_across = false,
          .plane = (is_front ? -1.0 : 1.0) * family.half_depth_m(),
          .sign = is_front ? -1.0 : 1.0,
          .length_m = x1 - x0,
          .along = [x0](double s) { return x0 + s; },
          .is_front = is_front,
          .ground_recess_m = is_front ? family.arcade_m : 0.0};
}

Wall end_wall(const RowFamily& family, double x, double sign) {
  const double from = -family.half_depth_m() + family.arcade_m;
  return {.is_across = true,
          .plane = x,
          .sign = sign,
          .length_m = family.half_depth_m() - from,
          .along = [from](double s) { return from + s; }};
}

void RowPart::fill(CellSolid& solid, const RowFamily& family, bool is_wing, double from, double to,
                   bool is_free_from, bool is_free_to) const {
  // A wing runs along y; its right hand side, walking outwards, is its front.
  const double direction = to >= from ? 1.0 : -1.0;
  const auto box = [&](double ends_m, double lateral0, double lateral1, double z0, double z1) {
    const double a = from - (is_free_from ? direction * ends_m : 0.0);
    const double b = to + (is_free_to ? direction * ends_m : 0.0);
    const auto [a0, a1] = std::minmax({a, b});
    if (!is_wing) return Box3{{a0, lateral0, z0}, {a1, lateral1, z1}};
    const auto [x0, x1] = std::minmax({-direction * lateral0, -direction * lateral1});
    return Box3{{x0, a0, z0}, {x1, a1, z1}};
  };
  const double half = family.half_depth_m();
  const double wide = family.half_width_m();
  const double top = family.eave_top_m();
  const auto ring = [&](double out_m, double z0, double z1, Surface surface) {
    solid.fill(box(out_m, -half - out_m, half + out_m, z0, z1), surface);
  };
  ring(kPlinthProjection_m, 0.0, family.plinth_m, kPlinth);
  for (std::size_t i = 0; i < family.storeys_m.size(); ++i) {
    ring(0.0, family.floor_m(i), family.floor_m(i + 1), i == 0 ? kGroundWall : kWall);
    if (i > 0) ring(kBandProjection_m, family.floor_m(i) - family.band_m, family.floor_m(i), kTrim);
  }
  ring(0.5 * family.overhang_m, top - 2.0 * family.eave_m, top - family.eave_m, kTrim);
  ring(family.overhang_m, top - family.eave_m, top, kTrim);
  if (family.roof_slope > 0.0) {
    solid.fill(box(family.overhang_m, -wide, wide, top, top + 1.0), kRoof);
  } else {
    solid.fill(box(0.0, -half, half, top - 0.1, top), kRoof);
    solid.fill(box(0.0, -half, -half + kParapetWall_m, top, top + family.parapet_m), kTrim);
    solid.fill(box(0.0, half - kParapetWall_m, half, top, top + family.parapet_m), kTrim);
    const auto end = [&](double x0, double x1) {
      solid.fill({{x0, -half, top}, {x1, half, top + family.parapet_m}}, kTrim);
    };
    if (is_free_from) end(from, from + kParapetWall_m);
    if (is_free_to) end(to - kParapetWall_m, to);
  }
  if (family.arcade_m == 0.0) return;
  const double pier_from = is_free_from ? kArcadePier_m : 0.0;
  const double pier_to = is_free_to ? kArcadePier_m : 0.0;
  Box3 open =
      box(0.0, -half, -half + family.arcade_m, family.plinth_m, family.floor_m(1) - kArcadeBeam_m);
  if (!is_wing) {
    open.low.x += pier_from;
    open.high.x -= pier_to;
  }
  solid.carve(open);
}

void RowPart::add_body(const RowFamily& family, double x0, double x1, bool is_free_left,
                       bool is_free_right) {
  Body& body = bodies_.emplace_back();
  body.eave_top_m = family.eave_top_m();
  body.roof = {.half_width_m = family.half_width_m(), .slope = family.roof_slope};
  fill(body.solid, family, false, x0, x1, is_free_left, is_free_right);
  body.solid.add_y(0.0);
  // A hip must end before the port, or the section there would not be the family's.
  const bool has_hips = family.is_hipped && x1 - x0 >= family.half_depth_m();
  if (has_hips && is_free_left) body.roof.left_hip = x0 - family.overhang_m;
  if (has_hips && is_free_right) body.roof.right_hip = x1 + family.overhang_m;
  count("floor_area_m2", (x1 - x0) * family.depth_m * static_cast<double>(family.storeys_m.size()));
}

void RowPart::add_tee_body(double arm_m, double sign) {
  Body& body = bodies_.emplace_back();
  body.eave_top_m = family_.eave_top_m();
  body.roof = {
      .half_width_m = family_.half_width_m(), .slope = family_.roof_slope, .stem_sign = sign};
  const double half = family_.half_depth_m();
  fill(body.solid, family_, false, -arm_m, arm_m, false, false);
  const bool is_flat = family_.roof_slope == 0.0;
  // A sloped roof starts at the bar's own ridge, a terrace at its wall.
  CellSolid& solid = body.solid;
  const auto range = [&](double from, double to) { return std::minmax({sign * from, sign * to}); };
  fill(solid, family_, true, sign * (is_flat ? half : 0.0), sign * arm_m, false, false);
  if (is_flat) {
    const auto [y0, y1] = range(half - kParapetWall_m, arm_m);
    const double inner = half - kParapetWall_m;
    solid.carve({{-inner, y0, body.eave_top_m}, {inner, y1, family_.top_m()}});
    const auto [c0, c1] = range(half - kParapetWall_m, half + family_.overhang_m);
    solid.fill({{-inner, c0, body.eave_top_m - 0.1}, {inner, c1, body.eave_top_m}}, kRoof);
  }
  if (family_.arcade_m > 0.0) {
    const double z1 = family_.floor_m(1) - kArcadeBeam_m;
    solid.carve({{-arm_m, -half, family_.plinth_m}, {arm_m, -half + family_.arcade_m, z1}});
  }
  solid.add_y(0.0);
  solid.add_x(0.0);
  count("floor_area_m2", (2.0 * arm_m * family_.depth_m + (arm_m - half) * family_.depth_m) *
                             static_cast<double>(family_.storeys_m.size()));
}

double RowPart::roof_m(double x, double y) const {
  const Body& body = bodies_.back();
  return body.eave_top_m + (body.roof.slope > 0.0 ? body.roof.height_m(x, y) : 0.0);
}

void RowPart::dress(const Wall& wall, const Features& features) {
  const double usable_m = wall.length_m - 2.0 * style_.bay_margin_m;
  const int bays =
      features.has_windows
          ? std::max(0, static_cast<int>(std::floor(usable_m / style_.bay_pitch_m + kWholeBay)))
          : 0;
  std::vector<double> centres;
  const double pitch_m = bays > 0 ? usable_m / bays : usable_m;
  for (int i = 0; i < bays; ++i) centres.push_back(style_.bay_margin_m + (i + 0.5) * pitch_m);
  int balconies = wall.is_front ? features.balconies : 0;
  for (std::size_t storey = 0; storey < family_.storeys_m.size(); ++storey) {
    for (int i = 0; i < bays; ++i) {
      Bay bay{.storey = storey,
              .centre_m = centres[static_cast<std::size_t>(i)],
              .pitch_m = pitch_m,
              .base_n = storey == 0 ? -wall.ground_recess_m : 0.0,
              .floor_m = family_.floor_m(storey),
              .height_m = family_.storeys_m[storey]};
      if (wall.is_front && storey == 0 && features.has_shop) bay.kind = BayKind::kShop;
      if (wall.is_front && storey == 0 && features.has_door && i == bays / 2)
        bay.kind = BayKind::kDoor;
      if (storey > 0 && balconies > 0) {
        bay.kind = BayKind::kBalcony;
        --balconies;
      }
      style_.dress_bay(*this, wall, bay);
    }
  }
  style_.dress_wall(*this, wall, centres);
  if (wall.is_front || bays == 0) return;
  for (int i = 0; i < features.air_conditions; ++i) {
    const double s = centres[static_cast<std::size_t>(i % bays)] + 0.3 * pitch_m;
    const double z =
        family_.floor_m(1 + static_cast<std::size_t>(i / bays) % (family_.storeys_m.size() - 1)) +
        0.5;
    add_box(details_, wall.box(s - 0.35, s + 0.35, -0.05, 0.35, z, z + 0.6), kMetal);
    count("air_conditions");
  }
}

void RowPart::dress_roof(double x0, double x1, const Features& features) {
  style_.dress_roof(*this, x0, x1, features);
}

/// The axis turns at x = 0: stretches of `zone_m_` on both sides are sheared to meet in the mitre
/// plane, what is beyond is moved as it is.
Point3 RowPart::bent(Point3 p) const {
  if (angle_rad_ == 0.0) return p;
  const double tangent = std::tan(0.5 * angle_rad_);
  const double share = std::max(0.0, 1.0 - std::abs(p.x) / zone_m_);
  if (p.x <= 0.0) return {p.x - share * p.y * tangent, p.y, p.z};
  const double along = p.x + share * p.y * tangent;
  const double c = std::cos(angle_rad_);
  const double s = std::sin(angle_rad_);
  return {along * c - p.y * s, along * s + p.y * c, p.z};
}

Part RowPart::finish(std::string name, const PartShape& shape) const {
  Mesh mesh;
  const auto add_piece = [&](Mesh piece) {
    piece.materials.assign(style_.materials.begin(), style_.materials.end());
    append(mesh, piece);
  };
  for (const Body& body : bodies_) {
    CellSolid solid = body.solid;
    const RoofForm& roof = body.roof;
    if (angle_rad_ != 0.0) solid.add_x(0.0);  // the mitre
    if (roof.slope > 0.0) {
      // Twice: what one diagonal asks for, the other one must have.
      for (int i = 0; i < 2; ++i) {
        if (roof.left_hip) mitre_grid(solid, roof.half_width_m, *roof.left_hip, 1.0);
        if (roof.right_hip) mitre_grid(solid, roof.half_width_m, *roof.right_hip, -1.0);
        if (roof.stem_sign == 0.0) continue;
        mitre_grid(solid, roof.half_width_m, -roof.half_width_m, 1.0);
        mitre_grid(solid, roof.half_width_m, roof.half_width_m, -1.0);
      }
    }
    add_piece(solid.surface([&](Point3 p) {
      if (roof.slope == 0.0 || p.z <= body.eave_top_m) return p;
      const double share = p.z - body.eave_top_m;
      return Point3{p.x, p.y, body.eave_top_m + share * roof.height_m(p.x, p.y)};
    }));
  }
  add_piece(details_);
  for (Point3& p : mesh.vertices) p = bent(p);
  mesh = merge_faces(mesh);
  for (Point3& p : mesh.vertices) p = as_stored(p);
  std::map<std::string, double> attributes = attributes_;
  attributes["height_m"] = family_.top_m();
  return make_part(std::move(name), shape, std::move(mesh), std::move(attributes));
}

}  // namespace plat::buildings::detail
