#include "sequences/search_graph.h"

#include <algorithm>
#include <string>

#include "core/failure.h"
#include "sequences/free_cycle.h"

namespace plat::sequences {
namespace {

void validate_table(const SearchGraph& graph, const TransitionTable& table) {
  expects(!table.first.empty() && table.first.front() == 0, "offsets begin with 0");
  expects(std::ranges::is_sorted(table.first), "offsets do not decrease");
  expects(table.first.back() == table.arcs.size(), "offsets end with the number of arcs");
  for (const auto& arc : table.arcs) {
    expects(arc.cost >= 0, "an arc's cost is not negative");
    expects(arc.head < table.node_count(), "an arc's head is a node");
  }
  expects(
      table.arc_uses.empty() || table.arc_uses.size() == table.arcs.size() * graph.dimension_count,
      "one row of uses per arc");
  for (const Amount used : table.arc_uses) expects(used >= 0, "an arc's uses are not negative");
}

void validate_zones(const SearchGraph& graph) {
  std::uint32_t next = 0;
  for (const Zone& zone : graph.zones) {
    expects(zone.first_node == next && zone.size > 0, "zones follow one another");
    next += zone.size;
    expects(zone.bounds.size() == graph.dimension_count, "one pair of bounds per dimension");
    expects(zone.resets.size() == graph.dimension_count, "one reset flag per dimension");
    for (const Bounds& bounds : zone.bounds)
      expects(bounds.min >= 0 && bounds.min <= bounds.max && bounds.min < kUnbounded,
              "0 <= min <= max");
    if (!zone.table) continue;
    expects(*zone.table < graph.tables.size(), "a zone's table exists");
    expects(graph.tables[*zone.table].node_count() == zone.size, "a table fits its zone");
  }
}

void expect_no_free_cycle(const SearchGraph& graph, const Zone& zone) {
  std::string nodes;
  for (const std::uint32_t node : free_cycle(graph, zone))
    nodes += (nodes.empty() ? "" : ", ") + std::to_string(node);
  if (!nodes.empty()) throw InputError(std::string(kFreeCycle) + "; nodes: " + nodes);
}

/// What the zone behind the link asks for has been counted in the zone before it.
bool is_counted(const SearchGraph& graph, const Link& link) {
  const Zone& from = graph.zones[graph.zone_of(link.from)];
  const Zone& to = graph.zones[graph.zone_of(link.to)];
  for (std::uint32_t d = 0; d < graph.dimension_count; ++d) {
    if (to.resets[d] || from.bounds[d].max != kUnbounded) continue;
    if (to.bounds[d].max != kUnbounded || to.bounds[d].min > from.bounds[d].min) return false;
  }
  return true;
}

}  // namespace

std::uint32_t SearchGraph::zone_of(std::uint32_t node) const {
  const auto after = std::ranges::upper_bound(zones, node, {}, &Zone::first_node);
  return static_cast<std::uint32_t>(after - zones.begin()) - 1;
}

std::pair<std::uint32_t, std::uint32_t> SearchGraph::links_from(std::uint32_t node) const {
  const auto range = std::ranges::equal_range(links, node, {}, &Link::from);
  return {static_cast<std::uint32_t>(range.begin() - links.begin()),
          static_cast<std::uint32_t>(range.end() - links.begin())};
}

void validate(const SearchGraph& graph) {
  expects(!graph.zones.empty(), "a search graph has a zone");
  validate_zones(graph);
  for (const auto& table : graph.tables) validate_table(graph, table);
  expects(graph.node_uses.size() == std::size_t{graph.node_count()} * graph.dimension_count,
          "one row of uses per node");
  for (const Amount used : graph.node_uses) expects(used >= 0, "a node's uses are not negative");
  for (const auto& terminal : graph.entries)
    expects(terminal.node < graph.node_count() && terminal.cost >= 0, "entries are nodes");
  for (const auto& terminal : graph.exits)
    expects(terminal.node < graph.node_count() && terminal.cost >= 0, "exits are nodes");
  expects(std::ranges::adjacent_find(graph.exits, std::ranges::greater_equal{}, &Terminal::node) ==
              graph.exits.end(),
          "exits are sorted and unique");
  for (const auto& link : graph.links) {
    expects(link.from < graph.node_count() && link.to < graph.node_count(), "links join nodes");
    expects(link.cost >= 0, "a link's cost is not negative");
    expects(graph.zone_of(link.from) < graph.zone_of(link.to), "links lead to later zones");
    expects(is_counted(graph, link), "a dimension that goes on has been counted");
  }
  expects(std::ranges::is_sorted(graph.links, {}, &Link::from), "links are sorted");
  for (const Zone& zone : graph.zones)
    if (zone.table) expect_no_free_cycle(graph, zone);
}

Amount largest_amount(const Bounds& bounds) {
  return bounds.max == kUnbounded ? bounds.min : bounds.max;
}

std::optional<Amount> add_amount(const Bounds& bounds, Amount consumed, Amount used) {
  const std::int64_t sum = std::int64_t{consumed} + used;
  if (bounds.max == kUnbounded) return static_cast<Amount>(std::min<std::int64_t>(sum, bounds.min));
  if (sum > bounds.max) return std::nullopt;
  return static_cast<Amount>(sum);
}

}  // namespace plat::sequences
