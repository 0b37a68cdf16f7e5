#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "blocks/block.h"
#include "core/failure.h"
#include "core/parallel.h"

namespace plat::blocks {

/// A parcel as it was observed, in the local frame.
struct ObservedParcel {
  std::string id;
  Polygon shape;
};

/// What could not be made a block, or part of one.
struct BlockFailure {
  std::string feature_id;
  Failure failure;
  Polygon shape;  ///< what was refused; may be invalid
};

struct ParcelUnionOptions {
  double closing_m = 0.6;    ///< gaps up to twice this are joints between plots, not streets
  double simplify_m = 0.05;  ///< how far the contour may move when vertices are dropped
  double min_area_m2 = 1.0;  ///< a smaller block is a failure row
  std::size_t max_vertices = 20000;  ///< of one block
};

struct BlocksFromParcels {
  std::vector<Block> blocks;     ///< edges still face nothing: see label_edges()
  std::vector<Polygon> parcels;  ///< as given, on the working grid; empty where refused
  std::vector<std::optional<BlockId>> block_of;  ///< per parcel; nullopt where refused
  std::vector<BlockFailure> failures;            ///< parcels first, then blocks
};

/// Blocks as unions of parcels, closed by a small distance: grown, united, shrunk, with mitred
/// corners. A block's source id is that of its first parcel.
///
/// Guarantees: 1. every parcel is in one block, or is a failure row, or its block is;  2. contours
/// pass find_defect();  3. blocks are ordered by their first parcel, whatever the thread count.
/// A contour that touches itself in a point is opened there by centimetres.
BlocksFromParcels blocks_from_parcels(std::span<const ObservedParcel> parcels,
                                      const ParcelUnionOptions& options = {}, Jobs jobs = {});

}  // namespace plat::blocks
