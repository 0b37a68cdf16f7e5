#include "sequences/costs_to_go.h"

#include <algorithm>
#include <numeric>

namespace plat::sequences {

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
CostsToGo<Value>::CostsToGo(const SearchGraph& graph, const LayerPlan& plan,
                            const CostTable<Value>& table)
    : graph_(graph), plan_(plan), table_(table) {}

template <class Value>
std::optional<Cost> CostsToGo<Value>::best_cost() const {
  std::optional<Cost> best;
  const std::vector<Amount> none(graph_.dimension_count, 0);
  for (const Terminal& entry : graph_.entries) {
    const std::uint32_t zone = graph_.zone_of(entry.node);
    const Row row = plan_.zones[zone].row_after(none, graph_.uses(entry.node));
    if (row == kNoRow) continue;
    const Value onwards = table_.value(zone, row, entry.node - graph_.zones[zone].first_node);
    if (onwards == kInfinite<Value>) continue;
    const Cost cost = entry.cost + onwards;
    if (!best || cost < *best) best = cost;
  }
  return best;
}

template <class Value>
std::optional<Cost> CostsToGo<Value>::continue_from(StateId state, Cost max_slack,
                                                    std::vector<Continuation>& out) const {
  Collector collector{max_slack, out, std::nullopt};
  if (state == kPathStart) {
    begin(collector);
    return collector.beyond;
  }
  const std::size_t zone = table_.zone_of(state);
  const auto [row, local] = table_.row_and_node(state, zone);
  const std::uint32_t node = graph_.zones[zone].first_node + local;
  const Cost own = table_.value(zone, row, local);
  std::vector<Amount> consumed(graph_.dimension_count);
  plan_.zones[zone].consumed(row, consumed);
  const auto exit = std::ranges::lower_bound(graph_.exits, node, {}, &Terminal::node);
  if (exit != graph_.exits.end() && exit->node == node && may_end(graph_.zones[zone], consumed))
    collector.add(kPathEnd, exit->cost - own, {});
  if (graph_.zones[zone].table) follow_arcs(zone, local, consumed, own, collector);
  follow_links(zone, node, consumed, own, collector);
  return collector.beyond;
}

/// The way on by `step` to a row, if a path ends from there. `slack`: without the cost-to-go.
template <class Value>
void CostsToGo<Value>::add(Collector& collector, std::size_t zone, Row row, Cost slack,
                           const Step& step) const {
  const std::size_t local = step.node - graph_.zones[zone].first_node;
  const Value onwards = table_.value(zone, row, local);
  if (onwards == kInfinite<Value>) return;
  collector.add(table_.index(zone, row, local), slack + onwards, step);
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
    if (row != kNoRow) add(collector, zone, row, entry.cost - *best, {entry.node, e});
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
    if (row != kNoRow)
      add(collector, zone, row, table.arcs[a].cost - own, {here.first_node + head, a});
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
    if (row != kNoRow) add(collector, next, row, graph_.links[l].cost - own, {to, l});
  }
}

template class CostsToGo<std::int32_t>;
template class CostsToGo<std::int64_t>;

}  // namespace plat::sequences
