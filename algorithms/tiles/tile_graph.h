#pragma once

#include <cstdint>
#include <vector>

#include "core/point.h"
#include "tiles/tile_layout.h"

namespace plat::tiles {

enum class JointKind : std::uint8_t {
  kProperty,  ///< tiles that touch: a gap or an overlap is an error
  kStreet,    ///< tiles across a street: it may become wider or narrower
};

/// An edge of the graph: two tiles that should meet in a point, which each has in its rest frame
/// [ABVA08, Sec. 4.1].
struct Joint {
  std::uint32_t a = 0;
  Point rest_a;
  std::uint32_t b = 0;
  Point rest_b;
  JointKind kind = JointKind::kProperty;
  double weight = 1.0;  ///< times that of its kind, >= 0
};

/// A node of the graph.
struct TileNode {
  Point centroid;         ///< of the tile at rest
  double radius_m = 1;    ///< root mean square distance of its corners from the centroid, > 0
  double rigidity = 1.0;  ///< times that of the solver, >= 0
};

/// What the constraint solver sees of a layout. A vertex that n tiles share is n (n - 1) / 2
/// joints, as the sum (1) of the paper has it.
struct TileGraph {
  std::vector<TileNode> tiles;
  std::vector<Joint> joints;
};

/// The graph of a layout: joint vertices and street links.
TileGraph graph_of(const TileLayout& layout);

}  // namespace plat::tiles
