#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sequences/search_graph.h"
#include "sequences/sequence_path.h"

namespace plat::sequences {

/// The name of a state in its `CompletionSpace`.
using StateId = std::uint64_t;
inline constexpr StateId kPathStart = std::numeric_limits<StateId>::max();
inline constexpr StateId kPathEnd = kPathStart - 1;

/// One way to go on from a state: by a step to a next state, or the end of the path.
struct Continuation {
  StateId to = kPathEnd;
  Cost slack = 0;  ///< how much dearer the best path by this way is than the best path from here
  Step step;       ///< unless the path ends
  // For `PathEnumeration`, which sorts the ways by slack:
  std::uint32_t list = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t ordinal = 0;  ///< in the order of steps
};

/// States with exact costs-to-go.
class CompletionSpace {
 public:
  virtual ~CompletionSpace() = default;
  /// Of the best path, or nothing where there is no path.
  [[nodiscard]] virtual std::optional<Cost> best_cost() const = 0;
  /// Appends the ways to go on from `state` (or to begin: kPathStart) whose slack is at most
  /// `max_slack`: the path's end first, then by step. Returns the least slack above, if any.
  virtual std::optional<Cost> continue_from(StateId state, Cost max_slack,
                                            std::vector<Continuation>& out) const = 0;
};

/// Enumerates the paths of a space by (cost, steps lexicographically), one at a time.
///
/// Exact costs-to-go tell of every beginning of a path what the best path costs that begins so.
/// Searching depth first, only beginnings within a threshold are followed, so that each one leads
/// to a path; where nothing but the best completion is within it, that is not walked. One pass
/// collects all paths between the last threshold and the next, a batch of bounded size, as their
/// deviations from best completions; the costs of what was cut tell the next threshold. A class of
/// equal costs larger than a batch is not collected: depth first meets it in its order.
///
/// Guarantees: 1. paths come in ascending order of (cost, steps);  2. each comes once, and all
/// come;
/// 3. memory is bounded by the batch and the list limit, whatever number of paths is asked for.
/// Complexity: passes grow by a factor until they reach the batch's size; from then on, a pass
/// follows all earlier beginnings again.
class PathEnumeration {
 public:
  struct Limits {
    std::size_t batch_paths = 1U << 18U;   ///< collected in one pass
    std::size_t list_entries = 1U << 21U;  ///< continuations that are remembered
  };
  /// @param above  leaves out the paths that cost no more than this
  PathEnumeration(const CompletionSpace& space, Limits limits,
                  std::optional<Cost> above = std::nullopt);
  /// Writes the next path, or returns false.
  bool next(SequencePath& path);
  /// How many steps the depth-first passes have taken so far.
  [[nodiscard]] std::uint64_t steps_taken() const { return steps_taken_; }
  [[nodiscard]] std::uint64_t bytes_held() const;

 private:
  enum class Mode { kTies, kBatch, kDone };
  static constexpr Cost kNever = std::numeric_limits<Cost>::max() / 2;
  static constexpr Cost kUnknown = -1;
  /// The ways to go on from a state by (slack, step): the first is the best completion's.
  struct List {
    std::size_t first = 0;
    std::uint32_t count = 0;
    Cost beyond = kNever;   ///< the least slack that is not in the list
    Cost apart = kUnknown;  ///< the least slack of any other path than the best completion
  };
  struct Frame {
    StateId state = kPathStart;
    Cost cost = 0;  ///< of the best path that begins as the frames up to this one say
    std::uint32_t list = 0;
    std::uint32_t allowed = 0;       ///< how many ways are within the threshold
    std::uint32_t chosen = 0;        ///< the way that is being followed
    std::uint32_t next_ordinal = 0;  ///< ways before this one are done
  };
  struct Deviation {
    std::uint32_t depth = 0;
    std::uint32_t way = 0;
  };
  struct Record {
    Cost cost = 0;
    std::size_t first = 0;
    std::uint32_t count = 0;
  };

  std::uint32_t list_of(StateId state);
  std::uint32_t follow(std::size_t continuation);
  std::uint32_t list_behind(std::size_t continuation);
  Cost apart(std::uint32_t list);
  void forget_lists();
  void begin_pass(Cost threshold);
  void push_frame(StateId state, std::uint32_t list, Cost cost);
  bool choose(Frame& frame) const;
  bool advance();
  void note_cut(Cost cost);
  void begin_next();
  void collect(Cost above, std::size_t limit);
  void add_record();
  void lower_threshold(std::size_t limit);
  void write_stack(SequencePath& path);
  void write_record(const Record& record, SequencePath& path);

  const CompletionSpace& space_;
  Limits limits_;
  Mode mode_ = Mode::kDone;
  Cost best_ = 0;
  Cost threshold_ = 0;
  Cost max_slack_ = 0;  ///< of the remembered lists
  std::size_t target_ = 16;
  std::vector<Continuation> continuations_;
  std::vector<List> lists_;
  std::unordered_map<StateId, std::uint32_t> list_of_state_;
  std::vector<Frame> frames_;
  Cost found_ = 0;  ///< the cost of the path that `advance` has come to
  /// Where its frames end and its best completion begins, unless it ends with them.
  std::optional<std::uint32_t> completion_;
  std::vector<std::uint32_t> chain_;  ///< scratch
  std::vector<Cost> cuts_;
  Cost worst_cut_ = std::numeric_limits<Cost>::max();
  std::vector<Record> records_;
  std::vector<Deviation> deviations_;
  std::size_t next_record_ = 0;
  std::uint64_t steps_taken_ = 0;
};

}  // namespace plat::sequences
