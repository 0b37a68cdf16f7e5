#include "sequences/layer_plan.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plat::sequences {
namespace {

/// Boxes may have one cell for so many values: each is looked at, whether it is reached or not.
constexpr std::uint64_t kShareOfCells = 8;

/// Builds the plan, zone by zone: backwards what must be remembered, forwards what is reached.
class Planner {
 public:
  Planner(const SearchGraph& graph, std::uint64_t max_values)
      : graph_(graph), max_values_(max_values) {
    plan_.zones.resize(graph.zones.size());
  }

  std::optional<LayerPlan> plan() {
    collect_links();
    for (std::size_t z = graph_.zones.size(); z-- > 0;) bound_above(z);
    std::vector<bool> is_entered(graph_.zones.size(), false);
    bound_below(is_entered);
    for (std::size_t z = 0; z < graph_.zones.size(); ++z) {
      collect_classes(z);
      if (is_entered[z] && !make_box(z)) return std::nullopt;
    }
    for (const Terminal& entry : graph_.entries)
      mark(plan_.zones[graph_.zone_of(entry.node)], std::vector<Amount>(graph_.dimension_count, 0),
           graph_.uses(entry.node));
    for (std::size_t z = 0; z < graph_.zones.size(); ++z) {
      ZoneLayers& layers = plan_.zones[z];
      if (layers.run_dimension)
        spread_forwards(layers);
      else if (!layers.row_of_cell.empty())
        number_rows(layers);
      enter_next_zones(z);
    }
    for (std::size_t z = 0; z < graph_.zones.size(); ++z) {
      ZoneLayers& layers = plan_.zones[z];
      if (layers.run_dimension && !start_runs(z)) return std::nullopt;
      plan_.state_count += layers.reached_rows() * graph_.zones[z].size;
      plan_.value_count += std::uint64_t{layers.row_count} * graph_.zones[z].size;
      if (plan_.value_count > max_values_) return std::nullopt;
    }
    return std::move(plan_);
  }

 private:
  void collect_links() {
    std::uint32_t link = 0;
    for (std::size_t z = 0; z < graph_.zones.size(); ++z) {
      const Zone& zone = graph_.zones[z];
      ZoneLayers& layers = plan_.zones[z];
      layers.first_link = link;
      while (link < graph_.links.size() && graph_.links[link].from < zone.first_node + zone.size)
        layers.targets.push_back(graph_.links[link++].to);
      layers.last_link = link;
      const std::vector<std::uint32_t> ends = layers.targets;
      std::ranges::sort(layers.targets);
      layers.targets.erase(std::unique(layers.targets.begin(), layers.targets.end()),
                           layers.targets.end());
      for (const std::uint32_t end : ends)
        layers.target_of.push_back(static_cast<std::uint32_t>(
            std::ranges::lower_bound(layers.targets, end) - layers.targets.begin()));
      for (const std::uint32_t target : layers.targets)
        layers.target_zones.push_back(graph_.zone_of(target));
    }
  }

  /// What the zone must tell apart in one dimension: everything up to a maximum here, or as far as
  /// this and the later zones ask.
  void bound_above(std::size_t z) {
    const Zone& zone = graph_.zones[z];
    ZoneLayers& layers = plan_.zones[z];
    const bool has_exit = std::ranges::any_of(graph_.exits, [&](const Terminal& exit) {
      return exit.node >= zone.first_node && exit.node < zone.first_node + zone.size;
    });
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d) {
      const bool saturates = zone.bounds[d].max == kUnbounded;
      std::int64_t highest = saturates ? zone.bounds[d].min : has_exit ? zone.bounds[d].max : -1;
      for (std::size_t t = 0; t < layers.targets.size(); ++t) {
        const Zone& next = graph_.zones[layers.target_zones[t]];
        const ZoneLayers& after = plan_.zones[layers.target_zones[t]];
        if (saturates && !next.resets[d])
          highest =
              std::max<std::int64_t>(highest, after.highest[d] + (after.saturates[d] ? 0 : 1));
        if (!saturates && (next.resets[d] || after.saturates[d])) highest = zone.bounds[d].max;
        if (!saturates && !next.resets[d] && !after.saturates[d])
          highest = std::max<std::int64_t>(
              highest, std::int64_t{after.highest[d]} - graph_.uses(layers.targets[t])[d]);
      }
      layers.saturates.push_back(saturates);
      layers.highest.push_back(static_cast<Amount>(
          std::min<std::int64_t>(highest, saturates ? kUnbounded - 1 : zone.bounds[d].max)));
    }
  }

