#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// The number of a consumed vector within a zone.
using Row = std::uint32_t;
inline constexpr Row kNoRow = std::numeric_limits<Row>::max();

/// The consumed vectors that paths may have inside one zone, numbered in lexicographic order, and
/// what the zone's arcs and links add to them.
struct ZoneLayers {
  std::vector<Amount> lowest;     ///< by dimension: the least amount that a path may have here
  std::vector<Amount> highest;    ///< the largest from which a path may still end
  std::vector<bool> saturates;    ///< larger amounts count as `highest`, where nothing bounds them
  std::vector<std::size_t> step;  ///< by dimension: cells per quantum; the last dimension has 1
  Row row_count = 0;              ///< 0: no path comes here, or none ends from here
  std::vector<Row> row_of_cell;   ///< empty: every cell is a row
  std::vector<std::uint32_t> cell_of_row;  ///< empty: every cell is a row

  std::vector<Amount> class_uses;       ///< classes x dimensions: the distinct uses of its arcs
  std::vector<std::uint32_t> class_of;  ///< by head, or by arc where arcs have uses of their own
  std::uint32_t class_count = 0;
  std::uint32_t first_link = 0;        ///< links that leave this zone: first_link .. last_link
  std::uint32_t last_link = 0;         ///< one past the end
  std::vector<std::uint32_t> targets;  ///< the nodes that these links lead to, ascending
  std::vector<std::uint32_t> target_zones;
  std::vector<std::uint32_t> target_of;  ///< by link - first_link: index into `targets`

  /// The row of `consumed` + `used`, or kNoRow where that exceeds a bound or cannot occur.
  [[nodiscard]] Row row_after(std::span<const Amount> consumed, std::span<const Amount> used) const;
  void consumed(Row row, std::span<Amount> amounts) const;
  /// The same without numbering: the place in the box, or nothing outside it.
  [[nodiscard]] std::optional<std::size_t> cell_after(std::span<const Amount> consumed,
                                                      std::span<const Amount> used) const;
};

/// For every zone the consumed vectors that its costs-to-go must tell apart: a dense box where one
/// dimension counts, else the cells that the uses of entries, links and arcs can reach.
///
/// Guarantees: 1. every state of a path has a row;  2. two vectors share a row only where no bound
/// further on tells them apart.
struct LayerPlan {
  std::vector<ZoneLayers> zones;
  std::uint64_t state_count = 0;  ///< rows x nodes, over all zones
};

/// Nothing where the boxes together have more than `max_cells` cells, or more states than that.
std::optional<LayerPlan> plan_layers(const SearchGraph& graph, std::uint64_t max_cells);

/// What a path that has `consumed` in `from` brings to `to` by a link, or false where a dimension
/// that `to` resets is below its minimum.
bool carry_over(const Zone& from, const Zone& to, std::span<Amount> consumed);
/// Whether a path that has `consumed` may end in `zone`.
bool may_end(const Zone& zone, std::span<const Amount> consumed);

}  // namespace plat::sequences
