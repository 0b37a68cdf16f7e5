#include "sequences/costs_to_go.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "core/failure.h"

namespace plat::sequences {
namespace {

Cost saturating_add(Cost a, Cost b) { return std::min(kInfinite<Cost>, a + b); }

Cost saturating_product(std::uint64_t a, Cost b) {
  std::int64_t product = 0;
  if (a > static_cast<std::uint64_t>(kInfinite<Cost>) ||
      __builtin_mul_overflow(static_cast<std::int64_t>(a), b, &product))
    return kInfinite<Cost>;
  return std::min(kInfinite<Cost>, product);
}

/// No best path takes more arcs than this inside the zone: every `least` quanta one arc at most, or
/// every node once between two rows.
std::uint64_t max_arcs(const Zone& zone, const ZoneLayers& layers) {
  const std::size_t width = layers.highest.size();
  std::uint64_t span = 1;
  for (std::size_t d = 0; d < width; ++d)
    span += static_cast<std::uint64_t>(layers.highest[d] - layers.lowest[d]);
  std::uint64_t most = span * zone.size;
  for (std::size_t d = 0; d < width; ++d) {
    if (layers.saturates[d]) continue;
    Amount least = kUnbounded;
    for (std::size_t c = 0; c < layers.class_count; ++c)
      least = std::min(least, layers.class_uses[c * width + d]);
    if (least == 0) continue;
    most = std::min(most, static_cast<std::uint64_t>(layers.highest[d] - layers.lowest[d]) /
                                  static_cast<std::uint64_t>(least) +
                              1);
  }
  return most;
}

Cost largest_cost(const TransitionTable& table) {
  Cost largest = 0;
  for (const auto& arc : table.arcs) largest = std::max(largest, arc.cost);
  return largest;
}

}  // namespace

Cost path_cost_bound(const SearchGraph& graph, const LayerPlan& plan) {
  std::vector<Cost> dearest;
  for (const TransitionTable& table : graph.tables) dearest.push_back(largest_cost(table));
  Cost ends = 0;
  for (const Terminal& entry : graph.entries) ends = std::max(ends, entry.cost);
  Cost bound = ends;
  ends = 0;
  for (const Terminal& exit : graph.exits) ends = std::max(ends, exit.cost);
  bound = saturating_add(bound, ends);
  for (std::size_t z = 0; z < graph.zones.size(); ++z) {
    const ZoneLayers& layers = plan.zones[z];
    Cost link = 0;
    for (std::uint32_t l = layers.first_link; l < layers.last_link; ++l)
      link = std::max(link, graph.links[l].cost);
    bound = saturating_add(bound, link);
    if (layers.row_count == 0 || !graph.zones[z].table) continue;
    bound = saturating_add(bound, saturating_product(max_arcs(graph.zones[z], layers),
                                                     dearest[*graph.zones[z].table]));
  }
  return saturating_add(bound, 1);
}

template <class Value>
struct CostsToGo<Value>::Scratch {
  std::vector<Amount> consumed;
  std::vector<Amount> carried;
  std::vector<Row> targets;     ///< by class: the row behind it
  std::vector<Value> addends;   ///< by node: its cost-to-go behind the arc
  std::vector<Value> passages;  ///< by link target
  std::vector<std::pair<Value, std::uint32_t>> heap;
};

/// Takes what is within the slack, and remembers the least beyond.
template <class Value>
struct CostsToGo<Value>::Collector {
  Cost max_slack = 0;
  std::vector<Continuation>& out;
  std::optional<Cost> beyond;

