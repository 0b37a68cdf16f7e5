#include "sequences/intermediate_graph_growth.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>

namespace plat::sequences {
namespace {

void set_bit(std::span<std::uint64_t> bits, std::uint32_t index) {
  bits[index / 64] |= std::uint64_t{1} << (index % 64);
}

/// What of `bits` is not yet in `done`, which then holds it too; empty where nothing is new.
std::vector<std::uint64_t> take_fresh(NodeBits bits, std::vector<std::uint64_t>& done) {
  std::vector<std::uint64_t> fresh(bits.size());
  std::uint64_t any = 0;
  for (std::size_t w = 0; w < bits.size(); ++w) {
    fresh[w] = bits[w] & ~done[w];
    done[w] |= fresh[w];
    any |= fresh[w];
  }
  if (any == 0) fresh.clear();
  return fresh;
}

double size_of(std::span<const AmountRange> box) {
  double size = 1.0;
  for (const auto& range : box) size *= std::max(0.0, 1.0 + range.high - range.low);
  return size;
}

}  // namespace

IntermediateGraphGrowth::IntermediateGraphGrowth(const Consumption& consumption,
                                                 const AllZoneArcs& arcs,
                                                 const GrowthLimits& limits)
    : graph_(consumption.graph()),
      consumption_(consumption),
      arcs_(arcs),
      limits_(limits),
      states_{StateGroups(graph_.dimension_count), {0}, {}, {}, {}, {}} {
  links_into_.resize(graph_.node_count());
  for (std::uint32_t link = 0; link < graph_.links.size(); ++link)
    links_into_[graph_.links[link].to].push_back(link);
  for (const Zone& zone : graph_.zones) {
    auto& greatest = greatest_uses_.emplace_back(graph_.dimension_count, 0);
    for (std::uint32_t node = zone.first_node; node < zone.first_node + zone.size; ++node)
      for (std::uint32_t d = 0; d < graph_.dimension_count; ++d)
        greatest[d] = std::max(greatest[d], graph_.uses(node)[d]);
  }
}

Expected<GrownStates> IntermediateGraphGrowth::run() {
  enter();
  is_bidirectional_ = grows_backward();
  if (is_bidirectional_) leave();
  grow();
  if (is_too_large())
    return fail(FailureCode::kTooManyStates,
                std::to_string(states_.created) + " states, " + std::to_string(bytes() >> 20) +
                    " MiB, and more to come; raise max_states or max_memory_mib, use coarser "
                    "steps, narrower bounds or bounding=resources_and_cost");
  prune();
  return std::move(states_);
}

/// Four sets of states when pruning, two before.
std::uint64_t IntermediateGraphGrowth::bytes() const {
  return states_.groups.bytes() + 4 * states_.forward.size() * sizeof(std::uint64_t) +
         states_.groups.size() * (sizeof(std::size_t) + sizeof(std::uint32_t) + 1);
}

/// Whether few enough states may be the last before an exit or before a link that resets amounts.
bool IntermediateGraphGrowth::grows_backward() const {
  if (limits_.bounds != nullptr) return false;
  std::vector<AmountRange> box(graph_.dimension_count);
  double end_states = 0.0;
  for (const Terminal& exit : graph_.exits) {
    consumption_.at_end(consumption_.zone_of(exit.node), box);
    end_states += size_of(box);
  }
  for (const Link& link : graph_.links) {
    const std::uint32_t from = consumption_.zone_of(link.from);
    const auto& resets = graph_.zones[consumption_.zone_of(link.to)].resets;
    consumption_.at_end(from, box);
    for (std::size_t d = 0; d < box.size(); ++d)
      if (!resets[d]) box[d] = {0, 0};
    end_states += size_of(box);
  }
  return end_states <= static_cast<double>(limits_.max_end_states);
}

void IntermediateGraphGrowth::enter() {
  std::vector<Amount> consumed(graph_.dimension_count);
  for (const Terminal& entry : graph_.entries) {
    const std::uint32_t zone = consumption_.zone_of(entry.node);
    std::ranges::fill(consumed, 0);
    if (!consumption_.add(zone, consumed, graph_.uses(entry.node))) continue;
    if (!may_end(entry.node, consumed)) continue;
    reach_forward(group_of(zone, consumed), consumption_.local(entry.node), Reach::kCreate);
  }
}

/// The end levels: one set of last states for every vector that the bounds allow [Har, Sec. 3.3.3].
void IntermediateGraphGrowth::leave() {
  std::vector<AmountRange> box(graph_.dimension_count);
  for (const Terminal& exit : graph_.exits) {
    const std::uint32_t zone = consumption_.zone_of(exit.node);
    std::vector<std::uint64_t> node((graph_.zones[zone].size + 63) / 64, 0);
    set_bit(node, consumption_.local(exit.node));
    consumption_.at_end(zone, box);
    for_each_vector(box, [&](auto consumed) { reach_backward(zone, consumed, node); });
  }
}

void IntermediateGraphGrowth::grow() {
  const auto have_met = [&] {
    if (forward_queue_.empty()) return true;
    if (!is_bidirectional_) return false;
    return backward_queue_.empty() ||
           states_.groups.precedes(backward_queue_.front(), forward_queue_.front());
  };
  while (!have_met() && !is_too_large()) {
    expand_forward(pop(forward_queue_), Reach::kCreate);
    if (is_bidirectional_ && !have_met()) expand_backward(pop(backward_queue_));
  }
}

/// A group of states at once, again while arcs that consume nothing add to it.
void IntermediateGraphGrowth::expand_forward(std::uint32_t group, Reach reach) {
  const std::uint32_t zone = states_.groups.zone(group);
  const ZoneArcs* arcs = arcs_.of_zone(zone);
  flags_[group] |= kExpandedForward;
  forget_targets(arcs);
  auto take = [&, done = std::vector<std::uint64_t>((graph_.zones[zone].size + 63) / 64, 0)](
                  std::vector<std::uint64_t>& fresh) mutable {
    fresh = take_fresh(states_.of_group(reached(reach), group), done);
    return !fresh.empty();
  };
  for (std::vector<std::uint64_t> fresh; take(fresh);) {
    if (arcs != nullptr) follow_arcs(group, *arcs, fresh, reach);
    for_each_bit(fresh, [&](std::uint32_t tail) {
      follow_links(group, tail, reach);
      if (reach == Reach::kCreate) ++states_.expanded;
    });
  }
}

void IntermediateGraphGrowth::follow_arcs(std::uint32_t group, const ZoneArcs& arcs, NodeBits tails,
                                          Reach reach) {
  const auto go = [&](std::uint32_t arc_class, std::uint32_t head) {
    if (reach == Reach::kCreate && !may_go_on(group, arcs.used(arc_class), head)) return;
    const std::uint32_t target = target_of(group, arc_class, arcs, reach);
    if (target != StateGroups::kNone) reach_forward(target, head, reach);
  };
  if (arcs.is_by_head()) {
    std::vector<std::uint64_t> heads(tails.size(), 0);
    for_each_bit(tails, [&](std::uint32_t tail) {
      for (std::size_t w = 0; w < heads.size(); ++w) heads[w] |= arcs.successors(tail)[w];
    });
    for_each_bit(heads, [&](std::uint32_t head) { go(arcs.class_of_head(head), head); });
    return;
  }
  const TransitionTable& table = arcs.table();
  for_each_bit(tails, [&](std::uint32_t tail) {
    for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc)
      go(arcs.class_of(arc), table.arcs[arc].head);
  });
}

