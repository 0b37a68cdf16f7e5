#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.h"
#include "core/polygon.h"
#include "streets/street_network.h"

namespace plat::blocks {

using streets::width_source_name;
using streets::WidthSource;

/// What one edge of a block's contour faces.
struct BlockEdge {
  /// Edges of one logical street, as a person would name it, share this number within the block:
  /// names, classes and continuity of direction decide [VKW12, Sec. 4.2.1]. nullopt where the edge
  /// faces no street.
  std::optional<std::uint32_t> logical_street;
  std::optional<StreetId> street;  ///< in the network the block came from, if any
  double street_width_m = 0.0;     ///< full width, 0 where the edge faces no street
  WidthSource width_source = WidthSource::kNone;

  [[nodiscard]] bool is_street() const { return logical_street.has_value(); }
  friend bool operator==(const BlockEdge&, const BlockEdge&) = default;
};

/// A block: the land that streets enclose, its contour on the working grid in a frame near the
/// block.
///
/// Invariants: `contour` passes find_defect(); `edges` has one row per ring (outer, then holes)
/// with one entry per edge, edge i running from vertex i to i + 1.
struct Block {
  BlockId id;
  std::string source_id;  ///< feature id in the file it came from, empty if derived
  Polygon contour;
  std::vector<std::vector<BlockEdge>> edges;
};

/// A block whose every outer edge faces a street of its own, `width_m` wide: what is assumed where
/// nothing is known of the surroundings. Consecutive edges that turn by less than
/// `same_street_turn_rad` share a logical street. Holes face nothing. Pre: `contour` admitted
/// (core/validity.h).
Block block_from_contour(BlockId id, Polygon contour, double width_m = 12.0,
                         double same_street_turn_rad = 0.5);

/// The block, with every outer edge a street where no edge of it is one: a block about whose
/// surroundings nothing is known.
Block with_streets_assumed(const Block& block);

/// Gives consecutive street edges of each ring the same logical street where they face the same one
/// in `key` (equal, non-empty keys) or, lacking keys, turn by less than `same_street_turn_rad`.
/// Renumbers from 0 along the rings.
void assign_logical_streets(Block& block, const std::vector<std::vector<std::string>>& keys,
                            double same_street_turn_rad = 0.5);

/// The edges of one ring as segments with their labels, in ring order.
const Ring& ring_at(const Block& block, std::size_t ring);  ///< 0 = outer, then holes

}  // namespace plat::blocks
