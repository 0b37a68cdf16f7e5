#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "streets/intersection_point.h"

namespace plat::growth_scaling {

/// How the points of a made town lie: on a jittered grid of 80 m, or scattered as densely.
enum class TownKind { kRegular, kRandom };
std::string_view town_name(TownKind kind);

/// About `points` attributed points, every one a crossing of two streets of two levels: every tenth
/// row and column a main street. A function of its arguments alone.
std::vector<streets::IntersectionPoint> made_town(TownKind kind, std::size_t points,
                                                  std::uint64_t seed);

}  // namespace plat::growth_scaling