  void lower(std::size_t z, std::vector<bool>& is_entered, std::uint32_t node,
             const std::vector<Amount>& before) {
    ZoneLayers& layers = plan_.zones[z];
    const auto uses = graph_.uses(node);
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d) {
      const auto amount = static_cast<Amount>(std::min<std::int64_t>(
          std::int64_t{before[d]} + uses[d], layers.saturates[d] ? layers.highest[d] : kUnbounded));
      layers.lowest[d] = is_entered[z] ? std::min(layers.lowest[d], amount) : amount;
    }
    is_entered[z] = true;
  }

  void bound_below(std::vector<bool>& is_entered) {
    const std::vector<Amount> none(graph_.dimension_count, 0);
    for (ZoneLayers& layers : plan_.zones) layers.lowest = none;
    for (const Terminal& entry : graph_.entries)
      lower(graph_.zone_of(entry.node), is_entered, entry.node, none);
    for (std::size_t z = 0; z < graph_.zones.size(); ++z) {
      if (!is_entered[z]) continue;
      const ZoneLayers& layers = plan_.zones[z];
      for (std::size_t t = 0; t < layers.targets.size(); ++t) {
        const std::size_t next = layers.target_zones[t];
        std::vector<Amount> before = layers.lowest;
        for (std::uint32_t d = 0; d < graph_.dimension_count; ++d)
          if (graph_.zones[next].resets[d]) before[d] = 0;
        lower(next, is_entered, layers.targets[t], before);
      }
    }
  }

  /// Numbers the distinct uses of a zone's arcs.
  void collect_classes(std::size_t z) {
    const Zone& zone = graph_.zones[z];
    if (!zone.table) return;
    ZoneLayers& layers = plan_.zones[z];
    const TransitionTable& table = graph_.tables[*zone.table];
    const std::size_t width = graph_.dimension_count;
    const bool is_by_arc = !table.arc_uses.empty();
    const std::size_t count = is_by_arc ? table.arcs.size() : zone.size;
    std::vector<Amount> all(count * width);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t head = is_by_arc ? table.arcs[i].head : i;
      const auto uses = graph_.uses(zone.first_node + static_cast<std::uint32_t>(head));
      for (std::size_t d = 0; d < width; ++d) {
        const std::int64_t sum =
            std::int64_t{uses[d]} + (is_by_arc ? table.arc_uses[i * width + d] : 0);
        all[i * width + d] = static_cast<Amount>(std::min<std::int64_t>(sum, kUnbounded));
      }
    }
    const auto row = [&](std::size_t i) { return std::span(all).subspan(i * width, width); };
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      return std::ranges::lexicographical_compare(row(a), row(b));
    });
    layers.class_of.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      if (k == 0 || !std::ranges::equal(row(order[k]), row(order[k - 1]))) {
        const auto uses = row(order[k]);
        layers.class_uses.insert(layers.class_uses.end(), uses.begin(), uses.end());
        ++layers.class_count;
      }
      layers.class_of[order[k]] = layers.class_count - 1;
    }
  }

  [[nodiscard]] static std::uint64_t extent(const ZoneLayers& layers, std::uint32_t dimension) {
    return static_cast<std::uint64_t>(std::int64_t{layers.highest[dimension]} -
                                      layers.lowest[dimension] + 1);
  }

  /// The dimension of which every arc uses most, if that is enough.
  static void choose_run_dimension(ZoneLayers& layers) {
    for (std::uint32_t d = 0; d < layers.highest.size() && layers.class_count > 0; ++d) {
      if (layers.saturates[d] || extent(layers, d) == 1) continue;
      Amount least = kUnbounded;
      for (std::uint32_t c = 0; c < layers.class_count; ++c)
        least = std::min(least, layers.uses_of(c)[d]);
      least = std::min<Amount>(least, kMaxWidth);
      if (least < kLeastRunUse || least < layers.least_use) continue;
      if (least == layers.least_use && extent(layers, d) <= extent(layers, *layers.run_dimension))
        continue;
      layers.run_dimension = d;
      layers.least_use = least;
    }
  }

  /// Gives every dimension its step. Nothing where there are more cells than `max_values_`.
  std::optional<std::uint64_t> number_cells(ZoneLayers& layers) const {
    const auto width = static_cast<std::uint32_t>(layers.highest.size());
    layers.step.assign(width, 0);
    std::uint64_t cells = 1;
    for (std::uint32_t d = width; d-- > 0;) {
      if (d == layers.run_dimension) continue;
      layers.step[d] = cells;
      if (extent(layers, d) > max_values_ / cells) return std::nullopt;
      cells *= extent(layers, d);
    }
    return cells;
  }

  /// False where the boxes become too large.
  bool make_box(std::size_t z) {
    ZoneLayers& layers = plan_.zones[z];
    std::uint32_t counting = 0;
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d) {
      if (layers.lowest[d] > layers.highest[d]) return true;
      counting += extent(layers, d) > 1 ? 1 : 0;
    }
    choose_run_dimension(layers);
    const auto cells = number_cells(layers);
    if (!cells) return false;
    cells_ += *cells;
    if (cells_ > max_values_ / kShareOfCells || *cells >= kNoRow) return false;
    layers.row_count = static_cast<Row>(*cells);
    if (layers.run_dimension)
      layers.runs.resize(*cells);
    else if (counting > 1 || !graph_.zones[z].table)
      layers.row_of_cell.assign(*cells, kNoRow);
    return true;
  }

  static void mark(ZoneLayers& layers, std::span<const Amount> consumed,
                   std::span<const Amount> used) {
    if (layers.row_count == 0) return;
    const auto cell = layers.cell_after(consumed, used);
    if (!cell) return;
    if (layers.run_dimension) {
      const std::uint32_t d = *layers.run_dimension;
      widen(layers.runs[*cell], std::int64_t{consumed[d]} + used[d] - layers.lowest[d],
            std::int64_t{consumed[d]} + used[d] - layers.lowest[d]);
    } else if (!layers.row_of_cell.empty()) {
      layers.row_of_cell[*cell] = 0;
    }
  }

  static void widen(ZoneLayers::Run& run, std::int64_t first, std::int64_t last) {
    if (first > last) return;
    run.first = std::min(run.first, static_cast<std::uint32_t>(first));
    run.last = std::max(run.last, static_cast<std::uint32_t>(last));
  }

  /// Follows the zone's uses from run to run.
  void spread_forwards(ZoneLayers& layers) {
    const std::int64_t top = static_cast<std::int64_t>(extent(layers, *layers.run_dimension)) - 1;
    for (std::size_t r = 0; r < layers.runs.size(); ++r) {
      auto& run = layers.runs[r];
      if (run.is_empty()) continue;
      const auto& next = next_runs(layers, r);
      // Within a run, one arc may follow another up to the top.
      if (std::ranges::find(next, r) != next.end()) run.last = static_cast<std::uint32_t>(top);
      for (std::uint32_t c = 0; c < layers.class_count; ++c) {
        if (!next[c] || *next[c] == r) continue;
        const std::int64_t used = layers.uses_of(c)[*layers.run_dimension];
        widen(layers.runs[*next[c]], run.first + used, std::min(top, run.last + used));
      }
    }
  }

  /// Keeps of the runs what paths may end from or leave from, and gives them their rows. False
  /// where there are too many.
  bool start_runs(std::size_t z) {
    ZoneLayers& layers = plan_.zones[z];
    const auto ends = spread_backwards(z);
    std::uint64_t rows = 0;
    for (std::size_t r = 0; r < layers.runs.size(); ++r) {
      auto& run = layers.runs[r];
      run.first = std::max(run.first, ends[r].first);
      run.last = std::min(run.last, ends[r].last);
      run.start = static_cast<Row>(rows + kRunMargin);
      if (!run.is_empty()) rows += run.last - run.first + 1 + 2 * kRunMargin;
      if (rows > max_values_ || rows >= kNoRow) return false;
    }
    layers.row_count = static_cast<Row>(rows);
    return true;
  }

  /// By run: between which offsets a path may end or leave the zone, now or later.
  std::vector<ZoneLayers::Run> spread_backwards(std::size_t z) {
    const ZoneLayers& layers = plan_.zones[z];
    std::vector<ZoneLayers::Run> ends(layers.runs.size());
    std::vector<Amount> amounts(graph_.dimension_count);
    for (std::size_t r = layers.runs.size(); r-- > 0;) {
      if (layers.runs[r].is_empty()) continue;
      layers.amounts_of(r, amounts);
      widen_to_ends(z, amounts, ends[r]);
      const auto& next = next_runs(layers, r);
      for (std::uint32_t c = 0; c < layers.class_count; ++c) {
        if (!next[c] || *next[c] == r || ends[*next[c]].is_empty()) continue;
        const std::int64_t used = layers.uses_of(c)[*layers.run_dimension];
        widen(ends[r], std::max<std::int64_t>(0, ends[*next[c]].first - used),
              ends[*next[c]].last - used);
      }
      const bool climbs = std::ranges::find(next, r) != next.end();
      if (climbs && !ends[r].is_empty()) ends[r].first = 0;
    }
    return ends;
  }

  /// Ends in this run: at exits, and where links may be followed. `amounts`: of its cell.
  void widen_to_ends(std::size_t z, std::span<const Amount> amounts, ZoneLayers::Run& run) const {
    const ZoneLayers& layers = plan_.zones[z];
    const Zone& zone = graph_.zones[z];
    const std::uint32_t inner = *layers.run_dimension;
    const std::int64_t top = static_cast<std::int64_t>(extent(layers, inner)) - 1;
    const auto asked = [&](auto is_asked) {
      for (std::uint32_t d = 0; d < graph_.dimension_count; ++d)
        if (d != inner && is_asked(d) && amounts[d] < zone.bounds[d].min) return;
      const std::int64_t least =
          is_asked(inner) ? std::int64_t{zone.bounds[inner].min} - layers.lowest[inner] : 0;
      widen(run, std::max<std::int64_t>(least, 0), top);
    };
    const auto exit = std::ranges::lower_bound(graph_.exits, zone.first_node, {}, &Terminal::node);
    if (exit != graph_.exits.end() && exit->node < zone.first_node + zone.size)
      asked([](std::uint32_t) { return true; });
    for (std::size_t t = 0; t < layers.targets.size(); ++t) {
      if (t > 0 && layers.target_zones[t] == layers.target_zones[t - 1]) continue;
      asked(
          [&](std::uint32_t d) -> bool { return graph_.zones[layers.target_zones[t]].resets[d]; });
    }
  }

  /// By class: the run that it leads to.
  const std::vector<std::optional<std::size_t>>& next_runs(const ZoneLayers& layers,
                                                           std::size_t run) {
    amounts_.resize(graph_.dimension_count);
    next_runs_.resize(layers.class_count);
    layers.amounts_of(run, amounts_);
    for (std::uint32_t c = 0; c < layers.class_count; ++c)
      next_runs_[c] = layers.run_after(amounts_, c);
    return next_runs_;
  }

  /// Follows the zone's uses from marked cell to marked cell, and numbers the cells.
  void number_rows(ZoneLayers& layers) const {
    std::vector<Amount> amounts(graph_.dimension_count);
    Row rows = 0;
    for (std::size_t cell = 0; cell < layers.row_of_cell.size(); ++cell) {
      if (layers.row_of_cell[cell] == kNoRow) continue;
      layers.cell_of_row.push_back(static_cast<std::uint32_t>(cell));
      layers.row_of_cell[cell] = rows;
      layers.consumed(rows++, amounts);
      for (std::uint32_t c = 0; c < layers.class_count; ++c) {
        const auto next = layers.cell_after(amounts, layers.uses_of(c));
        if (next && *next > cell) layers.row_of_cell[*next] = 0;
      }
    }
    layers.row_count = rows;
  }

  /// Marks what the links of a zone bring to later ones.
  void enter_next_zones(std::size_t z) {
    const ZoneLayers& layers = plan_.zones[z];
    const std::size_t width = graph_.dimension_count;
    std::vector<Amount> amounts(width);
    std::vector<Amount> carry(width);
    std::vector<Amount> carried;  // `count` vectors one after the other, neighbours distinct
    std::size_t count = 0;
    for (std::size_t t = 0; t < layers.targets.size(); ++t) {
      const std::uint32_t next = layers.target_zones[t];
      if (plan_.zones[next].row_count == 0) continue;
      if (t == 0 || next != layers.target_zones[t - 1]) {
        carried.clear();
        count = 0;
        layers.for_each_row(amounts, [&](Row) {
          carry = amounts;
          if (!carry_over(graph_.zones[z], graph_.zones[next], carry)) return;
          if (count > 0 && std::equal(carry.begin(), carry.end(),
                                      carried.end() - static_cast<std::ptrdiff_t>(width)))
            return;
          carried.insert(carried.end(), carry.begin(), carry.end());
          ++count;
        });
      }
      for (std::size_t k = 0; k < count; ++k)
        mark(plan_.zones[next], std::span(carried).subspan(k * width, width),
             graph_.uses(layers.targets[t]));
    }
  }

  const SearchGraph& graph_;
  std::uint64_t max_values_;
  std::uint64_t cells_ = 0;
  LayerPlan plan_;
  std::vector<Amount> amounts_;                        ///< scratch
  std::vector<std::optional<std::size_t>> next_runs_;  ///< scratch
};

}  // namespace

