#include "sequences/graph_pruning.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace plat::sequences {
namespace {

/// Tells of each part of a graph whether a path can use it, by the bounds of its ends.
class Judge {
 public:
  Judge(const SearchGraph& graph, const ResourceBounds& bounds, std::optional<Cost> max_cost)
      : graph_(graph), bounds_(bounds), max_cost_(max_cost.value_or(kNoWay - 1)) {}

  [[nodiscard]] bool can_use_node(std::uint32_t node) const {
    if (!is_cheap(bounds_.cost_from_entry[node], 0, bounds_.cost_to_exit[node])) return false;
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d) {
      const Amount least = bounds_.least[row(node) + d];
      if (least == kUnbounded || !may_pass(node, d, least, bounds_.most[row(node) + d]))
        return false;
    }
    return true;
  }

  [[nodiscard]] bool can_use_arc(const Zone& zone, std::uint32_t tail, std::uint32_t arc) const {
    const TransitionTable& table = graph_.tables[*zone.table];
    const std::uint32_t head = zone.first_node + table.arcs[arc].head;
    if (!is_cheap(bounds_.cost_from_entry[tail], table.arcs[arc].cost, bounds_.cost_to_exit[head]))
      return false;
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d) {
      std::int64_t used = graph_.uses(head)[d];
      if (!table.arc_uses.empty())
        used += table.arc_uses[std::size_t{arc} * graph_.dimension_count + d];
      if (!may_pass(head, d, bounds_.least[row(tail) + d] + used,
                    bounds_.most[row(tail) + d] + used))
        return false;
    }
    return true;
  }

  [[nodiscard]] bool can_use_link(const Link& link) const {
    if (!is_cheap(bounds_.cost_from_entry[link.from], link.cost, bounds_.cost_to_exit[link.to]))
      return false;
    const Zone& from = graph_.zones[graph_.zone_of(link.from)];
    const Zone& to = graph_.zones[graph_.zone_of(link.to)];
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d) {
      if (to.resets[d] && bounds_.most[row(link.from) + d] < from.bounds[d].min) return false;
      const std::int64_t used = graph_.uses(link.to)[d];
      const std::int64_t least = to.resets[d] ? 0 : bounds_.least[row(link.from) + d];
      const std::int64_t most = to.resets[d] ? 0 : bounds_.most[row(link.from) + d];
      if (!may_pass(link.to, d, least + used, most + used)) return false;
    }
    return true;
  }

  [[nodiscard]] bool can_use_entry(const Terminal& entry) const {
    if (!is_cheap(entry.cost, 0, bounds_.cost_to_exit[entry.node])) return false;
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d) {
      const Amount used = graph_.uses(entry.node)[d];
      if (!may_pass(entry.node, d, used, used)) return false;
    }
    return true;
  }

  [[nodiscard]] bool can_use_exit(const Terminal& exit) const {
    if (!is_cheap(bounds_.cost_from_entry[exit.node], exit.cost, 0)) return false;
    const Zone& zone = graph_.zones[graph_.zone_of(exit.node)];
    for (std::uint32_t d = 0; d < graph_.dimension_count; ++d)
      if (bounds_.most[row(exit.node) + d] < zone.bounds[d].min) return false;
    return true;
  }

 private:
  [[nodiscard]] std::size_t row(std::uint32_t node) const {
    return std::size_t{node} * graph_.dimension_count;
  }
  [[nodiscard]] bool is_cheap(Cost before, Cost own, Cost after) const {
    return before != kNoWay && after != kNoWay && before + own + after <= max_cost_;
  }
  /// Whether some amount between `least` and `most` may be had at the node.
  [[nodiscard]] bool may_pass(std::uint32_t node, std::uint32_t d, std::int64_t least,
                              std::int64_t most) const {
    const Amount floor = bounds_.floor[row(node) + d];
    const Amount ceiling = bounds_.ceiling[row(node) + d];
    return floor != kUnbounded && most >= floor && (least <= ceiling || ceiling == kUnbounded);
  }

  const SearchGraph& graph_;
  const ResourceBounds& bounds_;
  Cost max_cost_;
};

