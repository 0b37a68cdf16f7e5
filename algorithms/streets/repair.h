#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/point.h"

namespace plat::streets {

/// What was repaired or refused on the way from a file to a network. Appended, never renumbered.
enum class RepairKind : int {
  kNotFinite = 1,   ///< refused: a coordinate is not a number or out of the grid's extent
  kZeroLength = 2,  ///< removed: nothing is left on the working grid
  kDuplicate = 3,   ///< removed: the whole street runs along others
  kOverlap = 4,     ///< removed: the part that runs along another street
  kSnappedEnd = 5,  ///< moved: an end that nearly touched another street
  kRejoined = 6,    ///< joined with its continuation, e.g. a way cut at a tile border
  kOvershoot = 7,   ///< removed: a stub that overran a crossing by less than the snapping distance
  kBadValue = 8,    ///< ignored: a width, lane count or level that cannot be one
  kNotUsed = 9,     ///< left out: not a line, or not of a class that is wanted
};
std::string_view repair_name(RepairKind kind);

/// One row of the repairs layer.
struct Repair {
  std::string feature_id;
  RepairKind kind;
  Point place;
  std::string detail;  ///< one line, with the numbers that a reader needs
};

/// "repairs: 12 (3 duplicate, 9 snapped_end)"; "repairs: none".
std::string summary(std::span<const Repair> repairs);

}  // namespace plat::streets
