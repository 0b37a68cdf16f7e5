#pragma once

#include <vector>

#include "blocks/block.h"

namespace plat::parcels {

/// A block's contour with fewer vertices and one label per edge, all rings in a row.
struct LabelledContour {
  Polygon polygon;
  std::vector<blocks::BlockEdge> labels;
};

/// Vertices less than `tolerance_m` off the contour are dropped (Douglas and Peucker 1973), but
/// where a logical street ends. Where that would make a ring degenerate or the polygon invalid, a
/// finer tolerance is taken, at last none. No vertex is moved.
LabelledContour simplify_contour(const blocks::Block& block, double tolerance_m);

}  // namespace plat::parcels
