#include "imagery/scene.h"

#include <algorithm>

#include "imagery/map_layers.h"

namespace plat::imagery {
namespace {

Box box_of_shape(const Shape& shape) {
  Box box;
  for (const Ring& ring : shape.rings) box.add(plat::box_of(std::span<const Point>(ring)));
  return box.is_empty() ? box : box.expanded(shape.line_width_m / 2.0);
}

}  // namespace

Box box_of(const MapLayers& layers) {
  Box box;
  for (const streets::Street& street : layers.streets.streets)
    box.add(plat::box_of(std::span<const Point>(street.line)));
  for (const Polygon& polygon : layers.parcels) box.add(plat::box_of(polygon));
  for (const Footprint& footprint : layers.footprints) box.add(plat::box_of(footprint.shape));
  for (const Polygon& polygon : layers.water) box.add(plat::box_of(polygon));
  for (const Polygon& polygon : layers.open_space) box.add(plat::box_of(polygon));
  return box;
}

void Scene::set_ground(Tint tint, Material material) {
  ground_.tint = tint;
  ground_.material = material;
}
void Scene::add(Shape shape) { shapes_.push_back(std::move(shape)); }
void Scene::add(const Tree& tree) { trees_.push_back(tree); }

void Scene::index() {
  std::vector<Box> shape_boxes;
  std::vector<Box> tree_boxes;
  shape_boxes.reserve(shapes_.size());
  tree_boxes.reserve(trees_.size());
  for (const Shape& shape : shapes_) {
    shape_boxes.push_back(box_of_shape(shape));
    highest_m_ = std::max(highest_m_, shape.height_m);
  }
  for (const Tree& tree : trees_) {
    tree_boxes.push_back(Box{tree.place, tree.place}.expanded(tree.radius_m * kCrownReach));
    highest_m_ = std::max(highest_m_, tree.height_m);
  }
  shape_grid_ = BoxGrid(std::move(shape_boxes));
  tree_grid_ = BoxGrid(std::move(tree_boxes));
}

std::vector<std::uint32_t> Scene::shapes_near(const Box& box) const {
  return shape_grid_.near(box);
}
std::vector<std::uint32_t> Scene::trees_near(const Box& box) const { return tree_grid_.near(box); }

double Scene::highest_m(const Box& box) const {
  double highest = 0.0;
  for (const std::uint32_t i : shapes_near(box)) highest = std::max(highest, shapes_[i].height_m);
  for (const std::uint32_t i : trees_near(box)) highest = std::max(highest, trees_[i].height_m);
  return highest;
}

Shape region(const Polygon& polygon, Tint tint, Material material, double height_m) {
  Shape out{{polygon.outer}, 0.0, tint, material, height_m};
  out.rings.insert(out.rings.end(), polygon.holes.begin(), polygon.holes.end());
  return out;
}

Shape region(Ring ring, Tint tint, Material material, double height_m) {
  return {{std::move(ring)}, 0.0, tint, material, height_m};
}

Shape line(Polyline points, double width_m, Tint tint, Material material) {
  return {{std::move(points)}, width_m, tint, material, 0.0};
}

Ring rectangle(Point center, Point along, double half_length_m, double half_width_m) {
  const Point u = half_length_m * along;
  const Point v = half_width_m * perpendicular(along);
  return {center - u - v, center + u - v, center + u + v, center - u + v};
}

}  // namespace plat::imagery
