#pragma once

#include <optional>
#include <string_view>

namespace plat::streets {

/// What a class name means for land, whichever source it comes from.
struct ClassRule {
  double width_m = 0.0;        ///< between the plots on both sides
  bool bounds_blocks = false;  ///< whether plots on both sides belong to different blocks
};

/// The rule for OpenStreetMap `highway` values, Mapbox street classes and Cambridge's MajorRoad (as
/// "major_1", "major_2", "local"); nullopt for a class that is not in the table. Widths are those
/// of a usual street of the class between plots, carriageway and pavements together: a table is the
/// last resort before one default width.
std::optional<ClassRule> class_rule(std::string_view street_class);

/// Which streets bound blocks.
enum class BoundingClasses {
  kStreets,  ///< those of the table that carry cars; unknown classes count as streets
  kAll,      ///< every street
};

bool bounds_blocks(std::string_view street_class, BoundingClasses classes);

}  // namespace plat::streets
