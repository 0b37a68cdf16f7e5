#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/polygon.h"

namespace plat::similarity {

/// What an edge of a shape is.
enum class EdgeLabel : std::uint8_t {
  kUnknown,   ///< compatible with every label
  kStreet,    ///< along a street
  kProperty,  ///< between two tiles, no street between them
};

/// A shape under comparison: a tile, a block, a fragment's outline.
///
/// Invariants: `polygon` is valid (find_ogc_defect) with an area; `edges` is empty, where nothing
/// is known, or has one label per edge of the outer ring, edge i running from vertex i to i + 1.
struct LabelledShape {
  Polygon polygon;
  std::vector<EdgeLabel> edges;
  std::string zone;  ///< zone or land use; empty where unknown
};

}  // namespace plat::similarity
