#pragma once

#include <span>

#include "synthesis/point_set.h"

namespace plat::synthesis {

/// The points of several sets side by side, as pieces of a puzzle.
///
/// Where points of different sets are closer than the spacing, those of the earlier set stay.
///
/// Guarantees: 1. the first set is kept whole;  2. attributes are unchanged, sets and points stay
/// in their order;  3. points of different sets keep the spacing;  4. points of one set are never
/// compared: a crossing of several streets stays.
/// Complexity: O(n log n)
/// Paper: [AVB08, Sec. 4.2, "join"]
PointSet join(std::span<const PointSet> sets, const Spacing& spacing = {});

}  // namespace plat::synthesis
