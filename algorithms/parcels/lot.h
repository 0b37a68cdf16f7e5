#pragma once

#include <cstdint>
#include <vector>

#include "blocks/block.h"
#include "core/oriented_box.h"
#include "core/point.h"

namespace plat::parcels {

/// A corner of a lot and what the edge that leaves it faces.
struct LotVertex {
  Point position;
  bool is_street = false;          ///< the edge to the next vertex fronts a street
  bool is_contour_vertex = false;  ///< a vertex of the block's contour, not the end of a cut
};

/// A piece of a block while it is being divided: outer ring counter-clockwise, then holes
/// clockwise.
struct Lot {
  std::vector<std::vector<LotVertex>> rings;
};

Lot lot_of(const blocks::Block& block);

Polygon polygon_of(const Lot& lot);
double area_m2(const Lot& lot);
/// Length of the lot's boundary that fronts streets, metres.
double frontage_m(const Lot& lot);
OrientedBox minimum_area_box(const Lot& lot);

/// The extent of the lot along its front: the side of its box nearest in direction to its longest
/// street edge; the shorter side where it has none ("the width of the front side", [VKW12,
/// Sec. 4.3]).
double front_width_m(const Lot& lot, const OrientedBox& box);

/// A line through `pivot` along the unit vector `direction`.
struct SplitLine {
  Point pivot;
  Point direction;
};

struct SplitResult {
  std::vector<Lot>
      lots;  ///< left of the line first, each side in the order along it; one lot if it is not cut
  std::vector<Segment> cuts;  ///< the parts of the line inside the lot, ends on the working grid
};

/// Cuts a lot along a line. Vertices on the line count as left of it, which makes every crossing a
/// proper one; one that touches the line from the left counts as right. Lots that only meet in a
/// point are two. The lots guide the recursion only; the parcels themselves come from
/// BlockPartition over the cuts, so that a rounding of the ends cannot open a gap. Complexity: O(n
/// log n + c log c) for c crossings.
SplitResult split(const Lot& lot, const SplitLine& line);

}  // namespace plat::parcels
