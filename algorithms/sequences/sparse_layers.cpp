#include "sequences/sparse_layers.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace plat::sequences {

SparseLayers::SparseLayers(const SearchGraph& graph)
    : graph_(graph),
      consumption_(graph),
      bounds_(resource_bounds(graph)),
      states_(graph, 0),
      consumed_(graph.dimension_count),
      next_(graph.dimension_count),
      used_(graph.dimension_count) {
  std::vector<std::uint32_t> order(graph.entries.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t e) { return graph.entries[e].node; });
  for (const std::uint32_t e : order) {
    const Terminal& entry = graph.entries[e];
    std::ranges::fill(next_, 0);
    if (!consumption_.add(consumption_.zone_of(entry.node), next_, graph.uses(entry.node)))
      continue;
    if (const auto state = reach(entry.node, entry.cost))
      starts_.push_back({*state, e, entry.cost});
  }
}

std::uint64_t SparseLayers::bytes_held() const {
  return states_.bytes_held() + state_.capacity() * sizeof(State) + ways_.capacity() * sizeof(Way) +
         queue_.bytes_held();
}

bool SparseLayers::grow(std::uint64_t states, std::uint64_t max_bytes, std::uint64_t max_arcs) {
  while (!queue_.empty()) {
    const auto [key, id] = queue_.pop();
    const auto cost = static_cast<Cost>(key);
    if (cost > limit_) {
      // All states up to the limit are expanded: is that enough?
      const bool is_enough = expanded_ >= states && best_end_ <= limit_;
      if (is_enough || bytes_held() > max_bytes || arcs_followed_ > max_arcs) {
        queue_.push(key, id);
        return is_enough;
      }
      limit_ = cost;
    }
    if (!state_[id].is_expanded) expand(id);
    constexpr std::uint64_t kCheckedEvery = 1024;
    if (expanded_ % kCheckedEvery == 0 && bytes_held() > max_bytes) return false;
    if (arcs_followed_ > max_arcs) return false;
  }
  limit_ = kNoWay;
  return true;
}

void SparseLayers::expand(StateIndex::Id id) {
  const std::uint32_t node = states_.state(id, consumed_);
  const std::uint32_t zone = consumption_.zone_of(node);
  ++expanded_;
  so_far_ = state_[id].so_far;
  state_[id].is_expanded = true;
  state_[id].first_way = ways_.size();
  const auto exit = std::ranges::lower_bound(graph_.exits, node, {}, &Terminal::node);
  if (exit != graph_.exits.end() && exit->node == node && consumption_.may_end(zone, consumed_)) {
    state_[id].exit = exit->cost;
    best_end_ = std::min(best_end_, so_far_ + exit->cost);
  }
  if (graph_.zones[zone].table) follow_arcs(zone, node);
  follow_links(node);
  state_[id].way_count = static_cast<std::uint32_t>(ways_.size() - state_[id].first_way);
}

void SparseLayers::follow_arcs(std::uint32_t zone, std::uint32_t node) {
  const std::uint32_t first_node = graph_.zones[zone].first_node;
  const TransitionTable& table = graph_.tables[*graph_.zones[zone].table];
  const std::size_t width = graph_.dimension_count;
  const std::uint32_t tail = node - first_node;
  for (std::uint32_t a = table.first[tail]; a < table.first[tail + 1]; ++a) {
    ++arcs_followed_;
    const std::uint32_t head = first_node + table.arcs[a].head;
    if (bounds_.cost_to_exit[head] == kNoWay) continue;
    next_ = consumed_;
    if (!consumption_.add(zone, next_, graph_.uses(head))) continue;
    if (!table.arc_uses.empty() &&
        !consumption_.add(zone, next_, std::span(table.arc_uses).subspan(a * width, width)))
      continue;
    add_way(head, a, table.arcs[a].cost);
  }
}

