#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/failure.h"
#include "sequences/consumption.h"
#include "sequences/intermediate_graph_growth.h"
#include "sequences/search_graph.h"
#include "sequences/state_groups.h"
#include "sequences/zone_arcs.h"

namespace plat::sequences {

/// The intermediate graph: its states are (node, consumed vector), its paths from an entry to an
/// exit are the feasible paths of the search graph, and no others. States are stored, arcs are
/// found when they are asked for: all states of a node share its arcs, heads are found by their
/// signature.
///
/// Guarantees: 1. the states are those on a feasible path, each once: the nodes of the thesis's
/// construction after its prunings;  2. states are numbered in a topological order, but for arcs
/// within a group, which consume nothing.
/// Complexity:    O(states + groups x arc classes) memory, no arc is stored
/// Paper:         [Har, Sec. 3.3.1-3.3.3]; a state is its N(e, l, rc)
/// Deviation:     arcs that consume, minima without maxima and zones are part of the graph (ADR
/// 0019)
class IntermediateGraph {
 public:
  /// @param graph  must outlive the result
  /// @returns      Failure kTooManyStates beyond the limits
  static Expected<IntermediateGraph> build(const SearchGraph& graph, const GrowthLimits& limits);

  [[nodiscard]] const SearchGraph& search_graph() const { return *graph_; }
  [[nodiscard]] std::uint32_t state_count() const {
    return static_cast<std::uint32_t>(nodes_.size());
  }
  /// How many states growth made, dead ends included.
  [[nodiscard]] std::uint64_t created_count() const { return states_.created; }
  [[nodiscard]] std::uint64_t expanded_count() const { return states_.expanded; }
  [[nodiscard]] std::uint64_t bytes() const;

  /// The node of the search graph that a state places.
  [[nodiscard]] std::uint32_t node(std::uint32_t state) const { return nodes_[state]; }
  [[nodiscard]] std::uint32_t group(std::uint32_t state) const { return groups_[state]; }
  [[nodiscard]] std::span<const Amount> consumed(std::uint32_t state) const {
    return states_.groups.consumed(groups_[state]);
  }
  /// What had been consumed before the state, summed over the dimensions: the l of [Har].
  [[nodiscard]] std::int64_t level(std::uint32_t state) const;

  /// All groups, topologically; those without a state, too.
  [[nodiscard]] std::span<const std::uint32_t> group_order() const { return states_.order; }
  [[nodiscard]] std::uint32_t zone_of_group(std::uint32_t group) const {
    return states_.groups.zone(group);
  }
  /// Its states: first .. second - 1, by node.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> states_of(std::uint32_t group) const {
    return {first_state_[group], first_state_[group] + state_count_[group]};
  }
  /// The arcs of the zone's table, or none.
  [[nodiscard]] const ZoneArcs* arcs_of_zone(std::uint32_t zone) const {
    return arcs_->of_zone(zone);
  }

  static constexpr std::uint32_t kNoState = ~std::uint32_t{0};
  /// The group to which the arcs of a class lead, or `StateGroups::kNone`.
  [[nodiscard]] std::uint32_t target_group(std::uint32_t group, const ZoneArcs& arcs,
                                           std::uint32_t arc_class) const;
  /// The state of a node, by its index in the zone, in a group (which may be kNone).
  [[nodiscard]] std::uint32_t state_in(std::uint32_t group, std::uint32_t local) const;
  /// The state to which a link leads.
  [[nodiscard]] std::uint32_t target_state(std::uint32_t state, const Link& link) const;
  /// The state in which an entry begins.
  [[nodiscard]] std::uint32_t entry_state(const Terminal& entry) const;
  /// The exit with which a path may end in the state, as index.
  [[nodiscard]] std::optional<std::uint32_t> exit_of(std::uint32_t state) const;
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> links_from(std::uint32_t node) const {
    return consumption_->links_from(node);
  }

  /// Calls `visit(arc, head, cost)` for the arcs and links that leave a state: arcs as in the
  /// table, then links.
  template <class Visit>
  void for_each_arc(std::uint32_t state, Visit visit) const {
    const std::uint32_t from = groups_[state];
    const std::uint32_t zone = states_.groups.zone(from);
    if (const ZoneArcs* arcs = arcs_->of_zone(zone); arcs != nullptr) {
      const std::uint32_t local = consumption_->local(nodes_[state]);
      const TransitionTable& table = arcs->table();
      for (std::uint32_t arc = table.first[local]; arc < table.first[local + 1]; ++arc) {
        const std::uint32_t to = target_group(from, *arcs, arcs->class_of(arc));
        const std::uint32_t head = state_in(to, table.arcs[arc].head);
        if (head != kNoState) visit(arc, head, table.arcs[arc].cost);
      }
    }
    const auto [first, last] = links_from(nodes_[state]);
    for (std::uint32_t link = first; link < last; ++link) {
      const std::uint32_t head = target_state(state, graph_->links[link]);
      if (head != kNoState) visit(link, head, graph_->links[link].cost);
    }
  }

 private:
  IntermediateGraph(const SearchGraph& graph, std::unique_ptr<const Consumption> consumption,
                    std::unique_ptr<const AllZoneArcs> arcs, GrownStates states);
  void number_states();

  const SearchGraph* graph_;
  std::unique_ptr<const Consumption> consumption_;
  std::unique_ptr<const AllZoneArcs> arcs_;
  GrownStates states_;
  std::vector<std::uint32_t> nodes_;        ///< by state
  std::vector<std::uint32_t> groups_;       ///< by state
  std::vector<std::uint32_t> first_state_;  ///< by group
  std::vector<std::uint32_t> state_count_;  ///< by group
};

}  // namespace plat::sequences
