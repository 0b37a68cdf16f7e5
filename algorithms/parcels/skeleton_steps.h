#pragma once

#include <span>

#include "blocks/block.h"
#include "parcels/strips.h"
#include "parcels/subdivision_trace.h"

namespace plat::parcels {

/// Shows what a division by skeleton goes through, in the paper's order: faces and arcs of the
/// skeleton, the offset contour, walls, beta-strips, slices [VKW12, fig. 3 to 5]. Faces are those
/// of a whole skeleton only: an offset cuts them off.
void show_steps(const blocks::Block& block, const StripLayout& layout,
                std::span<const Segment> slices, SubdivisionTrace& trace);

}  // namespace plat::parcels
