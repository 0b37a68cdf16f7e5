#include "sequences/free_cycle.h"

namespace plat::sequences {
namespace {

/// An arc of the table that costs nothing and consumes nothing of what the zone bounds from above.
bool is_free(const SearchGraph& graph, const Zone& zone, const TransitionTable& table,
             std::size_t arc) {
  if (table.arcs[arc].cost > 0) return false;
  const auto uses = graph.uses(zone.first_node + table.arcs[arc].head);
  for (std::uint32_t d = 0; d < graph.dimension_count; ++d) {
    if (zone.bounds[d].max == kUnbounded) continue;
    if (uses[d] > 0) return false;
    if (!table.arc_uses.empty() && table.arc_uses[arc * graph.dimension_count + d] > 0)
      return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> free_cycle(const SearchGraph& graph, const Zone& zone) {
  if (!zone.table) return {};
  const TransitionTable& table = graph.tables[*zone.table];
  // Nodes without free arcs to the rest are taken away, until none is left or a cycle is.
  std::vector<std::vector<std::uint32_t>> tails(zone.size);
  std::vector<std::uint32_t> out(zone.size, 0);
  for (std::uint32_t tail = 0; tail < zone.size; ++tail) {
    for (std::size_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc) {
      if (!is_free(graph, zone, table, arc)) continue;
      tails[table.arcs[arc].head].push_back(tail);
      ++out[tail];
    }
  }
  std::vector<std::uint32_t> ready;
  for (std::uint32_t node = 0; node < zone.size; ++node)
    if (out[node] == 0) ready.push_back(node);
  std::size_t taken = 0;
  while (taken < ready.size())
    for (const std::uint32_t tail : tails[ready[taken++]])
      if (--out[tail] == 0) ready.push_back(tail);
  std::vector<std::uint32_t> left;
  for (std::uint32_t node = 0; node < zone.size; ++node)
    if (out[node] > 0) left.push_back(zone.first_node + node);
  return left;
}

}  // namespace plat::sequences
