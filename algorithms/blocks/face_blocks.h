#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blocks/block.h"
#include "core/failure.h"
#include "core/polygon.h"
#include "streets/street_network.h"

namespace plat::blocks {

/// What is cut out of a face that has dead ends.
enum class DeadEndCut {
  kAllStreets,  ///< every street around the face, as where it has islands or narrow places
  kDeadEnds,    ///< dead ends only, out of the contour without them: several times faster; corners
                ///< differ by what simplification moves
};

/// How a face of the street network becomes blocks.
struct FaceOptions {
  DeadEndCut dead_ends = DeadEndCut::kAllStreets;
  double min_area_m2 = 20.0;         ///< a smaller block is a failure row: traffic islands, slivers
  double simplify_m = 0.02;          ///< how far a contour that had to be cut may move
  std::size_t max_vertices = 20000;  ///< of one block
};

/// A straight piece of a street on a face's boundary, the face on its left.
struct StreetSide {
  Segment segment;
  double half_width_m = 0.0;
  std::uint32_t street = 0;  ///< index in the network
};

/// A bounded face of the street network. A dead end is walked on both sides.
struct FaceBoundary {
  std::vector<StreetSide> outer;                 ///< counter-clockwise
  std::vector<std::vector<StreetSide>> islands;  ///< what lies inside, clockwise
};

/// A part of a face that is no usable block.
struct RefusedRegion {
  Failure failure;
  Polygon shape;
};

struct FaceBlocks {
  std::vector<Block> blocks;  ///< edges labelled; ids and source ids empty
  std::vector<RefusedRegion> refused;
};

/// The blocks of one face: its contour inset by every street's own half width, as extract_blocks()
/// does for all faces.
///
/// Guarantees: 1. the same boundary gives the same blocks, whatever else the network holds: a city
/// under edit recomputes the faces that changed and no others;  2. at least one block or one
/// refusal. Pre: every street of the boundary has a width.
FaceBlocks blocks_of_face(const FaceBoundary& boundary, const streets::StreetNetwork& network,
                          const FaceOptions& options = {});

}  // namespace plat::blocks