/// Asked before a group is made for the head, since most heads are refused where bounds are given.
bool IntermediateGraphGrowth::may_go_on(std::uint32_t group, std::span<const Amount> used,
                                        std::uint32_t head) {
  if (limits_.bounds == nullptr) return true;
  const std::uint32_t zone = states_.groups.zone(group);
  const auto here = states_.groups.consumed(group);
  scratch_.assign(here.begin(), here.end());
  return consumption_.add(zone, scratch_, used) &&
         may_end(graph_.zones[zone].first_node + head, scratch_);
}

void IntermediateGraphGrowth::follow_links(std::uint32_t group, std::uint32_t tail, Reach reach) {
  const std::uint32_t node = graph_.zones[states_.groups.zone(group)].first_node + tail;
  const auto [first, last] = consumption_.links_from(node);
  for (std::uint32_t link = first; link < last; ++link) {
    const std::uint32_t target = target_of(group, graph_.links[link], reach);
    if (target != StateGroups::kNone)
      reach_forward(target, consumption_.local(graph_.links[link].to), reach);
  }
}

void IntermediateGraphGrowth::reach_forward(std::uint32_t group, std::uint32_t node, Reach reach) {
  const bool is_backward = has_bit(states_.of_group(states_.backward, group), node);
  if (reach == Reach::kMark && !is_backward) return;
  if (has_bit(states_.of_group(reached(reach), group), node)) return;
  set_bit(std::span(reached(reach)).subspan(states_.first_word[group]), node);
  if (reach == Reach::kMark) return;
  if (!is_backward) ++states_.created;
  push(forward_queue_, group, kQueuedForward);
}

