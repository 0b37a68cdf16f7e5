#include <algorithm>

#include "buildings/row_kit_internal.h"

/// Stone and stucco in the manner of the renaissance: pedimented windows, pilasters, cornices,
/// arcades of columns, hipped tile roofs and terraces with balustrades.
namespace plat::buildings::detail {
namespace {

constexpr double kRecess_m = 0.3;

/// A window with a moulded frame; a pediment in the main storey.
void add_window(RowPart& part, const Wall& wall, const Bay& bay, double width_m, double z0,
                double z1, bool has_pediment) {
  const double s0 = bay.centre_m - 0.5 * width_m;
  const double s1 = bay.centre_m + 0.5 * width_m;
  const double n = bay.base_n;
  part.solid().fill(wall.box(s0, s1, n - kRecess_m - 0.05, n - kRecess_m, z0, z1), kGlass);
  part.solid().carve(wall.box(s0, s1, n - kRecess_m, n, z0, z1));
  Mesh& mesh = part.details();
  const double bar_n = n - kRecess_m;
  add_box(mesh,
          wall.box(bay.centre_m - 0.04, bay.centre_m + 0.04, bar_n - 0.02, bar_n + 0.06, z0, z1),
          kFrame);
  const double transom = z0 + 0.68 * (z1 - z0);
  add_box(mesh, wall.box(s0, s1, bar_n - 0.02, bar_n + 0.08, transom - 0.04, transom + 0.04),
          kFrame);
  for (const double s : {s0 - 0.22, s1})
    add_box(mesh, wall.box(s, s + 0.22, n - 0.05, n + 0.08, z0 - 0.02, z1 + 0.02), kTrim);
  add_box(mesh, wall.box(s0 - 0.3, s1 + 0.3, n - 0.05, n + 0.18, z0 - 0.2, z0), kTrim);
  add_box(mesh, wall.box(s0 - 0.3, s1 + 0.3, n - 0.05, n + 0.14, z1, z1 + 0.25), kTrim);
  if (has_pediment) {
    // Between the places along the wall, so that a pediment near a mitre is as wide as its window.
    const Point3 left = wall.at(bay.centre_m - 0.5 * width_m - 0.42, n + 0.28, z1 + 0.25);
    const Point3 right = wall.at(bay.centre_m + 0.5 * width_m + 0.42, n + 0.28, z1 + 0.25);
    const double half = 0.5 * length(right - left);
    const std::array<Point, 3> gable{Point{-half, 0.0}, Point{half, 0.0}, Point{0.0, 0.55}};
    const Point3 front = 0.5 * (left + right);
    add_lying_prism(mesh, gable, front, front - 0.33 * wall.outward(), wall.across(), kTrim);
  }
  part.count("windows");
}

void add_portal(RowPart& part, const Wall& wall, const Bay& bay) {
  const double n = bay.base_n;
  const double top = bay.floor_m + 3.0;
  const double s0 = bay.centre_m - 0.8;
  const double s1 = bay.centre_m + 0.8;
  part.solid().fill(wall.box(s0, s1, n - 0.5, n - 0.4, bay.floor_m, top), kDoor);
  part.solid().carve(wall.box(s0, s1, n - 0.4, n, bay.floor_m, top));
  Mesh& mesh = part.details();
  for (const double s : {s0 - 0.35, s1})
    add_box(mesh, wall.box(s, s + 0.35, n - 0.05, n + 0.25, bay.floor_m, top), kTrim);
  add_box(mesh, wall.box(s0 - 0.5, s1 + 0.5, n - 0.05, n + 0.4, top, top + 0.3), kTrim);
  if (n == 0.0) {
    add_box(mesh, wall.box(s0 - 0.4, s1 + 0.4, -0.05, 0.5, 0.0, bay.floor_m), kPlinth);
    add_box(mesh, wall.box(s0 - 0.4, s1 + 0.4, 0.45, 0.9, 0.0, 0.5 * bay.floor_m), kPlinth);
  }
  part.count("doors");
}

void add_balustrade(Mesh& mesh, const Wall& wall, double s0, double s1, double n0, double n1,
                    double z0, double z1) {
  add_box(mesh, wall.box(s0, s1, n0, n1, z1 - 0.14, z1), kTrim);
  const int count = std::max(2, static_cast<int>((s1 - s0) / 0.3));
  const double middle_n = 0.5 * (n0 + n1);
  for (int i = 0; i <= count; ++i) {
    const double s = s0 + 0.08 + (s1 - s0 - 0.16) * i / count;
    const Point3 at = wall.at(s, middle_n, 0.0);
    add_column(mesh, {at.x, at.y}, 0.07, z0 - 0.02, z1 - 0.1, 6, kTrim);
  }
}

void add_balcony(RowPart& part, const Wall& wall, const Bay& bay) {
  const double z = bay.floor_m;
  const double s0 = bay.centre_m - 1.2;
  const double s1 = bay.centre_m + 1.2;
  add_window(part, wall, bay, 1.3, z + 0.2, z + 2.8, false);
  Mesh& mesh = part.details();
  add_box(mesh, wall.box(s0, s1, -0.05, 1.1, z - 0.1, z + 0.12), kTrim);
  for (const double s : {s0 + 0.15, s1 - 0.4})
    add_box(mesh, wall.box(s, s + 0.25, -0.05, 0.8, z - 0.5, z - 0.08), kTrim);
  add_balustrade(mesh, wall, s0, s1, 0.88, 1.08, z + 0.12, z + 1.05);
  for (const double s : {s0, s1 - 0.2})
    add_box(mesh, wall.box(s, s + 0.2, -0.05, 1.08, z + 0.1, z + 1.05), kTrim);
  part.count("balconies");
}

void dress_bay(RowPart& part, const Wall& wall, const Bay& bay) {
  const double z = bay.floor_m;
  switch (bay.kind) {
    case BayKind::kDoor:
      return add_portal(part, wall, bay);
    case BayKind::kBalcony:
      return add_balcony(part, wall, bay);
    case BayKind::kShop:
      return add_window(part, wall, bay, 1.9, z + 0.3, z + 3.1, false);
    case BayKind::kWindow:
      if (bay.storey == 0) return add_window(part, wall, bay, 1.2, z + 1.2, z + 3.0, false);
      return add_window(part, wall, bay, 1.3, z + 0.9, z + 2.8, bay.storey == 1);
  }
}

/// Pilasters between the bays; columns where the wall stands over an arcade.
void dress_wall(RowPart& part, const Wall& wall, const std::vector<double>& centres) {
  const RowFamily& family = part.family();
  Mesh& mesh = part.details();
  const double top = family.eave_top_m() - 2.0 * family.eave_m;
  const double foot = family.floor_m(1);
  for (std::size_t i = 0; i + 1 < centres.size(); ++i) {
    const double s = 0.5 * (centres[i] + centres[i + 1]);
    add_box(mesh, wall.box(s - 0.25, s + 0.25, -0.05, 0.12, foot - 0.02, top + 0.02), kTrim);
    add_box(mesh, wall.box(s - 0.32, s + 0.32, -0.05, 0.18, top - 0.45, top + 0.02), kTrim);
  }
  if (wall.ground_recess_m == 0.0) return;
  const double beam = family.floor_m(1) - 0.7;
  for (std::size_t i = 0; i + 1 < centres.size(); ++i) {
    const Point3 at = wall.at(0.5 * (centres[i] + centres[i + 1]), -0.35, 0.0);
    const Point foot_at{at.x, at.y};
    add_column(mesh, foot_at, 0.26, family.plinth_m - 0.05, beam + 0.05, 14, kTrim);
    add_box(mesh,
            {{at.x - 0.34, at.y - 0.34, family.plinth_m - 0.05},
             {at.x + 0.34, at.y + 0.34, family.plinth_m + 0.25}},
            kTrim);
    add_box(mesh, {{at.x - 0.36, at.y - 0.36, beam - 0.3}, {at.x + 0.36, at.y + 0.36, beam + 0.05}},
            kTrim);
    part.count("columns");
  }
}

void dress_roof(RowPart& part, double x0, double x1, const Features& features) {
  const RowFamily& family = part.family();
  const double top = family.eave_top_m();
  const bool is_terrace = family.roof_slope == 0.0;
  if (features.has_solar && is_terrace) {
    for (double x = x0 + 0.4; x + 1.6 <= x1; x += 1.8) {
      const std::array<Point, 3> wedge{Point{-0.9, 0.0}, Point{0.9, 0.0}, Point{0.9, 0.7}};
      add_lying_prism(part.details(), wedge, {x, 1.0, top - 0.02}, {x + 1.5, 1.0, top - 0.02},
                      {0, -1, 0}, kPanel);
      part.count("solar_area_m2", 1.5 * length(Point{1.8, 0.7}));
    }
  }
  for (int i = 0; i < features.chimneys; ++i) {
    const double x = x0 + (x1 - x0) * (i + 0.5) / features.chimneys;
    const double y = 0.3 * family.depth_m;
    const double roof = part.roof_m(x, y);
    add_box(part.details(), {{x - 0.4, y - 0.4, top - 0.05}, {x + 0.4, y + 0.4, roof + 1.8}},
            kWall);
    add_box(part.details(), {{x - 0.5, y - 0.5, roof + 1.75}, {x + 0.5, y + 0.5, roof + 1.95}},
            kTrim);
    part.count("chimneys");
  }
}

RowStyle style() {
  RowStyle out;
  out.materials = {Material{"travertine", {168, 154, 130}},
                   {"rusticated_stone", {204, 186, 152}},
                   {"ochre_stucco", {226, 190, 122}},
                   {"white_stone", {238, 230, 212}},
                   {"terracotta_tile", {178, 92, 58}},
                   {"glass", {70, 92, 104}},
                   {"dark_wood", {92, 64, 42}},
                   {"oak_portal", {104, 66, 36}},
                   {"bronze", {84, 74, 56}},
                   {"solar_panel", {22, 34, 84}}};
  const RowFamily piano{.name = "piano",
                        .depth_m = 12.0,
                        .plinth_m = 0.6,
                        .storeys_m = {4.2, 4.4},
                        .band_m = 0.35,
                        .eave_m = 0.35,
                        .overhang_m = 0.8,
                        .roof_slope = 0.42,
                        .is_hipped = true};
  RowFamily nobile = piano;
  nobile.name = "nobile";
  nobile.storeys_m = {4.2, 4.4, 4.0};
  RowFamily loggia = piano;
  loggia.name = "loggia";
  loggia.roof_slope = 0.0;
  loggia.is_hipped = false;
  loggia.overhang_m = 0.6;
  loggia.parapet_m = 1.0;
  loggia.arcade_m = 2.6;
  out.families = {piano, nobile, loggia};
  out.bay_pitch_m = 2.8;
  out.bay_margin_m = 0.2;
  out.dress_bay = dress_bay;
  out.dress_roof = dress_roof;
  out.dress_wall = dress_wall;
  return out;
}

}  // namespace

KitPlan palazzo_plan() {
  KitPlan plan;
  plan.name = "palazzo";
  plan.summary =
      "stone and stucco: pedimented windows, pilasters, arcades of columns, hipped tile roofs, "
      "terraces";
  plan.style = style();
  plan.ends = {
      {3.2, {}, ""}, {6.2, {.chimneys = 1}, "_chimney"}, {9.0, {.balconies = 1}, "_balcony"}};
  for (const double length_m : {0.4, 0.6, 0.8, 1.0, 1.4, 2.0})
    plan.middles.push_back({length_m, {.has_windows = false}, ""});
  const std::vector<MiddlePlan> windowed{
      {3.2, {}, ""},
      {3.2, {.balconies = 1}, "_balcony"},
      {3.4, {.has_door = true}, "_portal"},
      {3.6, {.chimneys = 1}, "_chimney"},
      {4.0, {.air_conditions = 1}, "_cooled"},
      {6.0, {}, ""},
      {6.0, {.balconies = 2}, "_balconies"},
      {6.2, {.balconies = 1, .has_door = true}, "_portal"},
      {6.4, {.has_shop = true}, "_shop"},
      {8.8, {.balconies = 1, .has_door = true, .chimneys = 1}, "_portal"},
      {8.8, {.balconies = 3, .has_shop = true}, "_balconies"},
      {9.0, {.has_solar = true, .air_conditions = 2}, "_solar"},
      {11.6, {.balconies = 2, .has_door = true, .has_solar = true, .chimneys = 1}, "_grand"},
      {12.0, {.balconies = 4, .has_door = true, .chimneys = 2}, "_grand"}};
  plan.middles.insert(plan.middles.end(), windowed.begin(), windowed.end());
  plan.corner_angles_deg = {45.0, 60.0, 90.0, 120.0, 135.0};
  plan.tee_margins_m = {0.0, 3.0};
  return plan;
}

}  // namespace plat::buildings::detail
