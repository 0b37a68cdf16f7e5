#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/affine.h"
#include "similarity/shape_similarity.h"
#include "tiles/reconfiguration.h"

namespace plat::tiles::detail {

/// The measure that the options name. @throws InputError where there is none.
similarity::AnyShapeSimilarity measure_of(const ReconfigurationOptions& options);

/// Tiles of a group that are joined to each other, with their outline as a shape.
struct Piece {
  TileLayout layout;
  similarity::LabelledShape shape;
  std::vector<std::uint32_t> members;  ///< of the group: index per tile of the layout
};

/// The group in pieces: tiles joined to each other, or single tiles where the outline of those is
/// no ring.
/// Failure kNoPlace: a tile that is no ring itself.
Expected<std::vector<Piece>> pieces_of(const TileGroup& group);

/// Tiles that a piece takes the place of.
struct Destination {
  std::vector<std::uint32_t> replaced;  ///< ascending
  similarity::ShapeComparison comparison;
};

/// The tile under the middle of the piece, or a union of it with its neighbours under the piece:
/// of those that overlap the piece about as well as the best does, the most similar. Neighbours are
/// merged in the order of how much of them lies under the piece, until the union is much larger
/// than the piece.
/// @param kept  ids of tiles that are not to be replaced, ascending; nor are pinned ones
/// Failure kNoPlace: less than half of the piece lies on tiles that may be replaced, or on none
/// whose outline can be taken over.
/// Paper: [ABVA08, Sec. 5], 1-to-many; which tiles are merged is not said there (ADR 0039).
Expected<Destination> find_destination(const TileLayout& layout, const Piece& piece,
                                       const Affine& to,
                                       const similarity::AnyShapeSimilarity& measure,
                                       std::span<const TileId> kept);

}  // namespace plat::tiles::detail
