#pragma once

#include <vector>

#include "buildings/mesh.h"
#include "buildings/part.h"
#include "buildings/solids.h"

namespace plat::testing {

inline buildings::Mesh empty_mesh() {
  buildings::Mesh mesh;
  mesh.materials = {{"grey", {128, 128, 128}}, {"red", {200, 30, 40}}};
  return mesh;
}

inline buildings::Mesh box_mesh(buildings::Point3 low, buildings::Point3 high) {
  buildings::Mesh mesh = empty_mesh();
  add_box(mesh, {low, high}, 0);
  return mesh;
}

/// A row of an L-shaped section, higher at the back, whose mirror image is another one.
inline buildings::Mesh crooked_row(double x0, double x1) {
  buildings::CellSolid solid;
  solid.fill({{x0, -4, 0}, {x1, 4, 3}}, 0);
  solid.fill({{x0, 1, 3}, {x1, 4, 6}}, 1);
  buildings::Mesh mesh = solid.surface([](buildings::Point3 p) { return p; });
  mesh.materials = empty_mesh().materials;
  return mesh;
}

/// Without the faces of which all vertices have x = `x`.
inline buildings::Mesh without_end(buildings::Mesh mesh, double x) {
  std::erase_if(mesh.faces, [&](const buildings::Face& face) {
    return mesh.vertices[face.vertices[0]].x == x && mesh.vertices[face.vertices[1]].x == x &&
           mesh.vertices[face.vertices[2]].x == x;
  });
  return mesh;
}

}  // namespace plat::testing
