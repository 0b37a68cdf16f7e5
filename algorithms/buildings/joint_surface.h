#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/point.h"

namespace plat::buildings {

/// What closes the place where two parts meet, in the coordinates of its plane.
struct JointSurface {
  struct Wall {
    std::array<Point, 3> corners;  ///< counter-clockwise as seen by who walks back: from outside
    bool is_outward = true;        ///< looks in the walking direction; else against it
  };
  /// By rim edge: its points from its start to its end, those of other rims between them.
  std::vector<std::vector<Point>> chains;
  std::vector<Wall> walls;
};

/// The walls between two parts whose caps were taken away: where one has a section and the other
/// has not [Har, Eq. 6.1].
///
/// @param rim  the edges where both are open, on the working grid, in the direction in which the
///             faces that remain walk them
///
/// Guarantees: 1. faces with their rim edges replaced by chains, and the walls, use every edge as
/// often in one direction as in the other;  2. the area of the walls is that of the sections'
/// disagreement, as far as crossings lie on the grid;  3. equal sections get no wall.
JointSurface joint_surface(std::span<const Segment> rim);

}  // namespace plat::buildings