void SparseLayers::follow_links(std::uint32_t node) {
  const auto [first, last] = consumption_.links_from(node);
  for (std::uint32_t l = first; l < last; ++l) {
    ++arcs_followed_;
    next_ = consumed_;
    if (consumption_.follow(graph_.links[l], next_))
      add_way(graph_.links[l].to, l, graph_.links[l].cost);
  }
}

void SparseLayers::add_way(std::uint32_t node, std::uint32_t arc, Cost cost) {
  if (const auto to = reach(node, so_far_ + cost)) ways_.push_back({*to, arc, cost});
}

std::optional<StateIndex::Id> SparseLayers::reach(std::uint32_t node, Cost cost) {
  if (!bounds_.may_end(node, next_)) return std::nullopt;
  const StateIndex::Id id = states_.id(consumption_.zone_of(node), node, next_.data());
  if (id == state_.size()) state_.push_back({.node = node});
  if (cost < state_[id].so_far) {
    state_[id].so_far = cost;
    queue_.push(static_cast<std::uint64_t>(cost + bounds_.cost_to_exit[node]), id);
  }
  return id;
}

void SparseLayers::settle() {
  // The ways by the states that they lead to.
  std::vector<std::size_t> first(state_.size() + 1, 0);
  for (const Way& way : ways_) ++first[way.to + 1];
  for (std::size_t s = 0; s < state_.size(); ++s) first[s + 1] += first[s];
  std::vector<std::pair<StateIndex::Id, Cost>> back(ways_.size());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<std::pair<Cost, StateIndex::Id>> heap;
  for (StateIndex::Id s = 0; s < state_.size(); ++s) {
    for (std::size_t w = 0; w < state_[s].way_count; ++w) {
      const Way& way = ways_[state_[s].first_way + w];
      back[next[way.to]++] = {s, way.cost};
    }
    state_[s].to_go = state_[s].exit;
    if (state_[s].exit != kNoWay) heap.emplace_back(state_[s].exit, s);
  }
  std::ranges::make_heap(heap, std::greater<>{});
  while (!heap.empty()) {
    std::ranges::pop_heap(heap, std::greater<>{});
    const auto [to_go, id] = heap.back();
    heap.pop_back();
    if (to_go > state_[id].to_go) continue;
    for (std::size_t b = first[id]; b < first[id + 1]; ++b) {
      const auto [tail, cost] = back[b];
      if (to_go + cost >= state_[tail].to_go) continue;
      state_[tail].to_go = to_go + cost;
      heap.emplace_back(to_go + cost, tail);
      std::ranges::push_heap(heap, std::greater<>{});
    }
  }
}

std::optional<Cost> SparseLayers::best_cost() const {
  Cost best = kNoWay;
  for (const Start& start : starts_)
    if (state_[start.state].to_go != kNoWay)
      best = std::min(best, start.cost + state_[start.state].to_go);
  return best == kNoWay ? std::nullopt : std::optional(best);
}

std::optional<Cost> SparseLayers::continue_from(StateId state, Cost max_slack,
                                                std::vector<Continuation>& out) const {
  std::optional<Cost> beyond;
  const auto add = [&](StateId to, Cost slack, const Step& step) {
    if (slack <= max_slack)
      out.push_back({to, slack, step});
    else if (!beyond || slack < *beyond)
      beyond = slack;
  };
  if (state == kPathStart) {
    const auto best = best_cost();
    for (const Start& start : starts_)
      if (best && state_[start.state].to_go != kNoWay)
        add(start.state, start.cost + state_[start.state].to_go - *best,
            {state_[start.state].node, start.entry});
    return beyond;
  }
  const State& here = state_[state];
  if (here.exit != kNoWay) add(kPathEnd, here.exit - here.to_go, {});
  for (std::size_t w = 0; w < here.way_count; ++w) {
    const Way& way = ways_[here.first_way + w];
    const State& next = state_[way.to];
    if (next.to_go != kNoWay) add(way.to, way.cost + next.to_go - here.to_go, {next.node, way.arc});
  }
  return beyond;
}

}  // namespace plat::sequences
