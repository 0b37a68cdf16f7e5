#pragma once

#include <optional>
#include <string>

#include "buildings/assembly.h"
#include "buildings/building_design.h"
#include "buildings/building_problem.h"
#include "buildings/placement.h"
#include "sequences/compiled_problem.h"

namespace plat::buildings {

/// A design and a database, ready for a search.
struct PreparedBuilding {
  PartDatabase database;             ///< with the corners that the design needs
  BuildingSkeleton skeleton;         ///< empty for a tower
  std::optional<SkeletonPlan> plan;  ///< none for a tower
  BuildingProblem problem;
  sequences::CompiledProblem compiled;
};

/// @throws InputError where the design is no building, or the database has no parts for it
PreparedBuilding prepare(const BuildingDesign& design, const PartDatabase& database);

/// A solution, built.
struct Building {
  sequences::Arrangement arrangement;
  /// By place; of a tower, one row of floors from the ground up.
  sequences::ArrangementByPart by_place;
  PlacedBuilding placed;
  AssembledBuilding assembled;
};

Building realise(const PreparedBuilding& prepared, const sequences::SequencePath& path);

/// What was built, as JSON (docs/building_design.md): cost, resources, the parts of every row and
/// key point, how far rows were from the quantum, where parts meet, whether the mesh is closed.
std::string report_of(const PreparedBuilding& prepared, const Building& building,
                      const std::string& name);

}  // namespace plat::buildings
