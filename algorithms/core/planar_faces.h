#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/planar_graph.h"

namespace plat {

/// A bounded face: its boundary walks, the region on the left of every half-edge. A dead end is
/// walked on both sides.
struct Face {
  std::vector<HalfEdge> outer;  ///< counter-clockwise
  std::vector<std::vector<HalfEdge>>
      islands;  ///< boundary walks of the components inside, clockwise
};

struct PlanarFaces {
  static constexpr std::uint32_t kUnbounded = 0xffffffffU;

  std::vector<Face> faces;             ///< ordered by their lowest half-edge
  std::vector<std::uint32_t> face_of;  ///< per half-edge: index into `faces`, or kUnbounded
};

/// The bounded faces of a noded graph, each component inside a face being an island of it.
/// Complexity: O(n log n), plus O(sqrt n) per component for the nesting.
PlanarFaces find_faces(const PlanarGraph& graph);

/// Whether each edge is a dead end or leads to one only: removing such edges leaves every face's
/// region as it is.
std::vector<bool> find_dead_ends(const PlanarGraph& graph);

/// The graph without the edges marked; nodes stay.
PlanarGraph without_edges(const PlanarGraph& graph, const std::vector<bool>& is_removed);

/// Splits a boundary walk where it visits a node twice and drops parts without area, so that each
/// ring returned is simple: positive area = outer ring, negative = hole touching it in a point.
/// Collinear points are kept.
std::vector<std::vector<HalfEdge>> split_at_repeated_nodes(const PlanarGraph& graph,
                                                           std::span<const HalfEdge> walk);

/// The origins of the half-edges, as a ring.
Ring ring_of(const PlanarGraph& graph, std::span<const HalfEdge> walk);

/// The closed region of a face, its dead ends left out. Where it touches itself in a node, a hole
/// touches the outer ring or another hole there: valid for OGC, and for find_ogc_defect.
Polygon polygon_of(const PlanarGraph& graph, const Face& face);

/// The polygon whose boundary is `walks`, the region on their left; each walk split at repeated
/// nodes.
Polygon polygon_of(const PlanarGraph& graph, std::span<const std::vector<HalfEdge>> walks);

/// The same of walks given as rings, split at repeated points.
Polygon polygon_of_walks(std::span<const Ring> walks);

}  // namespace plat
