#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "buildings/part_database.h"

/// Generated parts: **synthetic**, in place of the thesis' parts, which were cut from models of a
/// 3D warehouse and are not public. Deterministic: same kit, same bytes.
namespace plat::buildings {

struct KitSummary {
  std::string_view name;
  std::string_view summary;
};

/// "townhouse", "palazzo" (rows of parts), "tower" (floors).
std::vector<KitSummary> part_kits();

/// @throws InputError where there is no such kit
PartDatabase make_part_kit(std::string_view kit);

/// Corner parts of a kit for any turn in the skeleton, one or more per section family, with their
/// arms as short as the mitre allows, to the next quantum.
/// @param angle_rad  as in PartShape; between kMinCornerTurn_rad and kMaxCornerTurn_rad in size
/// @throws InputError where there is no such kit, or the angle is out of range
std::vector<Part> make_corner_parts(std::string_view kit, double angle_rad);

/// Below, a row bends without a corner part; above, the mitre gets longer than a house.
inline constexpr double kMinCornerTurn_rad = 0.02;
inline constexpr double kMaxCornerTurn_rad = 2.7;

}  // namespace plat::buildings
