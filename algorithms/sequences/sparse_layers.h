#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sequences/consumption.h"
#include "sequences/monotone_queue.h"
#include "sequences/path_enumeration.h"
#include "sequences/resource_bounds.h"
#include "sequences/search_graph.h"
#include "sequences/state_index.h"

namespace plat::sequences {

/// The states that paths up to some cost can pass, and their costs-to-go: what takes the place of a
/// table where most of it would stay empty, as with many resources.
///
/// States grow from the entries in order of the least cost of a path through them, by the cost to
/// the exits without resources; those from which `resource_bounds` sees no feasible end are left
/// out. All states up to `limit()` are there, so that costs-to-go are exact for all paths that cost
/// no more; dearer ones may be missing.
///
/// Complexity: O(s a log) for s states with a arcs each
/// Paper:      [BC89] for the bounds, for all dimensions together here
class SparseLayers final : public CompletionSpace {
 public:
  explicit SparseLayers(const SearchGraph& graph);

  /// Grows until the best path is within the limit and `states` states have been expanded, or all.
  /// Stops early, and returns false, where more than `max_bytes` would be held or `max_arcs` be
  /// followed: then only growing on is allowed.
  bool grow(std::uint64_t states, std::uint64_t max_bytes, std::uint64_t max_arcs);
  /// Computes the costs-to-go of what has grown. Call before reading.
  void settle();

  /// Paths that cost no more are all there.
  [[nodiscard]] Cost limit() const { return limit_; }
  /// Whether all paths are there.
  [[nodiscard]] bool is_complete() const { return queue_.empty(); }
  [[nodiscard]] std::uint64_t states_created() const { return states_.size(); }
  [[nodiscard]] std::uint64_t states_expanded() const { return expanded_; }
  [[nodiscard]] std::uint64_t arcs_followed() const { return arcs_followed_; }
  [[nodiscard]] std::uint64_t bytes_held() const;

  [[nodiscard]] std::optional<Cost> best_cost() const override;
  std::optional<Cost> continue_from(StateId state, Cost max_slack,
                                    std::vector<Continuation>& out) const override;

 private:
  struct Way {
    StateIndex::Id to = 0;
    std::uint32_t arc = 0;
    Cost cost = 0;
  };
  struct State {
    std::uint32_t node = 0;
    std::uint32_t way_count = 0;
    std::size_t first_way = 0;
    Cost so_far = kNoWay;  ///< of the best way from an entry that is known
    Cost to_go = kNoWay;   ///< after `settle`
    Cost exit = kNoWay;    ///< for ending here
    bool is_expanded = false;
  };
  struct Start {
    StateIndex::Id state = 0;
    std::uint32_t entry = 0;
    Cost cost = 0;
  };

  void expand(StateIndex::Id id);
  void follow_arcs(std::uint32_t zone, std::uint32_t node);
  void follow_links(std::uint32_t node);
  /// The state at `node` with `next_`, or nothing where no path ends well from there.
  std::optional<StateIndex::Id> reach(std::uint32_t node, Cost cost);
  void add_way(std::uint32_t node, std::uint32_t arc, Cost cost);

  const SearchGraph& graph_;
  Consumption consumption_;
  ResourceBounds bounds_;
  StateIndex states_;
  std::vector<State> state_;  ///< by id
  std::vector<Way> ways_;     ///< of expanded states, as a path's order has them
  std::vector<Start> starts_;
  MonotoneQueue<StateIndex::Id> queue_;  ///< by the least cost of a path through the state
  std::vector<Amount> consumed_;
  std::vector<Amount> next_;
  std::vector<Amount> used_;
  Cost so_far_ = 0;  ///< of the state that is being expanded
  Cost limit_ = -1;
  Cost best_end_ = kNoWay;
  std::uint64_t expanded_ = 0;
  std::uint64_t arcs_followed_ = 0;
};

}  // namespace plat::sequences
