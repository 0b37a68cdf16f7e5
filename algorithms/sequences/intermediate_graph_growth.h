#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/failure.h"
#include "sequences/consumption.h"
#include "sequences/resource_bounds.h"
#include "sequences/search_graph.h"
#include "sequences/state_groups.h"
#include "sequences/zone_arcs.h"

namespace plat::sequences {

/// How far the growth of an intermediate graph may go.
struct GrowthLimits {
  std::uint64_t max_states = 50'000'000;    ///< states held, dead ends included
  std::uint64_t max_bytes = 4'000'000'000;  ///< held while growing and pruning, roughly
  /// Growth from the end begins with every vector that a path may end with. Where that would be
  /// more than so many states, the graph is grown from the front alone, and comes out the same.
  std::uint64_t max_end_states = 100'000;
  /// Where given, states are not created that cannot end well by these, and growth is from the
  /// front alone. Must outlive the growth.
  const ResourceBounds* bounds = nullptr;
};

/// The states of an intermediate graph, as sets of nodes by group.
struct GrownStates {
  StateGroups groups;
  std::vector<std::size_t> first_word;  ///< groups + 1 offsets into the sets
  std::vector<std::uint64_t> forward;   ///< reached from an entry
  std::vector<std::uint64_t> backward;  ///< reached from an exit
  std::vector<std::uint64_t> alive;     ///< left after pruning
  std::vector<std::uint32_t> order;     ///< all groups, topologically
  std::uint64_t created = 0;            ///< states that were in the graph before pruning
  std::uint64_t expanded = 0;

  [[nodiscard]] NodeBits of_group(const std::vector<std::uint64_t>& set,
                                  std::uint32_t group) const {
    return NodeBits(set).subspan(first_word[group], first_word[group + 1] - first_word[group]);
  }
};

/// Grows the states of a search graph from its entries and its exits until both meet, and takes
/// dead ends away [Har, Sec. 3.3.1].
///
/// Guarantees: 1. what is alive is what lies on a feasible path, wherever the two sides meet;
/// 2. groups are expanded in the order of their consumed vectors, from the front ascending, from
/// the end descending, one at a time in turn.
/// Paper:     [Har, Sec. 3.3.1-3.3.3, Function 1]
/// Deviation: a state that both sides reach is expanded by the side that gets to its vector, not by
///            the side that was there first: else paths are lost (ADR 0019)
class IntermediateGraphGrowth {
 public:
  /// The arguments must outlive the growth.
  IntermediateGraphGrowth(const Consumption& consumption, const AllZoneArcs& arcs,
                          const GrowthLimits& limits);
  /// @returns Failure kTooManyStates beyond the limit
  Expected<GrownStates> run();

 private:
  enum class Reach : std::uint8_t { kCreate, kMark };
  enum Flag : std::uint8_t { kQueuedForward = 1, kQueuedBackward = 2, kExpandedForward = 4 };

  [[nodiscard]] bool grows_backward() const;
  [[nodiscard]] std::uint64_t bytes() const;
  [[nodiscard]] bool is_too_large() const {
    return states_.created > limits_.max_states || bytes() > limits_.max_bytes;
  }
  void enter();
  void leave();
  void grow();
  void expand_forward(std::uint32_t group, Reach reach);
  void follow_arcs(std::uint32_t group, const ZoneArcs& arcs, NodeBits tails, Reach reach);
  void follow_links(std::uint32_t group, std::uint32_t tail, Reach reach);
  [[nodiscard]] bool may_end(std::uint32_t node, std::span<const Amount> consumed) const {
    return limits_.bounds == nullptr || limits_.bounds->may_end(node, consumed);
  }
  bool may_go_on(std::uint32_t group, std::span<const Amount> used, std::uint32_t head);
  void reach_forward(std::uint32_t group, std::uint32_t node, Reach reach);
  [[nodiscard]] std::uint32_t target_of(std::uint32_t group, std::uint32_t arc_class,
                                        const ZoneArcs& arcs, Reach reach);
  [[nodiscard]] std::uint32_t target_of(std::uint32_t group, const Link& link, Reach reach);
  void expand_backward(std::uint32_t group);
  void retrace_arcs(std::uint32_t group, const ZoneArcs& arcs, NodeBits heads);
  void retrace_links(std::uint32_t group, std::uint32_t head);
  void reach_backward(std::uint32_t zone, std::span<const Amount> consumed, NodeBits tails);
  [[nodiscard]] std::vector<std::uint64_t>& reached(Reach reach) {
    return reach == Reach::kCreate ? states_.forward : marked_;
  }
  void prune();
  void prune_backward(std::uint32_t group);
  [[nodiscard]] bool leads_on(std::uint32_t group, std::uint32_t tail, const ZoneArcs* arcs);
  std::uint32_t group_of(std::uint32_t zone, std::span<const Amount> consumed);
  void forget_targets(const ZoneArcs* arcs);
  void push(std::vector<std::uint32_t>& queue, std::uint32_t group, Flag flag);
  std::uint32_t pop(std::vector<std::uint32_t>& queue);

  const SearchGraph& graph_;
  const Consumption& consumption_;
  const AllZoneArcs& arcs_;
  GrowthLimits limits_;
  GrownStates states_;
  bool is_bidirectional_ = false;
  std::vector<std::uint64_t> marked_;  ///< while pruning: what entries reach, as a set of states
  std::vector<std::uint8_t> flags_;    ///< by group
  std::vector<std::uint32_t> forward_queue_;            ///< a heap, least vector on top
  std::vector<std::uint32_t> backward_queue_;           ///< a heap, greatest vector on top
  std::vector<std::vector<std::uint32_t>> links_into_;  ///< by node
  std::vector<std::vector<Amount>> greatest_uses_;      ///< by zone
  std::vector<std::pair<std::uint64_t, std::uint32_t>> targets_;  ///< by class: when, group
  std::uint64_t now_ = 0;
  std::vector<Amount> scratch_;
};

}  // namespace plat::sequences
