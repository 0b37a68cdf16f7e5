#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "streets/intersection_point.h"

namespace plat::growth {

/// What intersection points know of their streets, one ablation each.
enum class Attribute : std::uint8_t {
  kHierarchy,
  kTortuosity,
  kDistance,   ///< the mean between intersections
  kAngle,      ///< the mean between segments
  kVariances,  ///< of distance and angle
  kWidth,
  kConnections,
};
std::string_view attribute_name(Attribute attribute);
std::span<const Attribute> all_attributes();

/// The points with the same value of an attribute everywhere: its mean over all streets of all
/// points, levels 0, connections the rounded mean. What it said of a single street is gone.
std::vector<streets::IntersectionPoint> flattened(std::vector<streets::IntersectionPoint> points,
                                                  Attribute attribute);

}  // namespace plat::growth
