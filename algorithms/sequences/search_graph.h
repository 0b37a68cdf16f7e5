#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace plat::sequences {

/// A transition cost in whole quanta of the problem's cost step: sums are exact, so that every
/// strategy finds the same costs to the last bit (ADR 0017).
using Cost = std::int64_t;
/// An amount of a resource in whole quanta of the resource's step [Har, Sec. 3.3.1].
using Amount = std::int32_t;
inline constexpr Amount kUnbounded = std::numeric_limits<Amount>::max();

/// What may be consumed of one resource, both ends included.
struct Bounds {
  Amount min = 0;
  Amount max = kUnbounded;
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// The arcs among the nodes of a zone, by local index; shared by all zones that hold the same
/// elements walked in the same direction.
struct TransitionTable {
  struct Arc {
    std::uint32_t head = 0;
    Cost cost = 0;
  };
  std::vector<std::uint32_t> first;  ///< n + 1 offsets into `arcs`: the arcs that leave a node
  std::vector<Arc> arcs;             ///< of one tail: by head, then as given; parallel arcs allowed
  std::vector<Amount> arc_uses;      ///< arcs x dimensions, beside the head's; empty: all zero
  [[nodiscard]] std::uint32_t node_count() const {
    return static_cast<std::uint32_t>(first.size()) - 1;
  }
};

/// Nodes that share their bounds: the elements between two key points, or those at a key point.
struct Zone {
  std::uint32_t first_node = 0;  ///< its nodes are first_node .. first_node + size - 1
  std::uint32_t size = 0;
  std::optional<std::uint32_t> table;  ///< the arcs among its nodes; none: there are none
  /// By dimension: `max` is never exceeded here; `min` is asked for where the dimension is reset by
  /// the next zone, and where a path ends.
  std::vector<Bounds> bounds;
  std::vector<bool> resets;  ///< by dimension: starts from zero when the zone is entered by a link
};

/// Where a path may begin or end.
struct Terminal {
  std::uint32_t node = 0;
  Cost cost = 0;
};

/// An arc from a zone to a later one.
struct Link {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Cost cost = 0;
};

/// A resource-constrained shortest path problem, compiled: what every `SequenceSearch` works on.
///
/// A path begins at an entry, follows table arcs within zones and links to later zones, and ends at
/// an exit. Entering a node by whatever way consumes `uses(node)`; a table arc consumes its own
/// `arc_uses` too; an entry starts from zero. A dimension is one resource in one scope (the whole
/// path, or each zone that resets it). One zone, one table and every node with its element's
/// resource vector is the problem of [Har, Sec. 3.2]; a structure of key points, branches and loops
/// is unrolled to many zones [Har, Sec. 3.3.4].
///
/// Guarantees, checked by `validate`: 1. costs and uses are not negative;  2. links lead to later
/// zones;  3. offsets, sizes and indices agree;  4. no cycle of arcs without a cost consumes
/// nothing bounded: else there would be infinitely many paths of one cost;  5. a link that does not
/// reset a dimension never leads from a zone without its maximum to one with a maximum or a larger
/// minimum, which would ask for what the first zone did not count (`largest_amount`).
struct SearchGraph {
  std::uint32_t dimension_count = 0;
  std::vector<Zone> zones;  ///< in the order in which a path meets them; at least one
  std::vector<TransitionTable> tables;
  std::vector<Amount> node_uses;  ///< nodes x dimensions
  std::vector<Terminal> entries;  ///< by node
  std::vector<Terminal> exits;    ///< by node, each node at most once
  std::vector<Link> links;        ///< by (from, to)

  [[nodiscard]] std::uint32_t node_count() const {
    return zones.empty() ? 0 : zones.back().first_node + zones.back().size;
  }
  [[nodiscard]] std::span<const Amount> uses(std::uint32_t node) const {
    return {node_uses.data() + std::size_t{node} * dimension_count, dimension_count};
  }
  /// The zone that holds `node`, by bisection.
  [[nodiscard]] std::uint32_t zone_of(std::uint32_t node) const;
  /// The links that leave `node`: indices first .. second - 1 of `links`.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> links_from(std::uint32_t node) const;
};

/// @throws LogicError for a graph whose numbers do not fit together (guarantees 1-3 and 5)
/// @throws InputError naming the nodes of a cycle that costs and consumes nothing (guarantee 4)
void validate(const SearchGraph& graph);

/// The largest amount that tells two states of a zone apart: `max`, or `min` where there is no
/// maximum (more than the minimum is as good as the minimum), or 0 where nothing is bounded.
Amount largest_amount(const Bounds& bounds);
/// `consumed + used` as a zone remembers it, or nothing where that exceeds the maximum.
std::optional<Amount> add_amount(const Bounds& bounds, Amount consumed, Amount used);

}  // namespace plat::sequences