  void add(StateId to, Cost slack, const Step& step) {
    if (slack <= max_slack)
      out.push_back({to, slack, step});
    else if (!beyond || slack < *beyond)
      beyond = slack;
  }
};

template <class Value>
CostsToGo<Value>::CostsToGo(const SearchGraph& graph, const LayerPlan& plan)
    : graph_(graph), plan_(plan), reverses_(graph.tables.size()) {
  for (std::size_t z = 0; z < graph.zones.size(); ++z) {
    ZoneTable table;
    table.first = value_count_;
    table.stride = graph.zones[z].size;
    value_count_ += table.stride * plan.zones[z].row_count;
    tables_.push_back(table);
  }
}

template <class Value>
void CostsToGo<Value>::compute() {
  values_ = std::make_unique_for_overwrite<Value[]>(value_count_);
  Scratch scratch;
  scratch.consumed.resize(graph_.dimension_count);
  for (std::size_t z = graph_.zones.size(); z-- > 0;) fill_zone(z, scratch);
}

template <class Value>
void CostsToGo<Value>::fill_zone(std::size_t zone, Scratch& scratch) {
  const ZoneLayers& layers = plan_.zones[zone];
  for (Row row = layers.row_count; row-- > 0;) {
    Value* values = row_values(zone, row);
    std::fill_n(values, tables_[zone].stride, kInfinite<Value>);
    layers.consumed(row, scratch.consumed);
    add_exits(zone, scratch.consumed, values);
    add_links(zone, scratch, values);
    if (!graph_.zones[zone].table) continue;
    find_targets(zone, scratch);
    relax_arcs(zone, row, scratch, values);
    settle_row(zone, row, scratch, values);
  }
}

template <class Value>
void CostsToGo<Value>::add_exits(std::size_t zone, std::span<const Amount> consumed,
                                 Value* values) const {
  const Zone& here = graph_.zones[zone];
  if (!may_end(here, consumed)) return;
  for (auto exit = std::ranges::lower_bound(graph_.exits, here.first_node, {}, &Terminal::node);
       exit != graph_.exits.end() && exit->node < here.first_node + here.size; ++exit)
    values[exit->node - here.first_node] = static_cast<Value>(exit->cost);
}

template <class Value>
void CostsToGo<Value>::add_links(std::size_t zone, Scratch& scratch, Value* values) {
  const ZoneLayers& layers = plan_.zones[zone];
  if (layers.targets.empty()) return;
  const Zone& here = graph_.zones[zone];
  scratch.passages.assign(layers.targets.size(), kInfinite<Value>);
  bool is_open = false;
  for (std::size_t t = 0; t < layers.targets.size(); ++t) {
    const std::uint32_t next = layers.target_zones[t];
    scratch.carried = scratch.consumed;
    if (!carry_over(here, graph_.zones[next], scratch.carried)) continue;
    const Row row = plan_.zones[next].row_after(scratch.carried, graph_.uses(layers.targets[t]));
    if (row == kNoRow) continue;
    scratch.passages[t] = at(next, row, layers.targets[t]);
    is_open = is_open || scratch.passages[t] < kInfinite<Value>;
  }
  if (!is_open) return;
  for (std::uint32_t l = layers.first_link; l < layers.last_link; ++l) {
    const Value onwards = scratch.passages[layers.target_of[l - layers.first_link]];
    if (onwards == kInfinite<Value>) continue;
    Value& value = values[graph_.links[l].from - here.first_node];
    value = std::min(value, static_cast<Value>(graph_.links[l].cost + onwards));
  }
  arcs_relaxed_ += layers.last_link - layers.first_link;
}

/// The row behind each class of uses.
template <class Value>
void CostsToGo<Value>::find_targets(std::size_t zone, Scratch& scratch) const {
  const ZoneLayers& layers = plan_.zones[zone];
  scratch.targets.resize(layers.class_count);
  const std::size_t width = graph_.dimension_count;
  for (std::size_t c = 0; c < layers.class_count; ++c)
    scratch.targets[c] =
        layers.row_after(scratch.consumed, std::span(layers.class_uses).subspan(c * width, width));
}

template <class Value>
void CostsToGo<Value>::relax_arcs(std::size_t zone, Row own, Scratch& scratch, Value* values) {
  const ZoneLayers& layers = plan_.zones[zone];
  const Zone& here = graph_.zones[zone];
  const TransitionTable& table = graph_.tables[*here.table];
  arcs_relaxed_ += table.arcs.size();
  if (!table.arc_uses.empty()) {
    for (std::uint32_t tail = 0; tail < here.size; ++tail) {
      for (std::uint32_t a = table.first[tail]; a < table.first[tail + 1]; ++a) {
        const Row target = scratch.targets[layers.class_of[a]];
        if (target == kNoRow || target == own) continue;
        const Value onwards = row_values(zone, target)[table.arcs[a].head];
        if (onwards == kInfinite<Value>) continue;
        values[tail] = std::min(values[tail], static_cast<Value>(table.arcs[a].cost + onwards));
      }
    }
    return;
  }
  scratch.addends.resize(here.size);
  for (std::uint32_t head = 0; head < here.size; ++head) {
    const Row target = scratch.targets[layers.class_of[head]];
    scratch.addends[head] =
        target == kNoRow || target == own ? kInfinite<Value> : row_values(zone, target)[head];
  }
  for (std::uint32_t tail = 0; tail < here.size; ++tail) {
    Value least = values[tail];
    for (std::uint32_t a = table.first[tail]; a < table.first[tail + 1]; ++a) {
      const Value sum =
          static_cast<Value>(table.arcs[a].cost) + scratch.addends[table.arcs[a].head];
      least = sum < least ? sum : least;
    }
    values[tail] = least;
  }
}

template <class Value>
const typename CostsToGo<Value>::ReverseTable& CostsToGo<Value>::reverse(std::uint32_t table) {
  if (reverses_[table]) return *reverses_[table];
  const TransitionTable& forward = graph_.tables[table];
  ReverseTable reversed;
  reversed.first.assign(forward.node_count() + 1, 0);
  for (const auto& arc : forward.arcs) ++reversed.first[arc.head + 1];
  for (std::size_t n = 0; n < forward.node_count(); ++n) reversed.first[n + 1] += reversed.first[n];
  reversed.arc.resize(forward.arcs.size());
  reversed.tail.resize(forward.arcs.size());
  std::vector<std::uint32_t> next = reversed.first;
  for (std::uint32_t tail = 0; tail < forward.node_count(); ++tail) {
    for (std::uint32_t a = forward.first[tail]; a < forward.first[tail + 1]; ++a) {
      const std::uint32_t place = next[forward.arcs[a].head]++;
      reversed.arc[place] = a;
      reversed.tail[place] = tail;
    }
  }
  reverses_[table] = std::move(reversed);
  return *reverses_[table];
}

/// Arcs that consume nothing that is told apart stay in their row, where they may form circles:
/// Dijkstra's algorithm over the nodes of the row, from what the other rows gave them.
template <class Value>
void CostsToGo<Value>::settle_row(std::size_t zone, Row row, Scratch& scratch, Value* values) {
  if (std::ranges::find(scratch.targets, row) == scratch.targets.end()) return;
  const ZoneLayers& layers = plan_.zones[zone];
  const std::uint32_t table_index = *graph_.zones[zone].table;
  const TransitionTable& table = graph_.tables[table_index];
  const bool is_by_arc = !table.arc_uses.empty();
  const ReverseTable& reversed = reverse(table_index);
  const auto stays = [&](std::uint32_t arc, std::uint32_t head) {
    return scratch.targets[layers.class_of[is_by_arc ? arc : head]] == row;
  };
  auto& heap = scratch.heap;
  heap.clear();
  const auto order = std::greater<std::pair<Value, std::uint32_t>>{};
  for (std::uint32_t node = 0; node < graph_.zones[zone].size; ++node)
    if (values[node] < kInfinite<Value> && (is_by_arc || stays(0, node)))
      heap.emplace_back(values[node], node);
  std::ranges::make_heap(heap, order);
  while (!heap.empty()) {
    std::ranges::pop_heap(heap, order);
    const auto [value, head] = heap.back();
    heap.pop_back();
    if (value > values[head]) continue;
    for (std::uint32_t k = reversed.first[head]; k < reversed.first[head + 1]; ++k) {
      const std::uint32_t tail = reversed.tail[k];
      if (!stays(reversed.arc[k], head)) continue;
      const auto sum = static_cast<Value>(table.arcs[reversed.arc[k]].cost + value);
      if (sum >= values[tail]) continue;
      values[tail] = sum;
      if (!is_by_arc && !stays(0, tail)) continue;
      heap.emplace_back(sum, tail);
      std::ranges::push_heap(heap, order);
    }
  }
}

template <class Value>
std::optional<Cost> CostsToGo<Value>::best_cost() const {
  std::optional<Cost> best;
  const std::vector<Amount> none(graph_.dimension_count, 0);
  for (const Terminal& entry : graph_.entries) {
    const std::uint32_t zone = graph_.zone_of(entry.node);
    const Row row = plan_.zones[zone].row_after(none, graph_.uses(entry.node));
    if (row == kNoRow || at(zone, row, entry.node) == kInfinite<Value>) continue;
    const Cost cost = entry.cost + at(zone, row, entry.node);
    if (!best || cost < *best) best = cost;
  }
  return best;
}

template <class Value>
StateId CostsToGo<Value>::state_of(std::size_t zone, Row row, std::uint32_t node) const {
  return tables_[zone].first + row * tables_[zone].stride + (node - graph_.zones[zone].first_node);
}

template <class Value>
std::optional<Cost> CostsToGo<Value>::continue_from(StateId state, Cost max_slack,
                                                    std::vector<Continuation>& out) const {
  Collector collector{max_slack, out, std::nullopt};
  if (state == kPathStart) {
    begin(collector);
    return collector.beyond;
  }
  const auto after = std::ranges::upper_bound(tables_, state, {}, &ZoneTable::first);
  const auto zone = static_cast<std::size_t>(after - tables_.begin()) - 1;
  const auto row = static_cast<Row>((state - tables_[zone].first) / tables_[zone].stride);
  const auto local =
      static_cast<std::uint32_t>((state - tables_[zone].first) % tables_[zone].stride);
  const std::uint32_t node = graph_.zones[zone].first_node + local;
  const Cost own = at(zone, row, node);
  std::vector<Amount> consumed(graph_.dimension_count);
  plan_.zones[zone].consumed(row, consumed);
  const auto exit = std::ranges::lower_bound(graph_.exits, node, {}, &Terminal::node);
  if (exit != graph_.exits.end() && exit->node == node && may_end(graph_.zones[zone], consumed))
    collector.add(kPathEnd, exit->cost - own, {});
  if (graph_.zones[zone].table) follow_arcs(zone, local, consumed, own, collector);
  follow_links(zone, node, consumed, own, collector);
  return collector.beyond;
}

template <class Value>
void CostsToGo<Value>::begin(Collector& collector) const {
  const auto best = best_cost();
  if (!best) return;
  std::vector<std::uint32_t> order(graph_.entries.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t e) { return graph_.entries[e].node; });
  const std::vector<Amount> none(graph_.dimension_count, 0);
  for (const std::uint32_t e : order) {
    const Terminal& entry = graph_.entries[e];
    const std::uint32_t zone = graph_.zone_of(entry.node);
    const Row row = plan_.zones[zone].row_after(none, graph_.uses(entry.node));
    if (row == kNoRow || at(zone, row, entry.node) == kInfinite<Value>) continue;
    collector.add(state_of(zone, row, entry.node), entry.cost + at(zone, row, entry.node) - *best,
                  {entry.node, e});
  }
}

