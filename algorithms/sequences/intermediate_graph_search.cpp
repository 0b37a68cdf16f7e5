#include "sequences/intermediate_graph_search.h"

#include <optional>
#include <utility>

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

class Stream final : public SequenceStream {
 public:
  explicit Stream(IntermediateGraph graph) : graph_(std::move(graph)) {}

  Expected<bool> next(SequencePath& path) override {
    if (!walks_) {
      distances_ = distances_to_end(graph_);
      walks_.emplace(BetweenSourceAndSink(graph_, distances_.cost));
    }
    if (!walks_->next(walk_)) return false;
    path.cost = walk_.cost;
    path.steps.clear();
    for (std::size_t i = 0; i + 1 < walk_.arcs.size(); ++i)
      path.steps.push_back({graph_.node(walk_.arcs[i].head), walk_.arcs[i].arc});
    return true;
  }

  [[nodiscard]] SearchStatistics statistics() const override {
    SearchStatistics statistics;
    statistics.states_created = graph_.state_count();
    statistics.states_expanded = graph_.expanded_count();
    statistics.arcs_relaxed = distances_.arcs_relaxed;
    statistics.states_pruned = graph_.created_count() - graph_.state_count();
    statistics.bytes_held =
        graph_.bytes() + distances_.cost.capacity() * sizeof(Cost) + (walks_ ? walks_->bytes() : 0);
    return statistics;
  }

 private:
  IntermediateGraph graph_;
  DistancesToEnd distances_;
  std::optional<KShortestWalks<BetweenSourceAndSink>> walks_;
  Walk walk_;
};

}  // namespace

Expected<std::unique_ptr<SequenceStream>> IntermediateGraphSearch::search(
    const SearchGraph& graph) const {
  auto built = IntermediateGraph::build(
      graph, {.max_states = options_.max_states, .max_end_states = options_.max_end_states});
  if (!built) return tl::unexpected(built.error());
  return std::make_unique<Stream>(std::move(*built));
}

}  // namespace plat::sequences
