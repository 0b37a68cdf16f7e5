#include "buildings/row_kit_internal.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace plat::buildings::detail {
namespace {

/// Straight axis left between a mitre and its port, so that the port is cut through walls that run
/// along the axis.
constexpr double kMitreMargin_m = 0.1;
/// Side of the pier at the outer corner of an arcade; along the axis it takes half, as the mitre
/// stretches it.
constexpr double kCornerPier_m = 0.7;
/// Transition parts of two families.
constexpr double kTransitionLength_m = 3.6;
/// How far the lower body of a transition part reaches into the higher one.
constexpr double kTransitionOverlap_m = 0.1;

/// 3.6 m is "036": names sort by length.
std::string length_name(double length_m) {
  return fmt::format("{:03.0f}", std::round(10.0 * length_m));
}

Part make_middle(const RowStyle& style, const RowFamily& family, const MiddlePlan& plan) {
  RowPart part(style, family);
  part.add_body(family, 0.0, plan.length_m, false, false);
  part.dress(straight_wall(family, 0.0, plan.length_m, true), plan.features);
  part.dress(straight_wall(family, 0.0, plan.length_m, false), plan.features);
  part.dress_roof(0.0, plan.length_m, plan.features);
  return part.finish(
      fmt::format("{}_middle_{}{}", family.name, length_name(plan.length_m), plan.suffix),
      {.part_class = PartClass::kMiddle, .right_m = plan.length_m});
}

Part make_end(const RowStyle& style, const RowFamily& family, const MiddlePlan& plan,
              PartClass end) {
  const bool is_left = end == PartClass::kLeftEnd;
  const double x0 = is_left ? 0.0 : -plan.length_m;
  const double x1 = x0 + plan.length_m;
  RowPart part(style, family);
  part.add_body(family, x0, x1, is_left, !is_left);
  part.dress(straight_wall(family, x0, x1, true), plan.features);
  part.dress(straight_wall(family, x0, x1, false), plan.features);
  part.dress(end_wall(family, 0.0, is_left ? -1.0 : 1.0), {});
  part.dress_roof(x0, x1, plan.features);
  PartShape shape{.part_class = end};
  (is_left ? shape.right_m : shape.left_m) = plan.length_m;
  return part.finish(
      fmt::format("{}_{}_{}{}", family.name, name_of(end), length_name(plan.length_m), plan.suffix),
      shape);
}

/// The wall of one arm of a corner, measured from its port: the outer wall is longer than the axis,
/// the inner one shorter, by what the mitre takes.
Wall arm_wall(const RowFamily& family, bool is_front, bool is_left_arm, double arm_m, double zone_m,
              double angle_rad) {
  Wall wall = straight_wall(family, 0.0, arm_m, is_front);
  const double gain_m = -wall.plane * std::tan(0.5 * angle_rad);
  wall.length_m = arm_m + gain_m;
  const double straight_m = arm_m - zone_m;
  const double rate = zone_m / (zone_m + gain_m);
  const double side = is_left_arm ? -1.0 : 1.0;
  wall.along = [=](double s) {
    const double from_port_m = s <= straight_m ? s : straight_m + (s - straight_m) * rate;
    return side * (arm_m - from_port_m);
  };
  return wall;
}

Part make_corner(const RowStyle& style, const RowFamily& family, double angle_rad) {
  const double reach_m = family.half_width_m() * std::tan(0.5 * std::abs(angle_rad));
  const double zone_m = reach_m + kMitreMargin_m;
  const double arm_m = up_to_quantum(zone_m + kMitreMargin_m);
  RowPart part(style, family);
  part.bend(angle_rad, zone_m);
  part.add_body(family, -arm_m, arm_m, false, false);
  for (const bool is_front : {true, false}) {
    for (const bool is_left_arm : {true, false})
      part.dress(arm_wall(family, is_front, is_left_arm, arm_m, zone_m, angle_rad), {});
  }
  if (family.arcade_m > 0.0 && angle_rad > 0.0) {
    // A pier where two arcades meet.
    const double front = -family.half_depth_m();
    part.solid().fill({{-0.5 * kCornerPier_m, front, family.plinth_m},
                       {0.5 * kCornerPier_m, front + kCornerPier_m, family.floor_m(1)}},
                      kGroundWall);
  }
  const double angle_deg = angle_rad * 180.0 / std::numbers::pi;
  return part.finish(fmt::format("{}_corner_{}{}", family.name, angle_deg > 0 ? "left" : "right",
                                 fmt::format("{:.6g}", std::abs(angle_deg))),
                     {.part_class = PartClass::kCorner,
                      .angle_rad = angle_rad,
                      .left_m = arm_m,
                      .right_m = arm_m});
}

Part make_tee(const RowStyle& style, const RowFamily& family, StemSide side, double margin_m) {
  const double sign = side == StemSide::kBack ? 1.0 : -1.0;
  const double arm_m = up_to_quantum(family.half_width_m() + margin_m);
  const double half_m = family.half_depth_m();
  RowPart part(style, family);
  part.add_tee_body(arm_m, sign);
  part.dress(straight_wall(family, -arm_m, arm_m, side == StemSide::kBack), {});
  const double beside_m = arm_m - half_m;
  for (const double x0 : {-arm_m, half_m})
    part.dress(straight_wall(family, x0, x0 + beside_m, side == StemSide::kFront), {});
  for (const double x_sign : {-1.0, 1.0}) {
    // The front of the wing is on the right of who walks outwards.
    const bool is_front = x_sign == sign;
    part.dress({.is_across = true,
                .plane = x_sign * half_m,
                .sign = x_sign,
                .length_m = beside_m,
                .along = [=](double s) { return sign * (half_m + s); },
                .is_front = is_front,
                .ground_recess_m = is_front ? family.arcade_m : 0.0},
               {});
  }
  return part.finish(fmt::format("{}_tee_{}_{}", family.name, name_of(side), length_name(arm_m)),
                     {.part_class = PartClass::kTee,
                      .stem_side = side,
                      .left_m = arm_m,
                      .right_m = arm_m,
                      .stem_m = arm_m});
}

/// From the section of `from` to that of `to`, with a step in the middle.
Part make_transition(const RowStyle& style, const RowFamily& from, const RowFamily& to) {
  const double step_m = 0.5 * kTransitionLength_m;
  const bool is_up = from.top_m() < to.top_m();
  RowPart part(style, is_up ? to : from);
  part.add_body(from, 0.0, step_m + (is_up ? kTransitionOverlap_m : 0.0), false, false);
  part.add_body(to, step_m - (is_up ? 0.0 : kTransitionOverlap_m), kTransitionLength_m, false,
                false);
  return part.finish(
      fmt::format("{}_to_{}_{}", from.name, to.name, length_name(kTransitionLength_m)),
      {.part_class = PartClass::kMiddle, .right_m = kTransitionLength_m});
}

}  // namespace

