#include "sequences/expanded_graph_internal.h"

#include <algorithm>
#include <utility>

namespace plat::sequences::detail {
namespace {

class Expansion {
 public:
  Expansion(const SearchGraph& graph, std::optional<std::uint32_t> split)
      : graph_(graph), split_(split) {
    for (const Zone& zone : graph.zones) {
      bases_.push_back(out_.nodes.size());
      for (Amount level = 0; level < levels(zone); ++level)
        for (std::uint32_t local = 0; local < zone.size; ++local)
          out_.nodes.push_back(zone.first_node + local);
    }
  }

  Expanded operator()() {
    for (std::uint32_t z = 0; z < graph_.zones.size(); ++z)
      for (Amount level = 0; level < levels(graph_.zones[z]); ++level)
        for (std::uint32_t local = 0; local < graph_.zones[z].size; ++local)
          add_edges_from(z, level, local);
    for (std::uint32_t entry = 0; entry < graph_.entries.size(); ++entry) {
      const Terminal& terminal = graph_.entries[entry];
      add_edge(out_.source(), graph_.zone_of(terminal.node), terminal.node, 0, 0,
               {terminal.cost, entry, Way::kEntry});
    }
    out_.graph = Graph(boost::edges_are_sorted, ends_.begin(), ends_.end(), meanings_.begin(),
                       out_.nodes.size() + 2);
    return std::move(out_);
  }

 private:
  [[nodiscard]] Amount levels(const Zone& zone) const {
    return split_ ? largest_amount(zone.bounds[*split_]) + 1 : 1;
  }

  /// To a node with `before` consumed of the dimension to split by, where its maximum allows.
  void add_edge(std::size_t from, std::uint32_t z, std::uint32_t node, Amount before,
                Amount arc_used, const EdgeMeaning& meaning) {
    const Zone& zone = graph_.zones[z];
    Amount level = 0;
    if (split_) {
      const Bounds& bounds = zone.bounds[*split_];
      auto sum = add_amount(bounds, before, graph_.uses(node)[*split_]);
      if (sum) sum = add_amount(bounds, *sum, arc_used);
      if (!sum) return;
      level = *sum;
    }
    const std::size_t row = static_cast<std::size_t>(level) * zone.size;
    ends_.emplace_back(from, bases_[z] + row + (node - zone.first_node));
    meanings_.push_back(meaning);
  }

  void add_edges_from(std::uint32_t z, Amount level, std::uint32_t local) {
    const Zone& zone = graph_.zones[z];
    const std::uint32_t node = zone.first_node + local;
    const std::size_t from = bases_[z] + static_cast<std::size_t>(level) * zone.size + local;
    if (zone.table) {
      const TransitionTable& table = graph_.tables[*zone.table];
      for (std::uint32_t arc = table.first[local]; arc < table.first[local + 1]; ++arc) {
        const std::size_t row = std::size_t{arc} * graph_.dimension_count;
        const Amount used = split_ && !table.arc_uses.empty() ? table.arc_uses[row + *split_] : 0;
        add_edge(from, z, zone.first_node + table.arcs[arc].head, level, used,
                 {table.arcs[arc].cost, arc, Way::kArc});
      }
    }
    const auto [first, last] = graph_.links_from(node);
    for (std::uint32_t l = first; l < last; ++l) {
      const Link& link = graph_.links[l];
      const std::uint32_t next = graph_.zone_of(link.to);
      const bool is_reset = split_ && graph_.zones[next].resets[*split_];
      add_edge(from, next, link.to, is_reset ? 0 : level, 0, {link.cost, l, Way::kLink});
    }
    const auto exit = std::ranges::lower_bound(graph_.exits, node, {}, &Terminal::node);
    if (exit == graph_.exits.end() || exit->node != node) return;
    ends_.emplace_back(from, out_.sink());
    meanings_.push_back({exit->cost, 0, Way::kExit});
  }

  const SearchGraph& graph_;
  std::optional<std::uint32_t> split_;
  Expanded out_;
  std::vector<std::size_t> bases_;  ///< by zone: its first vertex
  std::vector<std::pair<std::size_t, std::size_t>> ends_;
  std::vector<EdgeMeaning> meanings_;
};

}  // namespace

Expanded expanded(const SearchGraph& graph, std::optional<std::uint32_t> split) {
  return Expansion(graph, split)();
}

}  // namespace plat::sequences::detail
