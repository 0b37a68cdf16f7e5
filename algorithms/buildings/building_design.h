#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "buildings/building_problem.h"
#include "buildings/building_skeleton.h"
#include "core/polygon.h"

namespace plat::buildings {

/// A building along the contour of a block, moved inwards [Har, Sec. 6.3, Fig. 6.10].
struct ContourDesign {
  Ring contour;            ///< the block, counter-clockwise, metres
  double offset_m = 15.0;  ///< from the contour to the axis of the building
  /// Shorter sides of the offset contour go: a corner part would not fit in.
  double min_edge_m = 16.0;
  std::vector<AttributeBound> bounds;  ///< of the whole building

  friend bool operator==(const ContourDesign&, const ContourDesign&) = default;
};

/// What a building shall be like.
struct BuildingDesign {
  std::string name;
  std::variant<BuildingSkeleton, TowerDesign, ContourDesign> shape;
  AttributeSteps steps;
  Preferences preferences;

  friend bool operator==(const BuildingDesign&, const BuildingDesign&) = default;
};

/// Reads a design (docs/building_design.md).
/// @throws InputError with the file, the key and what is allowed there
BuildingDesign read_building_design(const std::filesystem::path& file);

/// The skeleton of a building around a courtyard: the contour moved inwards by blocks_of_face(),
/// short sides and turns of less than a corner taken out, fronts towards the street.
/// @throws InputError where nothing is left of the contour, or it falls apart
/// Paper: [Har, Sec. 6.3, Fig. 6.10]
BuildingSkeleton skeleton_of(const ContourDesign& design);

}  // namespace plat::buildings
