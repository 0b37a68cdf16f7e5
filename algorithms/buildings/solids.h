#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "buildings/cell_solid.h"
#include "buildings/mesh.h"
#include "core/point.h"

/// Closed solids that are added to a mesh, each its own component. Every one is closed, 2-manifold
/// and looks outwards.
namespace plat::buildings {

void add_box(Mesh& mesh, const Box3& box, std::uint32_t material);

/// Rings of as many points each, from the lowest to the highest, counter-clockwise seen from above,
/// joined by bands of the material given for each; flat and convex at both
/// ends.
/// @param band_materials  one less than rings
void add_loft(Mesh& mesh, std::span<const std::vector<Point3>> rings,
              std::span<const std::uint32_t> band_materials, std::uint32_t cap_material);

/// A counter-clockwise ring of the plane, convex, raised from `low_m` to `high_m`.
void add_prism(Mesh& mesh, std::span<const Point> ring, double low_m, double high_m,
               std::uint32_t material);

/// A round column as a prism of `sides` sides.
void add_column(Mesh& mesh, Point at, double radius_m, double low_m, double high_m, int sides,
                std::uint32_t material);

/// A prism whose axis lies: the triangle or other profile in (along `across`, z) at `from`, pushed
/// to `to`. The profile is counter-clockwise with `across` to the right and `to - from` away from
/// the viewer's back, that is across x up looks along from - to.
void add_lying_prism(Mesh& mesh, std::span<const Point> profile, Point3 from, Point3 to,
                     Point3 across, std::uint32_t material);

}  // namespace plat::buildings
