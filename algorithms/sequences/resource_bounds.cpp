#include "sequences/resource_bounds.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "sequences/strong_components.h"

namespace plat::sequences {
namespace {

using Value = std::int64_t;
constexpr Value kNone = std::numeric_limits<Value>::max();

/// The arcs of a table from either end.
struct Neighbours {
  struct Entry {
    std::uint32_t other = 0;
    std::uint32_t arc = 0;
  };
  std::vector<std::uint32_t> first;  ///< n + 1 offsets into `entries`
  std::vector<Entry> entries;
};

Neighbours heads_of(const TransitionTable& table) {
  Neighbours out{table.first, {}};
  out.entries.reserve(table.arcs.size());
  for (std::uint32_t arc = 0; arc < table.arcs.size(); ++arc)
    out.entries.push_back({table.arcs[arc].head, arc});
  return out;
}

Neighbours tails_of(const TransitionTable& table) {
  Neighbours out;
  out.first.assign(table.first.size(), 0);
  for (const auto& arc : table.arcs) ++out.first[arc.head + 1];
  for (std::size_t i = 1; i < out.first.size(); ++i) out.first[i] += out.first[i - 1];
  out.entries.resize(table.arcs.size());
  std::vector<std::uint32_t> next = out.first;
  for (std::uint32_t tail = 0; tail < table.node_count(); ++tail)
    for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc)
      out.entries[next[table.arcs[arc].head]++] = {tail, arc};
  return out;
}

/// A table from all sides, made once for all zones and dimensions.
struct TableViews {
  Neighbours heads;
  Neighbours tails;
  StrongComponents components;  ///< only where some dimension has a minimum
};

bool has_minimum(const SearchGraph& graph, std::uint32_t d) {
  return std::ranges::any_of(graph.zones, [d](const Zone& zone) { return zone.bounds[d].min > 0; });
}

/// Computes one row after the other; holds what they share.
class Sweeper {
 public:
  explicit Sweeper(const SearchGraph& graph) : graph_(graph), values_(graph.node_count()) {
    bool needs_components = false;
    for (std::uint32_t d = 0; d < graph.dimension_count; ++d)
      needs_components = needs_components || has_minimum(graph, d);
    for (const auto& table : graph.tables)
      views_.push_back({heads_of(table), tails_of(table),
                        needs_components ? strong_components(table) : StrongComponents{}});
  }

  ResourceBounds operator()() {
    ResourceBounds out;
    const std::size_t rows = std::size_t{graph_.node_count()} * graph_.dimension_count;
    out.dimension_count = graph_.dimension_count;
    out.least.resize(rows);
    out.most.resize(rows);
    out.floor.resize(rows);
    out.ceiling.resize(rows);
    sweep_cost_from_entry();
    out.cost_from_entry.assign(values_.begin(), values_.end());
    sweep_cost_to_exit();
    out.cost_to_exit.assign(values_.begin(), values_.end());
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d) {
      sweep_least(d);
      write(out.least, d, [](Value v) { return v == kNone ? kUnbounded : v; });
      sweep_ceiling(d);
      write(out.ceiling, d, [](Value v) { return v == kNone ? -1 : -v; });
      if (has_minimum(graph_, d)) {
        sweep_most(d);
        write(out.most, d, [](Value v) { return v; });
        sweep_floor(d);
        write(out.floor, d, [](Value v) { return v == kNone ? kUnbounded : v; });
      } else {
        write_without_minimum(out, d);
      }
    }
    return out;
  }

 private:
  /// What entering by an arc of the zone's table consumes.
  [[nodiscard]] Value consumed_by(const Zone& zone, std::uint32_t arc, std::uint32_t d) const {
    const TransitionTable& table = graph_.tables[*zone.table];
    const Value used = uses(zone.first_node + table.arcs[arc].head, d);
    if (table.arc_uses.empty()) return used;
    return used + table.arc_uses[std::size_t{arc} * graph_.dimension_count + d];
  }
  [[nodiscard]] Value uses(std::uint32_t node, std::uint32_t d) const {
    return graph_.node_uses[std::size_t{node} * graph_.dimension_count + d];
  }
  /// Calls `visit(link, zone of its head)` for the links that leave the zone.
  template <class Visit>
  void for_links_from(const Zone& zone, Visit visit) const {
    auto link = std::ranges::lower_bound(graph_.links, zone.first_node, {}, &Link::from);
    for (; link != graph_.links.end() && link->from < zone.first_node + zone.size; ++link)
      visit(*link, graph_.zones[graph_.zone_of(link->to)]);
  }
  void lower(std::uint32_t node, Value value) { values_[node] = std::min(values_[node], value); }

