#pragma once

#include <vector>

#include "blocks/block.h"
#include "blocks/blocks_from_parcels.h"
#include "blocks/dual_graph.h"
#include "blocks/face_blocks.h"
#include "core/parallel.h"
#include "streets/street_classes.h"
#include "streets/street_network.h"

namespace plat::blocks {

struct ExtractionOptions {
  streets::BoundingClasses bounding = streets::BoundingClasses::kStreets;
  FaceOptions face;
};

struct BlocksOfNetwork {
  std::vector<Block> blocks;           ///< edges labelled; source id empty
  std::vector<DualEdge> dual;          ///< sorted
  std::size_t face_count = 0;          ///< bounded faces of the network
  std::vector<BlockFailure> failures;  ///< feature id: that of a street around the face
};

/// The blocks that a network encloses: its bounded faces, each contour inset by every street's own
/// half width; a dead end inside a block cuts a slit of its width with a flat end. Where a face
/// falls apart it gives several blocks; where nothing is left, a failure row.
///
/// Bridges divide land as streets do, tunnels do not. Where adjacent streets differ in width the
/// contour steps at their node; at a corner that juts into the block the offset lines are extended
/// until they meet, as far as `kMitreLimit` widths.
///
/// Guarantees: 1. contours pass find_defect();  2. an edge of the contour carries the street it was
/// offset from, its width and the source of that;  3. the order is that of the faces, whatever the
/// thread count. Pre: every street has a width (streets::assign_widths).
/// Complexity: O(n log n) for faces; faces without dead ends, islands and narrow places take one
/// pass over their edges, the others a polygon difference.
BlocksOfNetwork extract_blocks(const streets::StreetNetwork& network,
                               const ExtractionOptions& options = {}, Jobs jobs = {});

}  // namespace plat::blocks
