#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "sequences/min_plus.h"
#include "sequences/search_graph.h"

namespace plat::sequences {

/// The number of a consumed vector within a zone.
using Row = std::uint32_t;
inline constexpr Row kNoRow = std::numeric_limits<Row>::max();
/// Rows before and behind a run, so that a block of layers may reach beyond its ends.
inline constexpr std::size_t kRunMargin = kMaxWidth;
/// With a smaller least use, a block of layers would have too little in it.
inline constexpr Amount kLeastRunUse = 2;

/// The consumed vectors that paths may have inside one zone, and what the zone's arcs and links add
/// to them.
///
/// Rows ascend lexicographically, the first dimension first. In a zone of runs,
/// one dimension of which every arc uses at least `least_use` comes last instead: neighbouring rows
/// differ in it by one quantum, and those nearer than `least_use` do not depend on each other. A
/// run has the rows that a path can come to and can end from, and kRunMargin more at both ends. In
/// other zones rows number what can be reached of the box.
struct ZoneLayers {
  std::vector<Amount> lowest;     ///< by dimension: the least amount that a path may have here
  std::vector<Amount> highest;    ///< the largest from which a path may still end
  std::vector<bool> saturates;    ///< larger amounts count as `highest`: nothing bounds them
  std::vector<std::size_t> step;  ///< by dimension: cells per quantum; 0: of runs
  Row row_count = 0;              ///< 0: no path comes here, or none ends from here
  std::vector<Row> row_of_cell;   ///< empty: every cell is a row
  std::vector<std::uint32_t> cell_of_row;  ///< empty: every cell is a row

  std::optional<std::uint32_t> run_dimension;  ///< of a zone of runs
  Amount least_use = 0;
  /// Offsets first .. last: the amount less `lowest`; none where `first` exceeds `last`.
  struct Run {
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t last = 0;
    Row start = 0;  ///< the row of `first`
    [[nodiscard]] bool is_empty() const { return first > last; }
    [[nodiscard]] bool has(std::int64_t offset) const { return offset >= first && offset <= last; }
  };
  std::vector<Run> runs;  ///< of a zone of runs, by cell

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
  /// The same without numbering: the place in the box, or nothing outside it.
  [[nodiscard]] std::optional<std::size_t> cell_after(std::span<const Amount> consumed,
                                                      std::span<const Amount> used) const;
  /// The run that arcs of class `c` lead to from `consumed`, or nothing outside the box.
  [[nodiscard]] std::optional<std::size_t> run_after(std::span<const Amount> consumed,
                                                     std::uint32_t c) const;
  void consumed(Row row, std::span<Amount> amounts) const;
  /// The amounts of a cell; in the run dimension the lowest.
  void amounts_of(std::size_t cell, std::span<Amount> amounts) const;
  /// The uses of a class, by dimension.
  [[nodiscard]] std::span<const Amount> uses_of(std::size_t c) const {
    return {class_uses.data() + c * highest.size(), highest.size()};
  }
  /// How many rows can be reached.
  [[nodiscard]] std::uint64_t reached_rows() const;
  /// Calls `visit(row)` for all of them, ascending, with what has been consumed in `amounts`.
  template <class Visit>
  void for_each_row(std::span<Amount> amounts, Visit visit) const {
    for (Row row = 0; !run_dimension && row < row_count; ++row) {
      consumed(row, amounts);
      visit(row);
    }
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (runs[r].is_empty()) continue;
      amounts_of(r, amounts);
      amounts[*run_dimension] += static_cast<Amount>(runs[r].first);
      for (std::uint32_t k = 0; k <= runs[r].last - runs[r].first; ++k) {
        visit(runs[r].start + k);
        ++amounts[*run_dimension];
      }
    }
  }
};

/// For every zone the consumed vectors that its costs-to-go must tell apart.
///
/// Guarantees: 1. every state of a path has a row;  2. two vectors share a row only where no bound
/// further on tells them apart.
struct LayerPlan {
  std::vector<ZoneLayers> zones;
  std::uint64_t state_count = 0;  ///< reached rows x nodes, over all zones
  std::uint64_t value_count = 0;  ///< rows x nodes, over all zones
};

/// Nothing where the boxes together have more than `max_values` cells, or there are more values
/// than that.
std::optional<LayerPlan> plan_layers(const SearchGraph& graph, std::uint64_t max_values);

/// More than any best path costs, by counting its steps, or kInfinite<Cost> where that is more than
/// whole numbers of 64 bits hold.
Cost path_cost_bound(const SearchGraph& graph, const LayerPlan& plan);

/// What a path that has `consumed` in `from` brings to `to` by a link, or false where a dimension
/// that `to` resets is below its minimum.
bool carry_over(const Zone& from, const Zone& to, std::span<Amount> consumed);
/// Whether a path that has `consumed` may end in `zone`.
bool may_end(const Zone& zone, std::span<const Amount> consumed);

}  // namespace plat::sequences