template <class Value>
void CostsToGo<Value>::follow_arcs(std::size_t zone, std::uint32_t tail,
                                   std::span<const Amount> consumed, Cost own,
                                   Collector& collector) const {
  const ZoneLayers& layers = plan_.zones[zone];
  const Zone& here = graph_.zones[zone];
  const TransitionTable& table = graph_.tables[*here.table];
  const std::size_t width = graph_.dimension_count;
  for (std::uint32_t a = table.first[tail]; a < table.first[tail + 1]; ++a) {
    const std::uint32_t head = table.arcs[a].head;
    const std::size_t c = layers.class_of[table.arc_uses.empty() ? head : a];
    const Row row =
        layers.row_after(consumed, std::span(layers.class_uses).subspan(c * width, width));
    if (row == kNoRow) continue;
    const Value onwards = at(zone, row, here.first_node + head);
    if (onwards == kInfinite<Value>) continue;
    collector.add(state_of(zone, row, here.first_node + head), table.arcs[a].cost + onwards - own,
                  {here.first_node + head, a});
  }
}

template <class Value>
void CostsToGo<Value>::follow_links(std::size_t zone, std::uint32_t node,
                                    std::span<const Amount> consumed, Cost own,
                                    Collector& collector) const {
  const auto [first, last] = graph_.links_from(node);
  std::vector<Amount> carried;
  for (std::uint32_t l = first; l < last; ++l) {
    const std::uint32_t to = graph_.links[l].to;
    const std::uint32_t next = graph_.zone_of(to);
    carried.assign(consumed.begin(), consumed.end());
    if (!carry_over(graph_.zones[zone], graph_.zones[next], carried)) continue;
    const Row row = plan_.zones[next].row_after(carried, graph_.uses(to));
    if (row == kNoRow || at(next, row, to) == kInfinite<Value>) continue;
    collector.add(state_of(next, row, to), graph_.links[l].cost + at(next, row, to) - own, {to, l});
  }
}

template class CostsToGo<std::int32_t>;
template class CostsToGo<std::int64_t>;

}  // namespace plat::sequences