double up_to_quantum(double length_m) {
  // A length that is a multiple but for its rounding stays.
  const double count = std::ceil(length_m / kLengthQuantum_m - kQuantumTolerance);
  return std::round(count * kLengthQuantum_m * 10.0) / 10.0;
}

std::vector<Part> make_row_corners(const KitPlan& plan, double angle_rad) {
  std::vector<Part> out;
  for (const RowFamily& family : plan.style.families)
    out.push_back(make_corner(plan.style, family, angle_rad));
  return out;
}

std::vector<Part> make_rows(const KitPlan& plan) {
  const RowStyle& style = plan.style;
  std::vector<Part> out;
  for (const RowFamily& family : style.families) {
    for (const PartClass end : {PartClass::kLeftEnd, PartClass::kRightEnd}) {
      for (const MiddlePlan& length : plan.ends)
        out.push_back(make_end(style, family, length, end));
    }
    for (const MiddlePlan& middle : plan.middles) out.push_back(make_middle(style, family, middle));
    for (const double angle_deg : plan.corner_angles_deg) {
      for (const double turn : {1.0, -1.0})
        out.push_back(make_corner(style, family, turn * angle_deg * std::numbers::pi / 180.0));
    }
    for (const double margin_m : plan.tee_margins_m) {
      for (const StemSide side : {StemSide::kBack, StemSide::kFront})
        out.push_back(make_tee(style, family, side, margin_m));
    }
  }
  for (const RowFamily& from : style.families) {
    for (const RowFamily& to : style.families) {
      if (&from != &to) out.push_back(make_transition(style, from, to));
    }
  }
  return out;
}

}  // namespace plat::buildings::detail