std::uint32_t IntermediateGraphGrowth::target_of(std::uint32_t group, std::uint32_t arc_class,
                                                 const ZoneArcs& arcs, Reach reach) {
  auto& [when, target] = targets_[arc_class];
  if (when == now_) return target;
  when = now_;
  target = StateGroups::kNone;
  const std::uint32_t zone = states_.groups.zone(group);
  const auto here = states_.groups.consumed(group);
  std::vector<Amount> consumed(here.begin(), here.end());
  if (consumption_.add(zone, consumed, arcs.used(arc_class)))
    target =
        reach == Reach::kCreate ? group_of(zone, consumed) : states_.groups.find(zone, consumed);
  return target;
}

std::uint32_t IntermediateGraphGrowth::target_of(std::uint32_t group, const Link& link,
                                                 Reach reach) {
  const auto here = states_.groups.consumed(group);
  std::vector<Amount> consumed(here.begin(), here.end());
  if (!consumption_.follow(link, consumed)) return StateGroups::kNone;
  if (reach == Reach::kCreate && !may_end(link.to, consumed)) return StateGroups::kNone;
  const std::uint32_t zone = consumption_.zone_of(link.to);
  return reach == Reach::kCreate ? group_of(zone, consumed) : states_.groups.find(zone, consumed);
}

void IntermediateGraphGrowth::expand_backward(std::uint32_t group) {
  const std::uint32_t zone = states_.groups.zone(group);
  const ZoneArcs* arcs = arcs_.of_zone(zone);
  std::vector<std::uint64_t> done((graph_.zones[zone].size + 63) / 64, 0);
  for (auto fresh = take_fresh(states_.of_group(states_.backward, group), done); !fresh.empty();
       fresh = take_fresh(states_.of_group(states_.backward, group), done)) {
    if (arcs != nullptr) retrace_arcs(group, *arcs, fresh);
    for_each_bit(fresh, [&](std::uint32_t head) {
      retrace_links(group, head);
      ++states_.expanded;
    });
  }
}

void IntermediateGraphGrowth::retrace_arcs(std::uint32_t group, const ZoneArcs& arcs,
                                           NodeBits heads) {
  const std::uint32_t zone = states_.groups.zone(group);
  const auto here = states_.groups.consumed(group);
  const std::vector<Amount> consumed(here.begin(), here.end());
  std::vector<AmountRange> box(graph_.dimension_count);
  const auto retrace = [&](std::uint32_t arc_class, NodeBits tails) {
    if (!consumption_.before_arc(zone, consumed, arcs.used(arc_class), box)) return;
    for_each_vector(box, [&](auto before) { reach_backward(zone, before, tails); });
  };
  std::vector<std::uint64_t> tail_bit(heads.size(), 0);
  for_each_bit(heads, [&](std::uint32_t head) {
    if (arcs.is_by_head()) {
      retrace(arcs.class_of_head(head), arcs.predecessors(head));
      return;
    }
    for (const auto& incoming : arcs.arcs_into(head)) {
      set_bit(tail_bit, incoming.tail);
      retrace(arcs.class_of(incoming.arc), tail_bit);
      tail_bit[incoming.tail / 64] = 0;
    }
  });
}

