#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "similarity/shape_similarity.h"
#include "tiles/tile_layout.h"

namespace plat::tiles::detail {

/// What becomes of vertices of neighbours that nothing meets any more, in the middle of a straight
/// edge.
enum class UnmetVertices {
  kDropped,  ///< so that pasting back restores what was
  kKept,     ///< so that errors before and after are sums over the same joints
};

/// Tiles that take the place of others.
struct Substitution {
  const TileLayout* piece = nullptr;       ///< tiles joined to each other, of one block
  std::vector<std::uint32_t> replaced;     ///< of the layout: ascending, of one block
  similarity::ShapeComparison comparison;  ///< of the piece's outline with that of the replaced
  Affine as_placed;                        ///< where the piece is to go, as somebody wants it
  UnmetVertices unmet = UnmetVertices::kDropped;
};

struct Substituted {
  TileLayout layout;
  std::vector<std::uint32_t> tiles;  ///< of the layout: those that came, ascending
};

/// The layout with the piece in the place of the replaced tiles: laid on them by a rigid motion,
/// joined to what they were joined to. The outline of the piece takes over the vertices that others
/// have on the outline of the replaced; vertices of its own are put into the neighbours' edges;
/// street links go to the corresponding points. Tiles that came have new ids; they are not solved.
///
/// Guarantees: 1. tiles of the block have the same vertices along common boundaries;  2. every link
/// between a replaced tile and one that stays is a link of a tile that came;  3. a copy that takes
/// its source's place makes the same layout, but for ids and the order of tiles and vertices.
/// Failure kNoPlace: the outline of either is not one ring, or surrounds tiles that stay.
/// Paper: [ABVA08, Sec. 6], "the pasted tile inherits its connectivity from the replaced tiles".
Expected<Substituted> substituted(const TileLayout& layout, const Substitution& substitution);

}  // namespace plat::tiles::detail
