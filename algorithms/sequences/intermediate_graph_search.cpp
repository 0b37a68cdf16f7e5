#include "sequences/intermediate_graph_search.h"

#include <optional>
#include <utility>

#include "sequences/graph_pruning.h"
#include "sequences/intermediate_graph.h"
#include "sequences/intermediate_graph_distances.h"
#include "sequences/k_shortest_walks.h"

namespace plat::sequences {
namespace {

/// The intermediate graph between a source and a sink: the s and t of [Har, Sec. 3.3.1].
class BetweenSourceAndSink {
 public:
  BetweenSourceAndSink(const IntermediateGraph& graph, const std::vector<Cost>& distances)
      : graph_(&graph), distances_(&distances), source_distance_(kUnreachable) {
    for_each_arc(source(), [this](std::uint32_t, std::uint32_t head, Cost cost) {
      source_distance_ = std::min(source_distance_, cost + distance(head));
    });
  }

  [[nodiscard]] std::uint32_t vertex_count() const { return graph_->state_count() + 2; }
  [[nodiscard]] std::uint32_t source() const { return graph_->state_count(); }
  [[nodiscard]] std::uint32_t sink() const { return graph_->state_count() + 1; }
  [[nodiscard]] Cost distance(std::uint32_t vertex) const {
    if (vertex == sink()) return 0;
    return vertex == source() ? source_distance_ : (*distances_)[vertex];
  }
  /// No circle is free of cost, so that shortest arcs never lead in one.
  [[nodiscard]] bool is_shortest(std::uint32_t tail, std::uint32_t head, Cost cost) const {
    return distance(tail) == cost + distance(head);
  }
  template <class Visit>
  void for_each_arc(std::uint32_t vertex, Visit visit) const {
    const SearchGraph& graph = graph_->search_graph();
    if (vertex == source()) {
      for (std::uint32_t entry = 0; entry < graph.entries.size(); ++entry) {
        const std::uint32_t state = graph_->entry_state(graph.entries[entry]);
        if (state != IntermediateGraph::kNoState) visit(entry, state, graph.entries[entry].cost);
      }
      return;
    }
    graph_->for_each_arc(vertex, visit);
    if (const auto exit = graph_->exit_of(vertex)) visit(*exit, sink(), graph.exits[*exit].cost);
  }

 private:
  const IntermediateGraph* graph_;
  const std::vector<Cost>* distances_;
  Cost source_distance_;
};

/// A search graph, cut down where bounding asks for it, with its intermediate graph and walks.
class Attempt {
 public:
  static Expected<std::unique_ptr<Attempt>> make(const SearchGraph& graph,
                                                 const IntermediateGraphSearch::Options& options,
                                                 std::optional<Cost> max_cost) {
    auto attempt = std::unique_ptr<Attempt>(new Attempt);
    GrowthLimits limits{.max_states = options.max_states,
                        .max_bytes = std::uint64_t{options.max_memory_mib} << 20,
                        .max_end_states = options.max_end_states,
                        .bounds = nullptr};
    if (options.bounding != IntermediateGraphSearch::Bounding::kNone) {
      attempt->pruned_ = prune(graph, max_cost);
      limits.bounds = &attempt->pruned_->bounds;
    }
    const SearchGraph& searched = attempt->pruned_ ? attempt->pruned_->graph : graph;
    auto built = IntermediateGraph::build(searched, limits);
    if (!built) return tl::unexpected(built.error());
    attempt->graph_.emplace(std::move(*built));
    return attempt;
  }

  bool next(SequencePath& path) {
    if (!walks_) {
      distances_ = distances_to_end(*graph_);
      walks_.emplace(BetweenSourceAndSink(*graph_, distances_.cost));
    }
    if (!walks_->next(walk_)) return false;
    path.cost = walk_.cost;
    path.steps.clear();
    for (std::size_t i = 0; i + 1 < walk_.arcs.size(); ++i)
      path.steps.push_back({graph_->node(walk_.arcs[i].head), walk_.arcs[i].arc});
    if (pruned_) pruned_->restore(path);
    return true;
  }

  [[nodiscard]] SearchStatistics statistics() const {
    SearchStatistics statistics;
    statistics.states_created = graph_->state_count();
    statistics.states_expanded = graph_->expanded_count();
    statistics.arcs_relaxed = distances_.arcs_relaxed;
    statistics.states_pruned = graph_->created_count() - graph_->state_count();
    statistics.bytes_held = graph_->bytes() + distances_.cost.capacity() * sizeof(Cost) +
                            (walks_ ? walks_->bytes() : 0);
    return statistics;
  }