void IntermediateGraphGrowth::retrace_links(std::uint32_t group, std::uint32_t head) {
  const std::uint32_t node = graph_.zones[states_.groups.zone(group)].first_node + head;
  if (links_into_[node].empty()) return;
  const auto here = states_.groups.consumed(group);
  const std::vector<Amount> consumed(here.begin(), here.end());
  std::vector<AmountRange> box(graph_.dimension_count);
  for (const std::uint32_t link : links_into_[node]) {
    if (!consumption_.before_link(graph_.links[link], consumed, box)) continue;
    const std::uint32_t zone = consumption_.zone_of(graph_.links[link].from);
    std::vector<std::uint64_t> tail((graph_.zones[zone].size + 63) / 64, 0);
    set_bit(tail, consumption_.local(graph_.links[link].from));
    for_each_vector(box, [&](auto before) { reach_backward(zone, before, tail); });
  }
}

/// Underflow: a state has consumed what its own node uses, at least.
void IntermediateGraphGrowth::reach_backward(std::uint32_t zone, std::span<const Amount> consumed,
                                             NodeBits tails) {
  const auto limit = consumption_.limits(zone);
  const auto is_enough = [&](std::span<const Amount> uses) {
    for (std::size_t d = 0; d < uses.size(); ++d)
      if (consumed[d] < std::min(uses[d], limit[d].largest)) return false;
    return true;
  };
  std::vector<std::uint64_t> reached(tails.begin(), tails.end());
  if (!is_enough(greatest_uses_[zone])) {
    for_each_bit(tails, [&](std::uint32_t tail) {
      if (!is_enough(graph_.uses(graph_.zones[zone].first_node + tail)))
        reached[tail / 64] &= ~(std::uint64_t{1} << (tail % 64));
    });
  }
  if (std::ranges::all_of(reached, [](std::uint64_t word) { return word == 0; })) return;
  const std::uint32_t group = group_of(zone, consumed);
  std::uint64_t any = 0;
  for (std::size_t w = 0; w < reached.size(); ++w) {
    const std::size_t at = states_.first_word[group] + w;
    const std::uint64_t fresh = reached[w] & ~states_.backward[at];
    states_.backward[at] |= fresh;
    states_.created += static_cast<std::uint64_t>(std::popcount(fresh & ~states_.forward[at]));
    any |= fresh;
  }
  if (any != 0) push(backward_queue_, group, kQueuedBackward);
}

