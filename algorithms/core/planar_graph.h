#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/polygon.h"

namespace plat {

/// Straight segments noded on the working grid: they meet at nodes only, and no node lies on
/// another segment.
struct PlanarGraph {
  /// `source` is the lowest index among the input segments that run along this edge.
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t source = 0;
  };
  /// Another input segment that runs along an edge which already has a source.
  struct Overlap {
    std::uint32_t edge = 0;
    std::uint32_t source = 0;
  };

  std::vector<Point> nodes;       ///< sorted, on the working grid
  std::vector<Edge> edges;        ///< sorted by (min node, max node); from -> to as the source runs
  std::vector<Overlap> overlaps;  ///< sorted
};

/// Nodes the segments on the working grid: every crossing and every touching end becomes a node.
///
/// Method: snap rounding (Hobby 1999, Guibas and Marimont 1998) iterated to its fixed point
/// (Halperin and Packer 2002). Each end and each crossing, rounded, makes its grid cell "hot"; each
/// segment is bent through the hot cells it meets. All decisions are made in 64-bit integers with
/// 128-bit products.
///
/// Guarantees: 1. the result is planar, exactly;  2. nodes lie on the grid;  3. no edge has zero
/// length or occurs twice;
/// 4. the result does not depend on the order of the segments, but for `source`;  5. every input
/// end is a node. Pre: finite coordinates within kGridExtent_m. Complexity: O(n log n + k) for k
/// crossings of segments of similar length.
PlanarGraph node_segments(std::span<const Segment> segments);

/// Whether noding the polygon's edges leaves them as they are: no vertex comes within half a grid
/// step of an edge that is not its own, so that the polygon stays itself when cuts are noded with
/// it. Pre: admitted (validity.h).
bool is_noded(const Polygon& polygon);

/// Half-edge 2e runs from edges[e].from to .to, 2e+1 back.
using HalfEdge = std::uint32_t;
constexpr HalfEdge twin(HalfEdge h) { return h ^ 1U; }
constexpr std::uint32_t edge_of(HalfEdge h) { return h >> 1U; }

inline std::uint32_t origin(const PlanarGraph& g, HalfEdge h) {
  const PlanarGraph::Edge& e = g.edges[edge_of(h)];
  return (h & 1U) == 0U ? e.from : e.to;
}
inline std::uint32_t target(const PlanarGraph& g, HalfEdge h) { return origin(g, twin(h)); }

}  // namespace plat