constexpr std::uint32_t kGone = ~std::uint32_t{0};

/// One round: builds what a judge leaves of a graph.
class Rebuild {
 public:
  Rebuild(const PrunedGraph& from, const Judge& judge)
      : from_(from), graph_(from.graph), judge_(judge) {}

  PrunedGraph operator()() {
    out_.graph.dimension_count = graph_.dimension_count;
    keep_nodes();
    std::uint32_t next_zone = 0;
    for (const Zone& zone : graph_.zones) {
      if (!zone.table || new_size(zone) == 0) {
        next_zone += new_size(zone) > 0 ? 1 : 0;
        continue;
      }
      out_.graph.zones[next_zone++].table = table_of(zone);
    }
    keep_terminals();
    for (std::uint32_t link = 0; link < graph_.links.size(); ++link) {
      const Link& was = graph_.links[link];
      if (new_node(was.from) == kGone || new_node(was.to) == kGone || !judge_.can_use_link(was))
        continue;
      out_.graph.links.push_back({new_node(was.from), new_node(was.to), was.cost});
      out_.links.push_back(from_.links[link]);
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::uint32_t new_node(std::uint32_t node) const { return new_nodes_[node]; }
  [[nodiscard]] std::uint32_t new_size(const Zone& zone) const {
    const auto first = new_nodes_.begin() + zone.first_node;
    return static_cast<std::uint32_t>(
        std::count_if(first, first + zone.size, [](std::uint32_t node) { return node != kGone; }));
  }

  void keep_nodes() {
    for (const Zone& zone : graph_.zones) {
      Zone kept = zone;
      kept.first_node = static_cast<std::uint32_t>(out_.nodes.size());
      kept.table.reset();
      for (std::uint32_t node = zone.first_node; node < zone.first_node + zone.size; ++node) {
        const bool is_kept = judge_.can_use_node(node);
        new_nodes_.push_back(is_kept ? static_cast<std::uint32_t>(out_.nodes.size()) : kGone);
        if (!is_kept) continue;
        out_.nodes.push_back(from_.nodes[node]);
        const auto uses = graph_.uses(node);
        out_.graph.node_uses.insert(out_.graph.node_uses.end(), uses.begin(), uses.end());
      }
      kept.size = static_cast<std::uint32_t>(out_.nodes.size()) - kept.first_node;
      if (kept.size > 0) out_.graph.zones.push_back(std::move(kept));
    }
  }

  void keep_terminals() {
    for (std::uint32_t e = 0; e < graph_.entries.size(); ++e) {
      const Terminal& entry = graph_.entries[e];
      if (new_node(entry.node) == kGone || !judge_.can_use_entry(entry)) continue;
      out_.graph.entries.push_back({new_node(entry.node), entry.cost});
      out_.entries.push_back(from_.entries[e]);
    }
    for (const Terminal& exit : graph_.exits)
      if (new_node(exit.node) != kGone && judge_.can_use_exit(exit))
        out_.graph.exits.push_back({new_node(exit.node), exit.cost});
  }

  /// The zone's table with what is left of it; zones that keep the same of a table share it still.
  std::uint32_t table_of(const Zone& zone) {
    const TransitionTable& table = graph_.tables[*zone.table];
    std::vector<bool> kept(table.arcs.size() + zone.size);
    for (std::uint32_t tail = 0; tail < zone.size; ++tail) {
      if (new_node(zone.first_node + tail) == kGone) continue;
      kept[table.arcs.size() + tail] = true;
      for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc)
        kept[arc] = new_node(zone.first_node + table.arcs[arc].head) != kGone &&
                    judge_.can_use_arc(zone, zone.first_node + tail, arc);
    }
    const auto next = static_cast<std::uint32_t>(out_.graph.tables.size());
    const auto [found, is_new] = tables_.try_emplace({*zone.table, std::move(kept)}, next);
    if (is_new) add_table(zone, found->first.second);
    return found->second;
  }

  void add_table(const Zone& zone, const std::vector<bool>& kept) {
    const TransitionTable& table = graph_.tables[*zone.table];
    const std::uint32_t zone_start = *std::ranges::find_if(
        new_nodes_.begin() + zone.first_node, new_nodes_.begin() + zone.first_node + zone.size,
        [](std::uint32_t node) { return node != kGone; });
    TransitionTable added;
    added.first.push_back(0);
    std::vector<std::uint32_t> was;
    for (std::uint32_t tail = 0; tail < zone.size; ++tail) {
      if (!kept[table.arcs.size() + tail]) continue;
      for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc) {
        if (!kept[arc]) continue;
        const std::uint32_t head = new_node(zone.first_node + table.arcs[arc].head) - zone_start;
        added.arcs.push_back({head, table.arcs[arc].cost});
        was.push_back(from_.arcs[*zone.table][arc]);
        if (table.arc_uses.empty()) continue;
        const auto row = table.arc_uses.begin() +
                         static_cast<std::ptrdiff_t>(std::size_t{arc} * graph_.dimension_count);
        added.arc_uses.insert(added.arc_uses.end(), row, row + graph_.dimension_count);
      }
      added.first.push_back(static_cast<std::uint32_t>(added.arcs.size()));
    }
    out_.graph.tables.push_back(std::move(added));
    out_.arcs.push_back(std::move(was));
  }