/// Dead ends: the forward half of what is alive is known where the growth from the front came, and
/// is marked among the states of the other side beyond; then, from the last group to the first,
/// those are alive that lead to an exit.
void IntermediateGraphGrowth::prune() {
  auto& order = states_.order;
  order.resize(states_.groups.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(
      order, [this](std::uint32_t a, std::uint32_t b) { return states_.groups.precedes(a, b); });
  marked_ = states_.forward;
  for (const std::uint32_t group : order) {
    if ((flags_[group] & kExpandedForward) != 0) continue;
    for (std::size_t at = states_.first_word[group]; at < states_.first_word[group + 1]; ++at)
      marked_[at] &= states_.backward[at];
    expand_forward(group, Reach::kMark);
  }
  states_.alive.assign(marked_.size(), 0);
  for (auto group = order.rbegin(); group != order.rend(); ++group) prune_backward(*group);
}

void IntermediateGraphGrowth::prune_backward(std::uint32_t group) {
  const std::uint32_t zone = states_.groups.zone(group);
  const ZoneArcs* arcs = arcs_.of_zone(zone);
  forget_targets(arcs);
  const auto alive = std::span(states_.alive).subspan(states_.first_word[group]);
  const bool is_end = consumption_.may_end(zone, states_.groups.consumed(group));
  std::vector<std::uint32_t> open;
  for_each_bit(states_.of_group(marked_, group), [&](std::uint32_t tail) {
    const std::uint32_t node = graph_.zones[zone].first_node + tail;
    if (is_end && std::ranges::binary_search(graph_.exits, node, {}, &Terminal::node))
      set_bit(alive, tail);
    else
      open.push_back(tail);
  });
  // Arcs that consume nothing lead to states of the group itself: until no more become alive.
  for (std::size_t before = open.size() + 1; open.size() < before;) {
    before = open.size();
    std::erase_if(open, [&](std::uint32_t tail) {
      const bool is_alive = leads_on(group, tail, arcs);
      if (is_alive) set_bit(alive, tail);
      return is_alive;
    });
  }
}

/// Whether an arc or a link leads from the state to one that is alive.
bool IntermediateGraphGrowth::leads_on(std::uint32_t group, std::uint32_t tail,
                                       const ZoneArcs* arcs) {
  const std::uint32_t node = graph_.zones[states_.groups.zone(group)].first_node + tail;
  if (arcs != nullptr) {
    const TransitionTable& table = arcs->table();
    for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc) {
      const std::uint32_t target = target_of(group, arcs->class_of(arc), *arcs, Reach::kMark);
      if (target == StateGroups::kNone) continue;
      if (has_bit(states_.of_group(states_.alive, target), table.arcs[arc].head)) return true;
    }
  }
  const auto [first, last] = consumption_.links_from(node);
  for (std::uint32_t link = first; link < last; ++link) {
    const Link& way = graph_.links[link];
    const std::uint32_t target = target_of(group, way, Reach::kMark);
    if (target == StateGroups::kNone) continue;
    if (has_bit(states_.of_group(states_.alive, target), consumption_.local(way.to))) return true;
  }
  return false;
}

std::uint32_t IntermediateGraphGrowth::group_of(std::uint32_t zone,
                                                std::span<const Amount> consumed) {
  const std::uint32_t group = states_.groups.insert(zone, consumed);
  if (group < flags_.size()) return group;
  flags_.push_back(0);
  const std::size_t words = (graph_.zones[zone].size + 63) / 64;
  states_.first_word.push_back(states_.first_word.back() + words);
  states_.forward.resize(states_.first_word.back(), 0);
  states_.backward.resize(states_.first_word.back(), 0);
  return group;
}

void IntermediateGraphGrowth::forget_targets(const ZoneArcs* arcs) {
  ++now_;
  if (arcs != nullptr && targets_.size() < arcs->class_count())
    targets_.resize(arcs->class_count(), {0, StateGroups::kNone});
}

void IntermediateGraphGrowth::push(std::vector<std::uint32_t>& queue, std::uint32_t group,
                                   Flag flag) {
  if ((flags_[group] & (flag | (flag == kQueuedForward ? kExpandedForward : 0))) != 0) return;
  flags_[group] |= flag;
  queue.push_back(group);
  const bool is_forward = &queue == &forward_queue_;
  std::ranges::push_heap(queue, [&](std::uint32_t a, std::uint32_t b) {
    return is_forward ? states_.groups.precedes(b, a) : states_.groups.precedes(a, b);
  });
}

std::uint32_t IntermediateGraphGrowth::pop(std::vector<std::uint32_t>& queue) {
  const bool is_forward = &queue == &forward_queue_;
  std::ranges::pop_heap(queue, [&](std::uint32_t a, std::uint32_t b) {
    return is_forward ? states_.groups.precedes(b, a) : states_.groups.precedes(a, b);
  });
  const std::uint32_t group = queue.back();
  queue.pop_back();
  return group;
}

}  // namespace plat::sequences
