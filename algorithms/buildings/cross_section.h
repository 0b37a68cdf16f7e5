#pragma once

#include <vector>

#include "buildings/mesh.h"
#include "core/polygon.h"

namespace plat::buildings {

/// Where a part is cut: the outline of its solid in the cut plane, on the working grid, in the
/// plane's own coordinates (Point::x lateral, Point::y up; see part.h).
///
/// Canonical: regions in the order of their lowest vertex, every ring starting at its lowest
/// vertex, no collinear vertices; equal sections are equal values.
struct CrossSection {
  std::vector<Polygon> regions;

  friend bool operator==(const CrossSection&, const CrossSection&) = default;
};

/// A plane with coordinates: a point p has the coordinates (dot(p - origin, across), dot(p -
/// origin, up)), and lies `dot(p - origin, outward)` before it. Three orthogonal unit vectors.
struct CutPlane {
  Point3 origin;
  Point3 across;
  Point3 up;
  Point3 outward;
};

double area_m2(const CrossSection& section);

/// The section of the part seen from the other side: lateral becomes -lateral.
CrossSection mirrored(const CrossSection& section);

/// The area that is in one section and not in the other, m2.
/// Paper: [Har, Eq. 6.1].
double disagreement_m2(const CrossSection& a, const CrossSection& b);

/// The faces of `mesh` that lie in the plane and look outwards (within kCapTolerance_m of it):
/// indices into Mesh::faces.
std::vector<std::size_t> cap_faces(const Mesh& mesh, const CutPlane& plane);

/// The outline of those faces, found from the edges that one of them has alone: exact, whatever the
/// triangulation. Empty where there are none.
CrossSection cap_section(const Mesh& mesh, const CutPlane& plane);

/// The outline of the slice kSliceDepth_m before the plane: for meshes that are open at their
/// ports. Empty where the mesh does not reach the plane.
/// @throws InputError where the slice is not made of closed curves
CrossSection slice_section(const Mesh& mesh, const CutPlane& plane);

/// A vertex this near to a cut plane lies in it: half a step of the working grid.
inline constexpr double kCapTolerance_m = 0.5 / 1024.0;
/// How far inside its port an open mesh is sliced: past the rounding of the vertices of its rim.
inline constexpr double kSliceDepth_m = 2.0 / 1024.0;

}  // namespace plat::buildings
