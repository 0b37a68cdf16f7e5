#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "buildings/building_skeleton.h"
#include "buildings/part.h"

namespace plat::buildings {

/// A key point of a skeleton: what its edges ask of the part that stands there.
struct SkeletonKeyPoint {
  enum class Kind {
    kLeftEnd,   ///< one edge, whose row begins here
    kRightEnd,  ///< one edge, whose row ends here
    kCorner,    ///< two edges that meet at an angle
    kCut,       ///< two edges in one line, each with bounds of its own: two parts meet here
    kTee,       ///< three edges
  };
  std::uint32_t node = 0;  ///< index into BuildingSkeleton::nodes
  Kind kind = Kind::kCorner;
  double turn_rad =
      0.0;  ///< of corners and cuts, from the row that comes in to the one that leaves
  StemSide stem_side = StemSide::kBack;    ///< of tees
  std::optional<std::uint32_t> left_row;   ///< index of the row that ends here, at the left port
  std::optional<std::uint32_t> right_row;  ///< of the row that begins here, at the right port
  std::optional<std::uint32_t> stem_row;   ///< of the row at the stem of a tee
};

/// The parts between two key points, in the direction in which the front is on the right: from the
/// left to the right as seen from the front.
struct SkeletonRow {
  std::uint32_t from = 0;  ///< index into SkeletonPlan::key_points
  std::uint32_t to = 0;
  PortRole from_port = PortRole::kRight;  ///< the port of the part at `from` that faces the row
  PortRole to_port = PortRole::kLeft;
  Point start;  ///< of its key points
  Point end;
  std::vector<std::uint32_t> edges;    ///< of the skeleton, in the row's direction
  std::vector<AttributeBound> bounds;  ///< of those edges
};

/// A skeleton, read: its key points by degree and geometry [Har, Sec. 6.3], its rows by front.
struct SkeletonPlan {
  std::vector<SkeletonKeyPoint> key_points;  ///< by node
  std::vector<SkeletonRow> rows;             ///< by their first edge
};

double length_m(const SkeletonRow& row);
/// The unit vector along the row.
Point direction(const SkeletonRow& row);

/// Reads a skeleton.
///
/// Where a node lies within kStraightDeviation_m of the line between its neighbours, the fronts are
/// on one side, and neither edge has bounds of its own, the two edges are one row and a part may
/// stand across; where an edge has bounds and the turn is less than kMinCornerTurn_rad, the node is
/// a cut.
///
/// Guarantees: 1. every edge is in one row;  2. the front is on the right of every row;  3. a key
/// point with two edges has one row that ends there and one that begins there.
/// @throws InputError naming the node or edge: an index out of range, an edge without length or
///         twice, a node without or with more than three edges, edges that cross, two parts that do
///         not hang together, fronts that change sides at a node, a turn that no corner makes,
///         three edges that are no T
/// Complexity: O(n^2) for n edges
SkeletonPlan plan_of(const BuildingSkeleton& skeleton);

/// Half a quantum of length: what rounding an edge to the quantum moves anyway.
inline constexpr double kStraightDeviation_m = 0.5 * kLengthQuantum_m;
/// How far a turn may be from what a part makes: its ports are bent by as much (ADR 0022). Beyond
/// two degrees one sees it.
inline constexpr double kAngleTolerance_rad = 0.035;

}  // namespace plat::buildings