std::optional<std::size_t> ZoneLayers::cell_after(std::span<const Amount> consumed,
                                                  std::span<const Amount> used) const {
  std::size_t cell = 0;
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    std::int64_t sum = std::int64_t{consumed[d]} + used[d];
    if (sum > highest[d]) {
      if (!saturates[d]) return std::nullopt;
      sum = highest[d];
    }
    if (sum < lowest[d]) return std::nullopt;
    cell += static_cast<std::size_t>(sum - lowest[d]) * step[d];
  }
  return cell;
}

Row ZoneLayers::row_after(std::span<const Amount> consumed, std::span<const Amount> used) const {
  if (row_count == 0) return kNoRow;
  const auto cell = cell_after(consumed, used);
  if (!cell) return kNoRow;
  if (run_dimension) {
    const std::uint32_t d = *run_dimension;
    const std::int64_t offset = std::int64_t{consumed[d]} + used[d] - lowest[d];
    const Run& run = runs[*cell];
    return run.has(offset) ? run.start + static_cast<Row>(offset - run.first) : kNoRow;
  }
  return row_of_cell.empty() ? static_cast<Row>(*cell) : row_of_cell[*cell];
}

std::optional<std::size_t> ZoneLayers::run_after(std::span<const Amount> consumed,
                                                 std::uint32_t c) const {
  std::size_t cell = 0;
  const auto used = uses_of(c);
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    if (d == run_dimension) continue;
    std::int64_t sum = std::int64_t{consumed[d]} + used[d];
    if (sum > highest[d]) {
      if (!saturates[d]) return std::nullopt;
      sum = highest[d];
    }
    if (sum < lowest[d]) return std::nullopt;
    cell += static_cast<std::size_t>(sum - lowest[d]) * step[d];
  }
  return cell;
}