  /// Lowers the values of a zone to the least that `step(value, arc)` gives along its arcs. A step
  /// does not lower a value; kNone forbids it.
  template <class Step>
  void relax(const Zone& zone, const Neighbours& neighbours, Step step) {
    const std::span<Value> values(values_.data() + zone.first_node, zone.size);
    heap_.clear();
    for (std::uint32_t node = 0; node < zone.size; ++node)
      if (values[node] != kNone) heap_.emplace_back(values[node], node);
    std::ranges::make_heap(heap_, std::greater<>{});
    while (!heap_.empty()) {
      std::ranges::pop_heap(heap_, std::greater<>{});
      const auto [value, node] = heap_.back();
      heap_.pop_back();
      if (value > values[node]) continue;
      for (std::uint32_t i = neighbours.first[node]; i < neighbours.first[node + 1]; ++i) {
        const auto [other, arc] = neighbours.entries[i];
        const Value next = step(value, arc);
        if (next >= values[other]) continue;
        values[other] = next;
        heap_.emplace_back(next, other);
        std::ranges::push_heap(heap_, std::greater<>{});
      }
    }
  }

  void sweep_cost_from_entry() {
    std::ranges::fill(values_, kNone);
    for (const Terminal& entry : graph_.entries) lower(entry.node, entry.cost);
    for (const Zone& zone : graph_.zones) {
      if (zone.table) {
        const TransitionTable& table = graph_.tables[*zone.table];
        relax(zone, views_[*zone.table].heads,
              [&](Value value, std::uint32_t arc) { return value + table.arcs[arc].cost; });
      }
      for_links_from(zone, [&](const Link& link, const Zone&) {
        if (values_[link.from] != kNone) lower(link.to, values_[link.from] + link.cost);
      });
    }
  }

  void sweep_cost_to_exit() {
    std::ranges::fill(values_, kNone);
    for (const Terminal& exit : graph_.exits) lower(exit.node, exit.cost);
    for (std::size_t z = graph_.zones.size(); z-- > 0;) {
      const Zone& zone = graph_.zones[z];
      for_links_from(zone, [&](const Link& link, const Zone&) {
        if (values_[link.to] != kNone) lower(link.from, values_[link.to] + link.cost);
      });
      if (!zone.table) continue;
      const TransitionTable& table = graph_.tables[*zone.table];
      relax(zone, views_[*zone.table].tails,
            [&](Value value, std::uint32_t arc) { return value + table.arcs[arc].cost; });
    }
  }

  static Value after(const Bounds& bounds, Value consumed, Value used) {
    if (bounds.max == kUnbounded) return std::min<Value>(consumed + used, bounds.min);
    return consumed + used > bounds.max ? kNone : consumed + used;
  }

  void sweep_least(std::uint32_t d) {
    std::ranges::fill(values_, kNone);
    for (const Terminal& entry : graph_.entries)
      lower(entry.node,
            after(graph_.zones[graph_.zone_of(entry.node)].bounds[d], 0, uses(entry.node, d)));
    for (const Zone& zone : graph_.zones) {
      if (zone.table)
        relax(zone, views_[*zone.table].heads, [&](Value value, std::uint32_t arc) {
          return after(zone.bounds[d], value, consumed_by(zone, arc, d));
        });
      for_links_from(zone, [&](const Link& link, const Zone& next) {
        if (values_[link.from] == kNone) return;
        const Value before = next.resets[d] ? 0 : values_[link.from];
        lower(link.to, after(next.bounds[d], before, uses(link.to, d)));
      });
    }
  }

  /// The negative of the ceiling, so that less is better here, too.
  void sweep_ceiling(std::uint32_t d) {
    std::ranges::fill(values_, kNone);
    const auto before = [](const Bounds& bounds, Value value, Value used) {
      if (bounds.max == kUnbounded) return value;
      return value + used > 0 ? kNone : value + used;
    };
    for (const Terminal& exit : graph_.exits)
      lower(exit.node, -Value{graph_.zones[graph_.zone_of(exit.node)].bounds[d].max});
    for (std::size_t z = graph_.zones.size(); z-- > 0;) {
      const Zone& zone = graph_.zones[z];
      for_links_from(zone, [&](const Link& link, const Zone& next) {
        if (values_[link.to] == kNone) return;
        const Value value = before(next.bounds[d], values_[link.to], uses(link.to, d));
        if (value == kNone) return;
        const Value at_most = -Value{zone.bounds[d].max};
        lower(link.from, next.resets[d] ? at_most : std::max(at_most, value));
      });
      if (!zone.table) continue;
      relax(zone, views_[*zone.table].tails, [&](Value value, std::uint32_t arc) {
        return before(zone.bounds[d], value, consumed_by(zone, arc, d));
      });
    }
  }

  /// Whether walking within a component consumes: then there is a circle that does.
  [[nodiscard]] bool is_consuming(const Zone& zone, std::span<const std::uint32_t> component,
                                  std::uint32_t d) const {
    const TableViews& views = views_[*zone.table];
    for (const std::uint32_t node : component)
      for (std::uint32_t arc = views.heads.first[node]; arc < views.heads.first[node + 1]; ++arc) {
        const std::uint32_t head = views.heads.entries[arc].other;
        if (views.components.of_node[head] == views.components.of_node[node] &&
            consumed_by(zone, arc, d) > 0)
          return true;
      }
    return false;
  }

