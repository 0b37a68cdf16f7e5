#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "sequences/consumption.h"
#include "sequences/resource_bounds.h"
#include "sequences/state_groups.h"

namespace plat::sequences {

/// Tells whether a path that has come to a state can still end well, by looking for a way, depth
/// first, and keeping what it learns.
///
/// Guarantees: 1. "no" is always right, all resources together;  2. "yes" is right as long as it
/// keeps at most `max_states` states, and a guess for states not yet known from then on.
class CompletableStates {
 public:
  /// The arguments must outlive the object.
  CompletableStates(const Consumption& consumption, const ResourceBounds& bounds,
                    std::size_t max_states)
      : consumption_(consumption),
        graph_(consumption.graph()),
        bounds_(bounds),
        max_states_(max_states),
        groups_(graph_.dimension_count) {}

  bool may_end(std::uint32_t node, std::span<const Amount> consumed);

 private:
  /// Open: on the way that is being tried. Tentative: leads nowhere but to open states.
  enum class Status : std::uint8_t { kOpen, kTentative, kDead, kAlive };
  struct Frame {
    std::uint32_t node = 0;
    std::uint32_t group = 0;
    std::uint32_t next = 0;  ///< arcs that leave the node, then links: those tried
    bool meets_open = false;
  };

  /// Opens a state that is not known. @returns whether it can end by an exit of its own
  bool open(std::uint32_t node, std::span<const Amount> consumed);
  bool search();
  /// The next state to which the frame leads, into `consumed_`. @returns false where there is none
  bool advance(Frame& frame, std::uint32_t& head);
  void settle(bool is_completable);
  [[nodiscard]] static std::uint64_t key(std::uint32_t group, std::uint32_t node) {
    return std::uint64_t{group} << 32 | node;
  }

  const Consumption& consumption_;
  const SearchGraph& graph_;
  const ResourceBounds& bounds_;
  std::size_t max_states_;
  StateGroups groups_;
  std::unordered_map<std::uint64_t, Status> status_;
  std::vector<Frame> way_;
  std::vector<std::uint64_t> tentative_;
  std::vector<Amount> consumed_;
};

}  // namespace plat::sequences