void ZoneLayers::amounts_of(std::size_t cell, std::span<Amount> amounts) const {
  for (std::size_t d = 0; d < amounts.size(); ++d) {
    amounts[d] = lowest[d] + (step[d] > 0 ? static_cast<Amount>(cell / step[d]) : 0);
    if (step[d] > 0) cell %= step[d];
  }
}

void ZoneLayers::consumed(Row row, std::span<Amount> amounts) const {
  if (!run_dimension) {
    amounts_of(cell_of_row.empty() ? row : cell_of_row[row], amounts);
    return;
  }
  const auto after = std::ranges::upper_bound(runs, row, {}, &Run::start);
  const Run& run = *(after - 1);
  amounts_of(static_cast<std::size_t>(after - runs.begin()) - 1, amounts);
  amounts[*run_dimension] += static_cast<Amount>(run.first + (row - run.start));
}

std::uint64_t ZoneLayers::reached_rows() const {
  if (!run_dimension) return row_count;
  std::uint64_t rows = 0;
  for (const Run& run : runs)
    if (!run.is_empty()) rows += run.last - run.first + 1;
  return rows;
}

bool carry_over(const Zone& from, const Zone& to, std::span<Amount> consumed) {
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    if (!to.resets[d]) continue;
    if (consumed[d] < from.bounds[d].min) return false;
    consumed[d] = 0;
  }
  return true;
}

bool may_end(const Zone& zone, std::span<const Amount> consumed) {
  for (std::size_t d = 0; d < consumed.size(); ++d)
    if (consumed[d] < zone.bounds[d].min) return false;
  return true;
}

std::optional<LayerPlan> plan_layers(const SearchGraph& graph, std::uint64_t max_values) {
  return Planner(graph, max_values).plan();
}

}  // namespace plat::sequences
