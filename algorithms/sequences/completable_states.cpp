#include "sequences/completable_states.h"

#include <algorithm>

namespace plat::sequences {

bool CompletableStates::may_end(std::uint32_t node, std::span<const Amount> consumed) {
  if (!bounds_.may_end(node, consumed)) return false;
  const std::uint32_t group = groups_.find(consumption_.zone_of(node), consumed);
  if (group != StateGroups::kNone)
    if (const auto known = status_.find(key(group, node)); known != status_.end())
      return known->second == Status::kAlive;
  if (status_.size() >= max_states_) return true;
  const bool is_completable = open(node, consumed) || search();
  settle(is_completable);
  return is_completable;
}

bool CompletableStates::open(std::uint32_t node, std::span<const Amount> consumed) {
  const std::uint32_t zone = consumption_.zone_of(node);
  const std::uint32_t group = groups_.insert(zone, consumed);
  way_.push_back({node, group});
  status_[key(group, node)] = Status::kOpen;
  return std::ranges::binary_search(graph_.exits, node, {}, &Terminal::node) &&
         consumption_.may_end(zone, consumed);
}

bool CompletableStates::search() {
  while (!way_.empty()) {
    std::uint32_t head = 0;
    if (!advance(way_.back(), head)) {
      const Frame left = way_.back();
      way_.pop_back();
      const std::uint64_t state = key(left.group, left.node);
      status_[state] = left.meets_open ? Status::kTentative : Status::kDead;
      if (left.meets_open) tentative_.push_back(state);
      if (left.meets_open && !way_.empty()) way_.back().meets_open = true;
      continue;
    }
    if (!bounds_.may_end(head, consumed_)) continue;
    const std::uint32_t group = groups_.insert(consumption_.zone_of(head), consumed_);
    if (const auto known = status_.find(key(group, head)); known != status_.end()) {
      if (known->second == Status::kAlive) return true;
      if (known->second != Status::kDead) way_.back().meets_open = true;
      continue;
    }
    if (open(head, std::vector<Amount>(consumed_))) return true;
  }
  return false;
}

bool CompletableStates::advance(Frame& frame, std::uint32_t& head) {
  const std::uint32_t zone_index = consumption_.zone_of(frame.node);
  const Zone& zone = graph_.zones[zone_index];
  const auto here = [&] {
    const auto consumed = groups_.consumed(frame.group);
    consumed_.assign(consumed.begin(), consumed.end());
  };
  std::uint32_t arcs = 0;
  if (zone.table) {
    const TransitionTable& table = graph_.tables[*zone.table];
    const std::uint32_t local = frame.node - zone.first_node;
    arcs = table.first[local + 1] - table.first[local];
    while (frame.next < arcs) {
      here();
      const std::uint32_t arc = table.first[local] + frame.next++;
      head = zone.first_node + table.arcs[arc].head;
      if (consumption_.follow_arc(zone_index, arc, consumed_)) return true;
    }
  }
  const auto [first, last] = consumption_.links_from(frame.node);
  while (frame.next - arcs < last - first) {
    here();
    const Link& link = graph_.links[first + frame.next++ - arcs];
    head = link.to;
    if (consumption_.follow(link, consumed_)) return true;
  }
  return false;
}

/// The states on the way are alive, or there is none left. What led only to open states is dead
/// where none of them is alive, and else unknown again.
void CompletableStates::settle(bool is_completable) {
  for (const Frame& frame : way_) status_[key(frame.group, frame.node)] = Status::kAlive;
  for (const std::uint64_t state : tentative_) {
    if (is_completable)
      status_.erase(state);
    else
      status_[state] = Status::kDead;
  }
  way_.clear();
  tentative_.clear();
}

}  // namespace plat::sequences
