#pragma once

#include "buildings/mesh.h"

namespace plat::buildings {

/// The same surface with fewer triangles: neighbours of one plane and one material become one
/// region, vertices that lie along straight edges of two regions go, and every region is
/// triangulated anew.
///
/// Guarantees: 1. a closed, oriented 2-manifold stays one;  2. no point of the surface moves by
/// more than kSamePlane_m;  3. two meshes with the same outline in a plane have the same vertices
/// on it, however they were made, where their materials meet at the same points. Port tags are kept
/// where all faces of a region have the same.
Mesh merge_faces(const Mesh& mesh);

/// Faces are of one plane where their vertices are this near to it: above the rounding of doubles,
/// far below what a file holds.
inline constexpr double kSamePlane_m = 1e-7;

}  // namespace plat::buildings
