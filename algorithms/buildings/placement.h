#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "buildings/building_problem.h"
#include "buildings/part_database.h"
#include "buildings/skeleton_plan.h"
#include "sequences/compiled_problem.h"

namespace plat::buildings {

/// A place where a port lands: its plane, `outward` as the part sees it.
struct PortTarget {
  Point3 origin;
  Point3 outward;
};

/// A part and where each of its ports goes.
struct PlacedPart {
  std::size_t part = 0;             ///< index into the database
  std::vector<PortTarget> targets;  ///< by port
  /// Where its key point goes, of a part with one port: the end of a row.
  std::optional<PortTarget> key_target;
};

/// A port of a placed part.
struct PlacedPort {
  std::size_t placed = 0;  ///< index into PlacedBuilding::parts
  std::size_t port = 0;
};

/// Two ports that meet; a joint without a second one is a side that meets nothing.
struct Joint {
  CutPlane plane;  ///< outward: the walking direction; its coordinates are those of the sections
  PlacedPort before;
  std::optional<PlacedPort> after;
};

/// The parts of a solution at their places.
struct PlacedBuilding {
  std::vector<PlacedPart> parts;  ///< rows in the plan's order, key points first
  std::vector<Joint> joints;
};

/// Puts the parts of an arrangement along the skeleton [Har, Sec. 6.3].
///
/// Guarantees: 1. a part at a key point has it at the node, the ports on the skeleton's lines;
/// 2. the planes of two ports that meet are the same, across the row;  3. the parts of a row fill
/// it: each is as long as its arms and lengths times the row's RowRounding::factor.
/// Deviation: the skeleton stays as it is, and parts are stretched by what rounding to the quantum
///            took from their edge; so closed skeletons close (ADR 0022)
PlacedBuilding place(const BuildingProblem& problem, const SkeletonPlan& plan,
                     const PartDatabase& database, const sequences::ArrangementByPart& arrangement);

/// Floors upon each other from z = 0, in the order of the arrangement.
PlacedBuilding stack(const BuildingProblem& problem, const PartDatabase& database,
                     const std::vector<sequences::ElementIndex>& floors);

/// The vertices of a part whose ports lie on their targets: each vertex is moved as the ports near
/// it are. Where the targets are those of a rigid motion, this is that motion.
std::vector<Point3> fitted_vertices(const Part& part, const PlacedPart& placed);

}  // namespace plat::buildings