  [[nodiscard]] const PrunedGraph& pruned() const { return *pruned_; }

 private:
  Attempt() = default;

  std::optional<PrunedGraph> pruned_;
  std::optional<IntermediateGraph> graph_;
  DistancesToEnd distances_;
  std::optional<KShortestWalks<BetweenSourceAndSink>> walks_;
  Walk walk_;
};

class Stream final : public SequenceStream {
 public:
  explicit Stream(std::unique_ptr<Attempt> attempt) : attempt_(std::move(attempt)) {}

  Expected<bool> next(SequencePath& path) override { return attempt_->next(path); }
  [[nodiscard]] SearchStatistics statistics() const override { return attempt_->statistics(); }

 private:
  std::unique_ptr<Attempt> attempt_;
};

/// Looks for paths up to a limit on their cost, and raises it, twice as far each time above the
/// least cost that a path could have, when there are no more.
class RisingStream final : public SequenceStream {
 public:
  RisingStream(const SearchGraph& graph, const IntermediateGraphSearch::Options& options)
      : all_(prune(graph)), options_(options) {
    Cost least = kUnreachable;
    for (const Terminal& entry : all_.graph.entries)
      least = std::min(least, entry.cost + all_.bounds.cost_to_exit[entry.node]);
    limit_ = least;
    gap_ = least / kFirstGap + 1;
  }

  Expected<void> raise() {
    if (attempt_) {
      add_up(attempt_->statistics());
      done_ = limit_;
      gap_ *= 2;
    }
    limit_ += gap_;
    auto attempt = Attempt::make(all_.graph, options_, limit_);
    if (!attempt) return tl::unexpected(attempt.error());
    attempt_ = std::move(*attempt);
    is_complete_ = size_of(attempt_->pruned()) == size_of(all_);
    return {};
  }

  Expected<bool> next(SequencePath& path) override {
    while (true) {
      const bool has_next = attempt_->next(path);
      if (has_next && path.cost <= done_) continue;
      if (has_next && (is_complete_ || path.cost <= limit_)) {
        all_.restore(path);
        return true;
      }
      if (is_complete_) return false;
      if (const auto raised = raise(); !raised) return tl::unexpected(raised.error());
    }
  }

  [[nodiscard]] SearchStatistics statistics() const override {
    SearchStatistics statistics = attempt_->statistics();
    statistics.states_expanded += before_.states_expanded;
    statistics.arcs_relaxed += before_.arcs_relaxed;
    return statistics;
  }

 private:
  /// The first limit is a sixteenth above the least cost.
  static constexpr Cost kFirstGap = 16;

  /// How much is left of a graph: as much as without a limit means that there is nothing beyond.
  static std::size_t size_of(const PrunedGraph& pruned) {
    std::size_t size = pruned.nodes.size() + pruned.entries.size() + pruned.links.size() +
                       pruned.graph.exits.size();
    for (const auto& arcs : pruned.arcs) size += arcs.size();
    return size;
  }
  void add_up(const SearchStatistics& statistics) {
    before_.states_expanded += statistics.states_expanded;
    before_.arcs_relaxed += statistics.arcs_relaxed;
  }

  PrunedGraph all_;  ///< without a limit
  IntermediateGraphSearch::Options options_;
  std::unique_ptr<Attempt> attempt_;
  Cost limit_ = 0;  ///< of the attempt
  Cost gap_ = 0;
  Cost done_ = -1;  ///< all paths up to this cost have been handed out
  bool is_complete_ = false;
  SearchStatistics before_;  ///< of the attempts before
};

}  // namespace

Expected<std::unique_ptr<SequenceStream>> IntermediateGraphSearch::search(
    const SearchGraph& graph) const {
  if (options_.bounding == Bounding::kResourcesAndCost) {
    auto stream = std::make_unique<RisingStream>(graph, options_);
    if (const auto raised = stream->raise(); !raised) return tl::unexpected(raised.error());
    return stream;
  }
  auto attempt = Attempt::make(graph, options_, std::nullopt);
  if (!attempt) return tl::unexpected(attempt.error());
  return std::make_unique<Stream>(std::move(*attempt));
}

}  // namespace plat::sequences
