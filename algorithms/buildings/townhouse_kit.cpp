#include <algorithm>

#include "buildings/row_kit_internal.h"

/// Brick rows under gabled slate roofs: sash windows, stoops, iron balconies, dormers, chimneys.
namespace plat::buildings::detail {
namespace {

constexpr double kRecess_m = 0.16;
constexpr double kGlass_m = 0.04;

void add_glazing_bars(RowPart& part, const Wall& wall, double s0, double s1, double n, double z0,
                      double z1) {
  const double middle = 0.5 * (s0 + s1);
  const double rail = 0.5 * (z0 + z1);
  add_box(part.details(), wall.box(middle - 0.02, middle + 0.02, n - 0.02, n + 0.04, z0, z1),
          kFrame);
  add_box(part.details(), wall.box(s0, s1, n - 0.02, n + 0.06, rail - 0.03, rail + 0.03), kFrame);
}

/// An opening with glass at its bottom, a stone lintel above and a sill below.
void add_window(RowPart& part, const Wall& wall, double centre_s, double base_n, double width_m,
                double z0, double z1) {
  const double s0 = centre_s - 0.5 * width_m;
  const double s1 = centre_s + 0.5 * width_m;
  const double back_n = base_n - kRecess_m;
  part.solid().fill(wall.box(s0, s1, back_n - kGlass_m, back_n, z0, z1), kGlass);
  part.solid().carve(wall.box(s0, s1, back_n, base_n, z0, z1));
  add_glazing_bars(part, wall, s0, s1, back_n, z0, z1);
  add_box(part.details(),
          wall.box(s0 - 0.12, s1 + 0.12, base_n - 0.05, base_n + 0.04, z1, z1 + 0.22), kTrim);
  add_box(part.details(), wall.box(s0 - 0.1, s1 + 0.1, base_n - 0.05, base_n + 0.1, z0 - 0.1, z0),
          kTrim);
}

void add_door(RowPart& part, const Wall& wall, const Bay& bay) {
  const double s0 = bay.centre_m - 0.55;
  const double s1 = bay.centre_m + 0.55;
  const double top = bay.floor_m + 2.3;
  part.solid().fill(wall.box(s0, s1, -0.3, -0.24, bay.floor_m, top), kDoor);
  part.solid().carve(wall.box(s0, s1, -0.24, 0.0, bay.floor_m, top));
  part.solid().fill(wall.box(s0, s1, -0.3, -0.24, top - 0.4, top), kGlass);
  for (const double side : {-1.0, 1.0}) {
    const double s = bay.centre_m + side * 0.7;
    add_box(part.details(), wall.box(s - 0.1, s + 0.1, -0.05, 0.14, bay.floor_m, top + 0.1), kTrim);
  }
  add_box(part.details(), wall.box(s0 - 0.35, s1 + 0.35, -0.05, 0.3, top + 0.1, top + 0.3), kTrim);
  // The stoop.
  const double half_step = 0.5 * bay.floor_m;
  add_box(part.details(), wall.box(s0 - 0.2, s1 + 0.2, -0.05, 0.5, 0.0, bay.floor_m), kPlinth);
  add_box(part.details(), wall.box(s0 - 0.2, s1 + 0.2, 0.45, 0.85, 0.0, half_step), kPlinth);
  part.count("doors");
}

void add_balcony(RowPart& part, const Wall& wall, const Bay& bay) {
  const double half = std::min(0.95, 0.5 * bay.pitch_m - 0.05);
  const double s0 = bay.centre_m - half;
  const double s1 = bay.centre_m + half;
  const double z = bay.floor_m;
  add_window(part, wall, bay.centre_m, bay.base_n, 1.0, z + 0.12, z + 2.2);
  add_box(part.details(), wall.box(s0, s1, -0.05, 1.0, z - 0.12, z), kTrim);
  const double rail = z + 1.0;
  add_box(part.details(), wall.box(s0, s1, 0.94, 1.0, rail - 0.06, rail), kMetal);
  for (const double s : {s0, s1 - 0.05})
    add_box(part.details(), wall.box(s, s + 0.05, -0.05, 1.0, rail - 0.06, rail), kMetal);
  const int bars = std::max(2, static_cast<int>((s1 - s0) / 0.16));
  for (int i = 0; i <= bars; ++i) {
    const double s = s0 + 0.015 + (s1 - s0 - 0.03) * i / bars;
    add_box(part.details(), wall.box(s - 0.012, s + 0.012, 0.955, 0.985, z - 0.01, rail - 0.03),
            kMetal);
  }
  part.count("balconies");
  part.count("windows");
}

void dress_bay(RowPart& part, const Wall& wall, const Bay& bay) {
  switch (bay.kind) {
    case BayKind::kDoor:
      return add_door(part, wall, bay);
    case BayKind::kBalcony:
      return add_balcony(part, wall, bay);
    case BayKind::kShop:
      add_window(part, wall, bay.centre_m, bay.base_n, bay.pitch_m - 0.3, bay.floor_m + 0.5,
                 bay.floor_m + 2.4);
      add_box(
          part.details(),
          wall.box(bay.centre_m - 0.5 * bay.pitch_m + 0.05, bay.centre_m + 0.5 * bay.pitch_m - 0.05,
                   -0.05, 0.7, bay.floor_m + 2.62, bay.floor_m + 2.7),
          kDoor);
      part.count("windows");
      return;
    case BayKind::kWindow:
      add_window(part, wall, bay.centre_m, bay.base_n, 1.0, bay.floor_m + 0.9, bay.floor_m + 2.45);
      part.count("windows");
      return;
  }
}

void add_dormer(RowPart& part, double x) {
  const double half_width = part.family().half_width_m();
  const double front_y = -half_width + 1.1;
  const double sill = part.roof_m(x, front_y) + 0.1;
  const double top = sill + 1.25;
  Mesh& mesh = part.details();
  add_box(mesh, {{x - 0.7, front_y, sill - 0.4}, {x + 0.7, -1.0, top}}, kTrim);
  add_box(mesh, {{x - 0.45, front_y - 0.03, sill}, {x + 0.45, front_y + 0.1, top - 0.15}}, kGlass);
  add_box(mesh, {{x - 0.02, front_y - 0.06, sill}, {x + 0.02, front_y, top - 0.15}}, kFrame);
  add_box(mesh, {{x - 0.47, front_y - 0.06, sill + 0.5}, {x + 0.47, front_y, sill + 0.55}}, kFrame);
  const std::array<Point, 3> gable{Point{-0.95, 0.0}, Point{0.95, 0.0}, Point{0.0, 0.75}};
  add_lying_prism(mesh, gable, {x, front_y - 0.2, top - 0.02}, {x, -0.3, top - 0.02}, {1, 0, 0},
                  kRoof);
  part.count("windows");
  part.count("dormers");
}

void add_chimney(RowPart& part, double x) {
  const double ridge = part.roof_m(x, 0.0);
  add_box(part.details(), {{x - 0.35, 0.5, ridge - 1.6}, {x + 0.35, 1.4, ridge + 0.9}}, kWall);
  add_box(part.details(), {{x - 0.42, 0.43, ridge + 0.85}, {x + 0.42, 1.47, ridge + 1.0}}, kTrim);
  part.count("chimneys");
}

/// Panels that lie on the roof at the back.
void add_solar_panels(RowPart& part, double x0, double x1) {
  const double wide = part.family().half_width_m();
  const double low_y = wide - 1.0;
  const double high_y = 1.2;
  const int count = static_cast<int>((x1 - x0 - 0.2) / 1.1);
  for (int i = 0; i < count; ++i) {
    const double a = 0.5 * (x0 + x1) + (i - 0.5 * count) * 1.1 + 0.05;
    std::array<std::vector<Point3>, 2> rings;
    for (std::size_t k = 0; k < 2; ++k) {
      const double lift = k == 0 ? -0.05 : 0.12;
      for (const auto& [x, y] :
           {Point{a, high_y}, Point{a + 1.0, high_y}, Point{a + 1.0, low_y}, Point{a, low_y}})
        rings[k].push_back({x, y, part.roof_m(x, y) + lift});
    }
    const std::array<std::uint32_t, 1> band{kPanel};
    add_loft(part.details(), rings, band, kPanel);
    const double rise = part.roof_m(a, high_y) - part.roof_m(a, low_y);
    part.count("solar_area_m2", length(Point{low_y - high_y, rise}));
  }
}

void dress_roof(RowPart& part, double x0, double x1, const Features& features) {
  for (int i = 0; i < features.dormers; ++i)
    add_dormer(part, x0 + (x1 - x0) * (i + 0.5) / features.dormers);
  for (int i = 0; i < features.chimneys; ++i)
    add_chimney(part, x0 + (x1 - x0) * (i + 0.5) / features.chimneys);
  if (features.has_solar) add_solar_panels(part, x0, x1);
}

RowStyle style() {
  RowStyle out;
  out.materials = {Material{"granite", {120, 116, 112}},
                   {"dark_brick", {122, 58, 46}},
                   {"brick", {158, 74, 56}},
                   {"limestone", {214, 204, 184}},
                   {"slate", {74, 82, 94}},
                   {"glass", {112, 146, 168}},
                   {"white_paint", {240, 240, 236}},
                   {"green_door", {34, 78, 62}},
                   {"wrought_iron", {38, 38, 42}},
                   {"solar_panel", {22, 34, 84}}};
  const RowFamily two{.name = "two",
                      .depth_m = 9.0,
                      .plinth_m = 0.6,
                      .storeys_m = {3.2, 3.2},
                      .eave_m = 0.2,
                      .overhang_m = 0.4,
                      .roof_slope = 0.9};
  RowFamily three = two;
  three.name = "three";
  three.storeys_m = {3.2, 3.2, 3.2};
  RowFamily deep = three;
  deep.name = "deep";
  deep.depth_m = 11.0;
  out.families = {two, three, deep};
  out.bay_pitch_m = 1.8;
  out.bay_margin_m = 0.3;
  out.dress_bay = dress_bay;
  out.dress_roof = dress_roof;
  out.dress_wall = [](RowPart&, const Wall&, const std::vector<double>&) {};
  return out;
}

}  // namespace

KitPlan townhouse_plan() {
  KitPlan plan;
  plan.name = "townhouse";
  plan.summary =
      "brick rows under gabled slate roofs: sash windows, stoops, balconies, dormers, chimneys, "
      "solar panels";
  plan.style = style();
  plan.ends = {{3.0, {.chimneys = 1}, ""}, {5.0, {.dormers = 2, .chimneys = 1}, "_dormers"}};
  plan.middles = {
      {0.4, {.has_windows = false}, ""},
      {0.6, {.has_windows = false}, ""},
      {1.0, {.chimneys = 1, .has_windows = false}, "_chimney"},
      {1.4, {.has_windows = false}, ""},
      {2.4, {}, ""},
      {2.4, {.balconies = 1, .dormers = 1}, "_balcony"},
      {3.0, {.has_door = true}, "_door"},
      {4.2, {.has_door = true, .dormers = 1}, "_door"},
      {4.4, {.balconies = 2, .dormers = 2}, "_balconies"},
      {4.6, {.has_solar = true, .air_conditions = 1}, "_solar"},
      {6.0, {.has_door = true, .has_shop = true, .dormers = 2}, "_shop"},
      {6.2, {.balconies = 3, .has_door = true, .dormers = 3}, "_balconies"},
      {8.0, {.balconies = 1, .has_door = true, .dormers = 2, .chimneys = 1}, "_door"},
      {9.8, {.has_door = true, .has_solar = true, .chimneys = 1, .air_conditions = 2}, "_solar"},
      {12.0, {.balconies = 4, .has_door = true, .dormers = 4, .chimneys = 2}, "_grand"}};
  plan.corner_angles_deg = {45.0, 60.0, 90.0, 120.0, 135.0};
  plan.tee_margins_m = {0.0};
  return plan;
}

}  // namespace plat::buildings::detail
