#include "sequences/path_enumeration.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/failure.h"

namespace plat::sequences {
namespace {

constexpr std::uint32_t kUnknownList = std::numeric_limits<std::uint32_t>::max();
/// A pass aims at so many times as many paths as the one before: what was found before is met
/// again.
constexpr std::size_t kGrowth = 4;
/// A pass may find so many times as many paths as it aimed at before its threshold is lowered.
constexpr std::size_t kTolerance = 8;
/// The ways beyond the threshold of which costs are noted at each state.
constexpr std::uint32_t kNotedCuts = 4;

}  // namespace

PathEnumeration::PathEnumeration(const CompletionSpace& space, Limits limits,
                                 std::optional<Cost> above)
    : space_(space), limits_(limits) {
  expects(limits_.batch_paths > 0, "a batch holds a path");
  const auto best = space_.best_cost();
  if (!best) return;
  best_ = *best;
  if (!above || *above < best_) {
    mode_ = Mode::kTies;
    begin_pass(best_);
    return;
  }
  // Only what it cuts matters of this pass.
  mode_ = Mode::kBatch;
  begin_pass(*above);
  while (advance()) continue;
}

std::uint64_t PathEnumeration::bytes_held() const {
  return continuations_.capacity() * sizeof(Continuation) + lists_.capacity() * sizeof(List) +
         list_of_state_.size() * 4 * sizeof(StateId) + records_.capacity() * sizeof(Record) +
         deviations_.capacity() * sizeof(Deviation) + cuts_.capacity() * sizeof(Cost);
}

bool PathEnumeration::next(SequencePath& path) {
  while (mode_ != Mode::kDone) {
    if (mode_ == Mode::kTies) {
      while (advance()) {
        if (found_ != threshold_) continue;
        write_stack(path);
        return true;
      }
    } else if (next_record_ < records_.size()) {
      write_record(records_[next_record_++], path);
      return true;
    }
    begin_next();
  }
  return false;
}

std::uint32_t PathEnumeration::list_of(StateId state) {
  const auto [known, is_new] =
      list_of_state_.try_emplace(state, static_cast<std::uint32_t>(lists_.size()));
  if (!is_new) return known->second;
  List list;
  list.first = continuations_.size();
  list.beyond = space_.continue_from(state, max_slack_, continuations_).value_or(kNever);
  list.count = static_cast<std::uint32_t>(continuations_.size() - list.first);
  const auto ways = std::span(continuations_).subspan(list.first);
  for (std::uint32_t i = 0; i < list.count; ++i) ways[i].ordinal = i;
  std::ranges::sort(ways, {}, [](const Continuation& c) { return std::pair(c.slack, c.ordinal); });
  expects(list.count > 0 && ways.front().slack == 0, "a state's best path goes on");
  lists_.push_back(list);
  return static_cast<std::uint32_t>(lists_.size() - 1);
}

/// The list of the state that a continuation leads to. May forget all other lists.
std::uint32_t PathEnumeration::follow(std::size_t continuation) {
  if (continuations_.size() <= limits_.list_entries) return list_behind(continuation);
  const StateId to = continuations_[continuation].to;
  forget_lists();
  for (Frame& frame : frames_) frame.list = list_of(frame.state);
  return list_of(to);
}

std::uint32_t PathEnumeration::list_behind(std::size_t continuation) {
  if (continuations_[continuation].list != kUnknownList) return continuations_[continuation].list;
  const std::uint32_t list = list_of(continuations_[continuation].to);
  continuations_[continuation].list = list;
  return list;
}

/// How much dearer than the best completion any other path from here is.
Cost PathEnumeration::apart(std::uint32_t list) {
  chain_.clear();
  Cost least = kNever;
  while (true) {
    if (lists_[list].apart != kUnknown) {
      least = lists_[list].apart;
      break;
    }
    chain_.push_back(list);
    const std::size_t best = lists_[list].first;
    if (continuations_[best].to == kPathEnd) break;
    list = list_behind(best);
  }
  for (std::size_t i = chain_.size(); i-- > 0;) {
    List& here = lists_[chain_[i]];
    least = std::min(least, here.count > 1 ? continuations_[here.first + 1].slack : here.beyond);
    here.apart = least;
  }
  return least;
}

void PathEnumeration::forget_lists() {
  continuations_.clear();
  lists_.clear();
  list_of_state_.clear();
}

void PathEnumeration::begin_pass(Cost threshold) {
  threshold_ = threshold;
  if (threshold - best_ > max_slack_) {
    // Wider than needed, so that not every pass has to look at all continuations again.
    max_slack_ = 2 * (threshold - best_);
    forget_lists();
  }
  cuts_.clear();
  worst_cut_ = std::numeric_limits<Cost>::max();
  frames_.clear();
  push_frame(kPathStart, list_of(kPathStart), best_);
}

/// Counts the ways within the threshold, and notes the next ones.
void PathEnumeration::push_frame(StateId state, std::uint32_t list, Cost cost) {
  Frame frame{state, cost, list};
  const List& ways = lists_[list];
  const Continuation* way = continuations_.data() + ways.first;
  while (frame.allowed < ways.count && cost + way[frame.allowed].slack <= threshold_)
    ++frame.allowed;
  const std::uint32_t noted = std::min(ways.count, frame.allowed + kNotedCuts);
  for (std::uint32_t i = frame.allowed; i < noted; ++i) note_cut(cost + way[i].slack);
  if (noted == ways.count && ways.beyond < kNever) note_cut(cost + ways.beyond);
  frames_.push_back(frame);
}

/// The next way in the order of steps; false where all are done.
bool PathEnumeration::choose(Frame& frame) const {
  const Continuation* ways = continuations_.data() + lists_[frame.list].first;
  std::uint32_t least = kUnknownList;
  for (std::uint32_t i = 0; i < frame.allowed; ++i) {
    if (ways[i].ordinal < frame.next_ordinal || ways[i].ordinal >= least) continue;
    least = ways[i].ordinal;
    frame.chosen = i;
  }
  frame.next_ordinal = least + 1;
  return least != kUnknownList;
}

/// Goes on to the next path within the threshold, in lexicographic order.
bool PathEnumeration::advance() {
  while (!frames_.empty()) {
    Frame& frame = frames_.back();
    if (!choose(frame)) {
      frames_.pop_back();
      continue;
    }
    const std::size_t chosen = lists_[frame.list].first + frame.chosen;
    const Cost cost = frame.cost + continuations_[chosen].slack;
    if (cost > threshold_) {
      note_cut(cost);
      continue;
    }
    ++steps_taken_;
    completion_.reset();
    found_ = cost;
    const StateId to = continuations_[chosen].to;
    if (to == kPathEnd) return true;
    const std::uint32_t next = follow(chosen);
    if (const Cost other = apart(next); cost + other > threshold_) {
      if (other < kNever) note_cut(cost + other);
      completion_ = next;
      return true;
    }
    push_frame(to, next, cost);
  }
  return false;
}

/// Remembers the cheapest of what was not followed.
void PathEnumeration::note_cut(Cost cost) {
  if (cost >= worst_cut_) return;
  cuts_.push_back(cost);
  const std::size_t kept = std::min(kGrowth * target_, limits_.batch_paths);  // the next target
  if (cuts_.size() < 2 * kept) return;
  std::ranges::nth_element(cuts_, cuts_.begin() + static_cast<std::ptrdiff_t>(kept - 1));
  cuts_.resize(kept);
  worst_cut_ = cuts_.back();
}

/// Every beginning that was cut has a path of just its cost: the next threshold lets about as many
/// pass as the next batch is to have.
void PathEnumeration::begin_next() {
  records_.clear();
  deviations_.clear();
  next_record_ = 0;
  mode_ = Mode::kDone;
  if (cuts_.empty()) return;
  const auto quantile = static_cast<std::ptrdiff_t>(std::min(target_, cuts_.size()) - 1);
  std::ranges::nth_element(cuts_, cuts_.begin() + quantile);
  const Cost above = threshold_;
  begin_pass(cuts_[static_cast<std::size_t>(quantile)]);
  mode_ = Mode::kBatch;
  collect(above, std::min(kTolerance * target_, limits_.batch_paths));
  target_ = std::min(kGrowth * target_, limits_.batch_paths);
}

/// Collects the paths dearer than `above`, lowering the threshold where they become more than
/// `limit`. Where nothing is left, one class of equal costs alone is too large.
void PathEnumeration::collect(Cost above, std::size_t limit) {
  while (advance()) {
    if (found_ <= above) continue;
    if (records_.size() == limit) lower_threshold(limit);
    if (found_ > threshold_)
      note_cut(found_);
    else
      add_record();
  }
  if (records_.empty()) {
    mode_ = Mode::kTies;
    begin_pass(*std::ranges::min_element(cuts_));
    return;
  }
  // Depth first is lexicographic: only costs are left to sort by.
  std::ranges::stable_sort(records_, {}, &Record::cost);
}

void PathEnumeration::add_record() {
  Record record{found_, deviations_.size(), 0};
  for (std::size_t depth = 0; depth < frames_.size(); ++depth) {
    if (frames_[depth].chosen == 0) continue;
    deviations_.push_back({static_cast<std::uint32_t>(depth), frames_[depth].chosen});
    ++record.count;
  }
  records_.push_back(record);
}

/// Lowers the threshold to where at most half of the batch is left, or to its cheapest class, or
/// below that where there is no other.
void PathEnumeration::lower_threshold(std::size_t limit) {
  std::vector<Cost> costs;
  for (const Record& record : records_) costs.push_back(record.cost);
  std::ranges::sort(costs);
  threshold_ = costs.front();
  if (const Cost middle = costs[limit / 2]; middle > threshold_)
    threshold_ = *(std::ranges::lower_bound(costs, middle) - 1);
  if (costs.back() == threshold_) --threshold_;
  std::vector<Record> kept;
  std::vector<Deviation> deviations;
  for (Record record : records_) {
    if (record.cost > threshold_) {
      note_cut(record.cost);
      continue;
    }
    const auto from = deviations_.begin() + static_cast<std::ptrdiff_t>(record.first);
    record.first = deviations.size();
    deviations.insert(deviations.end(), from, from + record.count);
    kept.push_back(record);
  }
  records_ = std::move(kept);
  deviations_ = std::move(deviations);
}

void PathEnumeration::write_stack(SequencePath& path) {
  path.cost = found_;
  path.steps.clear();
  for (const Frame& frame : frames_) {
    const Continuation& way = continuations_[lists_[frame.list].first + frame.chosen];
    if (way.to != kPathEnd) path.steps.push_back(way.step);
  }
  if (!completion_) return;
  for (std::uint32_t list = *completion_;;) {
    const std::size_t best = lists_[list].first;
    if (continuations_[best].to == kPathEnd) return;
    path.steps.push_back(continuations_[best].step);
    list = list_behind(best);
  }
}

void PathEnumeration::write_record(const Record& record, SequencePath& path) {
  path.cost = record.cost;
  path.steps.clear();
  std::uint32_t list = list_of(kPathStart);
  std::size_t deviation = record.first;
  const std::size_t end = record.first + record.count;
  for (std::uint32_t depth = 0;; ++depth) {
    std::uint32_t way = 0;
    if (deviation < end && deviations_[deviation].depth == depth)
      way = deviations_[deviation++].way;
    const std::size_t chosen = lists_[list].first + way;
    if (continuations_[chosen].to == kPathEnd) return;
    path.steps.push_back(continuations_[chosen].step);
    list = follow(chosen);
  }
}

}  // namespace plat::sequences
