#include "imagery/roofs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/oriented_box.h"
#include "core/validity.h"
#include "parcels/straight_skeleton.h"

namespace plat::imagery {
namespace {

constexpr double kPitch_rad = 33.0 * std::numbers::pi / 180.0;
/// The share of light that comes from the sky, from everywhere.
constexpr double kSky_01 = 0.42;
/// A roof over a wider house would be higher than the house.
constexpr double kWidestPitched_m = 17.0;
constexpr std::size_t kMostVertices = 120;
constexpr double kParapet_m = 0.45;

/// One slope of a roof and the edge of the eaves that it falls to.
struct Facet {
  Ring ring;
  Point downhill;
};

/// A ridge between the middles of the short sides.
std::vector<Facet> gable(const OrientedBox& box) {
  const Point u = box.axis;
  const Point v = perpendicular(u);
  const double l = box.length_m / 2.0;
  const double w = box.width_m / 4.0;
  return {{rectangle(box.center - w * v, u, l, w), -v},
          {rectangle(box.center + w * v, u, l, w), v}};
}

/// Slopes of equal pitch from all eaves.
std::vector<Facet> hips(const Polygon& shape) {
  std::vector<Facet> out;
  const Expected<Polygon> admitted = admit_polygon(shape, kMostVertices);
  if (!admitted) return out;
  const Expected<parcels::StraightSkeleton> skeleton = parcels::straight_skeleton(*admitted);
  if (!skeleton) return out;
  for (const Ring& face : skeleton->faces) {
    const Point edge = normalized(face[1] - face[0]);
    out.push_back({face, -perpendicular(edge)});
  }
  return out;
}

bool is_box(const Polygon& shape, const OrientedBox& box) {
  return shape.holes.empty() && area_m2(shape) > 0.93 * box.area_m2();
}

bool is_pitched(const Polygon& shape, const OrientedBox& box, const PictureStyle& style, Rng& rng) {
  const double chance = rng.uniform_01();
  // What counts is how deep the house is, not how far its wings reach.
  const double depth = 2.0 * area_m2(shape) / perimeter_m(shape);
  if (2.0 * depth > kWidestPitched_m || std::min(box.width_m, 2.0 * depth) < 2.0) return false;
  if (style.roofs == RoofStyle::kClay) return chance < 0.88;
  return area_m2(shape) < 260.0 ? chance < 0.82 : chance < 0.35;
}

void add_box_on_roof(Scene& scene, Point place, Point along, double half_m, Tint tint,
                     double height_m) {
  scene.add(
      region(rectangle(place, along, half_m, 0.8 * half_m), tint, Material::kMetal, height_m));
}

/// Ventilation, stairs and skylights: somewhere well inside.
void add_equipment(Scene& scene, const Polygon& shape, const OrientedBox& box, double height_m,
                   Rng& rng) {
  const double count = std::min(area_m2(shape) / 130.0, 40.0) * rng.uniform(0.5, 1.3);
  for (double i = 0.0; i < count; i += 1.0) {
    const Point place = box.center + rng.uniform(-0.45, 0.45) * box.length_m * box.axis +
                        rng.uniform(-0.45, 0.45) * box.width_m * perpendicular(box.axis);
    const double half = rng.uniform(0.5, 1.0 + std::min(2.0, area_m2(shape) / 900.0));
    const double grey = rng.uniform(0.42, 0.82);
    const double raised = height_m + rng.uniform(0.6, 1.8);
    if (locate(shape, place) != Side::kInside || boundary_distance_m(shape, place) < 1.5 * half)
      continue;
    add_box_on_roof(scene, place, box.axis, half, {grey, grey, 0.99 * grey}, raised);
  }
}

void add_flat(Scene& scene, const Footprint& footprint, const OrientedBox& box,
              const PictureStyle& style, Rng& rng) {
  const Tint tint = flat_roof_tint(rng, style.roofs);
  const Polygon& shape = footprint.shape;
  const double top = footprint.height_m;
  scene.add(region(shape, tint, Material::kFlatRoof, top));
  const auto parapet = [&](Ring ring) {
    ring.push_back(ring.front());
    Shape rim =
        line(std::move(ring), kParapet_m, mix(tint, {0.8, 0.8, 0.78}, 0.45), Material::kConcrete);
    rim.height_m = top + 0.5;
    scene.add(std::move(rim));
  };
  parapet(shape.outer);
  for (const Ring& hole : shape.holes) parapet(hole);
  add_equipment(scene, shape, box, top, rng);
}

}  // namespace

double slope_light(Point downhill, const Sun& sun) {
  const double high = std::sin(sun.elevation_rad);
  const double facing = std::cos(sun.elevation_rad) * dot(downhill, sun.direction());
  const double direct =
      std::max(0.0, std::sin(kPitch_rad) * facing + std::cos(kPitch_rad) * high) / high;
  return kSky_01 + (1.0 - kSky_01) * direct;
}

void add_roof(Scene& scene, const Footprint& footprint, const PictureStyle& style, const Sun& sun,
              Rng& rng) {
  const Polygon& shape = footprint.shape;
  if (shape.outer.size() < 3) return;
  const OrientedBox box = minimum_area_box(shape);
  if (!is_pitched(shape, box, style, rng)) return add_flat(scene, footprint, box, style, rng);
  const bool has_gable = is_box(shape, box) && rng.uniform_01() < 0.7;
  const std::vector<Facet> facets = has_gable ? gable(box) : hips(shape);
  if (facets.empty()) return add_flat(scene, footprint, box, style, rng);
  const Tint tint = pitched_roof_tint(rng, style.roofs);
  const double rise = std::min(0.25 * box.width_m, 4.0) * std::tan(kPitch_rad);
  const double top = footprint.height_m + rise / 2.0;
  // The whole first: between two slopes the ground must not shine through.
  scene.add(region(shape, tint, Material::kPitchedRoof, top));
  for (const Facet& facet : facets) {
    scene.add(region(facet.ring, std::min(slope_light(facet.downhill, sun), 1.0 / tint.red) * tint,
                     Material::kPitchedRoof, top));
  }
  if (rng.uniform_01() < 0.5) {
    const Point along = rng.uniform(-0.3, 0.3) * box.length_m * box.axis;
    add_box_on_roof(scene, box.center + along + 0.1 * box.width_m * perpendicular(box.axis),
                    box.axis, 0.45, {0.45, 0.36, 0.32}, top + 1.2);
  }
}

}  // namespace plat::imagery