  const PrunedGraph& from_;
  const SearchGraph& graph_;
  const Judge& judge_;
  PrunedGraph out_;
  std::vector<std::uint32_t> new_nodes_;  ///< by node of `graph_`; kGone: taken away
  std::map<std::pair<std::uint32_t, std::vector<bool>>, std::uint32_t> tables_;
};

std::vector<std::uint32_t> identity(std::size_t size) {
  std::vector<std::uint32_t> out(size);
  std::iota(out.begin(), out.end(), 0U);
  return out;
}

PrunedGraph unpruned(const SearchGraph& graph) {
  PrunedGraph out{graph,
                  {},
                  identity(graph.node_count()),
                  {},
                  identity(graph.entries.size()),
                  identity(graph.links.size())};
  for (const auto& table : graph.tables) out.arcs.push_back(identity(table.arcs.size()));
  return out;
}

/// How much there is: grows with every part.
std::size_t size_of(const SearchGraph& graph) {
  std::size_t size =
      graph.node_count() + graph.entries.size() + graph.exits.size() + graph.links.size();
  for (const Zone& zone : graph.zones)
    if (zone.table) size += graph.tables[*zone.table].arcs.size();
  return size;
}

}  // namespace

void PrunedGraph::restore(SequencePath& path) const {
  bool is_first = true;
  std::uint32_t zone = 0;
  for (Step& step : path.steps) {
    const std::uint32_t own_zone = graph.zone_of(step.node);
    if (is_first)
      step.arc = entries[step.arc];
    else if (own_zone != zone)
      step.arc = links[step.arc];
    else
      step.arc = arcs[*graph.zones[own_zone].table][step.arc];
    step.node = nodes[step.node];
    zone = own_zone;
    is_first = false;
  }
}

PrunedGraph prune(const SearchGraph& graph, std::optional<Cost> max_cost) {
  PrunedGraph pruned = unpruned(graph);
  while (true) {
    pruned.bounds = resource_bounds(pruned.graph);
    PrunedGraph next = Rebuild(pruned, Judge(pruned.graph, pruned.bounds, max_cost))();
    if (size_of(next.graph) == size_of(pruned.graph)) return pruned;
    pruned = std::move(next);
  }
}

}  // namespace plat::sequences
