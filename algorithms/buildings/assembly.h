#pragma once

#include <cstddef>

#include "buildings/mesh.h"
#include "buildings/part_database.h"
#include "buildings/placement.h"

namespace plat::buildings {

/// The parts of a building as one surface.
struct AssembledBuilding {
  Mesh mesh;
  double wall_area_m2 = 0.0;  ///< of the walls where the sections of neighbours disagree
};

/// Makes one mesh of the placed parts: where two meet, their caps go, their rims are welded, and
/// where only one has a section a wall closes it.
///
/// Guarantees: 1. where the parts are closed (find_defect), so is the building: inspect_surface()
/// finds no unmatched edge;  2. the walls' area is what the solution costs [Har, Eq. 6.1], as far
/// as the crossings of outlines lie on the working grid.
AssembledBuilding assemble(const PlacedBuilding& building, const PartDatabase& database);

/// What a surface is like, edge by edge.
struct SurfaceReport {
  std::size_t face_count = 0;
  std::size_t shell_count = 0;           ///< groups of faces that hang together by edges
  std::size_t unmatched_edge_count = 0;  ///< not used as often in one direction as in the other
  std::size_t shared_edge_count = 0;  ///< used more than once in each direction: shells that touch
  double volume_m3 = 0.0;

  [[nodiscard]] bool is_watertight() const { return unmatched_edge_count == 0 && volume_m3 > 0.0; }
};
SurfaceReport inspect_surface(const Mesh& mesh);

}  // namespace plat::buildings