  void sweep_most(std::uint32_t d) {
    std::ranges::fill(values_, -1);
    const auto raise = [&](std::uint32_t node, const Zone& zone, Value value) {
      const Value capped = std::min<Value>(value, largest_amount(zone.bounds[d]));
      values_[node] = std::max(values_[node], capped);
    };
    for (const Terminal& entry : graph_.entries)
      raise(entry.node, graph_.zones[graph_.zone_of(entry.node)], uses(entry.node, d));
    for (const Zone& zone : graph_.zones) {
      if (zone.table) raise_within(zone, d, raise);
      for_links_from(zone, [&](const Link& link, const Zone& next) {
        if (values_[link.from] < 0) return;
        raise(link.to, next, (next.resets[d] ? 0 : values_[link.from]) + uses(link.to, d));
      });
    }
  }

  template <class Raise>
  void raise_within(const Zone& zone, std::uint32_t d, Raise raise) {
    const TableViews& views = views_[*zone.table];
    for (std::size_t c = views.components.count(); c-- > 0;) {
      const auto component = views.components.nodes(c);
      Value most = -1;
      for (const std::uint32_t node : component)
        most = std::max(most, values_[zone.first_node + node]);
      if (most < 0) continue;
      if (is_consuming(zone, component, d)) most = kUnbounded;
      for (const std::uint32_t node : component) raise(zone.first_node + node, zone, most);
      for (const std::uint32_t node : component)
        for (std::uint32_t arc = views.heads.first[node]; arc < views.heads.first[node + 1]; ++arc)
          raise(zone.first_node + views.heads.entries[arc].other, zone,
                values_[zone.first_node + node] + consumed_by(zone, arc, d));
    }
  }

  void sweep_floor(std::uint32_t d) {
    std::ranges::fill(values_, kNone);
    for (const Terminal& exit : graph_.exits)
      lower(exit.node, graph_.zones[graph_.zone_of(exit.node)].bounds[d].min);
    for (std::size_t z = graph_.zones.size(); z-- > 0;) {
      const Zone& zone = graph_.zones[z];
      for_links_from(zone, [&](const Link& link, const Zone& next) {
        if (values_[link.to] == kNone) return;
        const Value value = std::max<Value>(0, values_[link.to] - uses(link.to, d));
        if (!next.resets[d]) lower(link.from, value);
        if (next.resets[d] && value == 0) lower(link.from, zone.bounds[d].min);
      });
      if (zone.table) lower_within(zone, d);
    }
  }

  void lower_within(const Zone& zone, std::uint32_t d) {
    const TableViews& views = views_[*zone.table];
    for (std::size_t c = 0; c < views.components.count(); ++c) {
      const auto component = views.components.nodes(c);
      Value least = kNone;
      for (const std::uint32_t node : component) {
        least = std::min(least, values_[zone.first_node + node]);
        for (std::uint32_t arc = views.heads.first[node]; arc < views.heads.first[node + 1];
             ++arc) {
          const Value beyond = values_[zone.first_node + views.heads.entries[arc].other];
          if (beyond != kNone)
            least = std::min(least, std::max<Value>(0, beyond - consumed_by(zone, arc, d)));
        }
      }
      if (least == kNone) continue;
      if (is_consuming(zone, component, d)) least = 0;
      for (const std::uint32_t node : component) values_[zone.first_node + node] = least;
    }
  }

  template <class Convert>
  void write(std::vector<Amount>& rows, std::uint32_t d, Convert convert) const {
    for (std::size_t node = 0; node < values_.size(); ++node)
      rows[node * graph_.dimension_count + d] = static_cast<Amount>(convert(values_[node]));
  }

  /// Nothing has to be reached: every path that comes and ends will do.
  void write_without_minimum(ResourceBounds& out, std::uint32_t d) const {
    for (const Zone& zone : graph_.zones) {
      for (std::uint32_t node = zone.first_node; node < zone.first_node + zone.size; ++node) {
        const std::size_t row = std::size_t{node} * graph_.dimension_count + d;
        out.most[row] = out.least[row] == kUnbounded ? -1 : largest_amount(zone.bounds[d]);
        out.floor[row] = out.ceiling[row] < 0 ? kUnbounded : 0;
      }
    }
  }

  const SearchGraph& graph_;
  std::vector<TableViews> views_;
  std::vector<Value> values_;  ///< by node: of the row that is being swept
  std::vector<std::pair<Value, std::uint32_t>> heap_;
};

}  // namespace

bool ResourceBounds::may_end(std::uint32_t node, std::span<const Amount> consumed) const {
  const std::size_t row = std::size_t{node} * dimension_count;
  if (cost_to_exit[node] == kNoWay) return false;
  for (std::uint32_t d = 0; d < dimension_count; ++d)
    if (consumed[d] < floor[row + d] || consumed[d] > ceiling[row + d]) return false;
  return true;
}

ResourceBounds resource_bounds(const SearchGraph& graph) { return Sweeper(graph)(); }

}  // namespace plat::sequences
