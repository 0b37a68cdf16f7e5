#pragma once

#include <cstdint>
#include <vector>

#include "core/failure.h"
#include "core/polygon.h"

namespace plat::parcels {

/// The straight skeleton of a polygon with holes [AAAG95, used by VKW12, Sec. 4.2.1].
///
/// Contour edges are numbered through all rings: outer edge i from vertex i to i + 1, then the
/// holes'.
struct StraightSkeleton {
  struct Node {
    Point position;  ///< not on the grid
    double time_m =
        0.0;  ///< distance to the contour edges it is equidistant to; 0 for contour vertices
  };
  struct Arc {
    std::uint32_t lower = 0;  ///< node index; time of lower <= time of upper
    std::uint32_t upper = 0;
    std::uint32_t faces[2] = {0, 0};  ///< the contour edges whose faces it separates
  };
  std::vector<Node> nodes;  ///< the contour's vertices first, in their order
  std::vector<Arc> arcs;
  std::vector<Ring> faces;  ///< per contour edge, counter-clockwise, starting with the edge
};

/// What a skeleton may cost. Events are counted, so that the same polygon ends the same way on
/// every machine; the clock is a guard against hangs inside CGAL between two events.
struct SkeletonLimits {
  std::size_t max_vertices = 500;
  std::size_t max_events = 4'000'000;
  double max_seconds = 20.0;
};

/// Gated: the polygon must pass find_defect(); checked: one face per contour edge, face areas sum
/// to the polygon's. Computed about the polygon's centre (CGAL, EPICK), where nodes are accurate to
/// 1e-13 m.
/// @returns Failure kNotSimple / kBadHole, kTooManyVertices, kTimeLimit, or kNoSkeleton; never a
/// crash, a hang or null Complexity: O(n^2) typically, O(n^2 log n) at worst.
Expected<StraightSkeleton> straight_skeleton(const Polygon& polygon,
                                             const SkeletonLimits& limits = {});

}  // namespace plat::parcels
