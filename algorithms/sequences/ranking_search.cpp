#include "sequences/ranking_search.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "sequences/completable_states.h"
#include "sequences/consumption.h"
#include "sequences/graph_pruning.h"
#include "sequences/k_shortest_walks.h"

namespace plat::sequences {
namespace {

/// The nodes of a search graph between a source and a sink, without their bounds.
class Unconstrained {
 public:
  explicit Unconstrained(const SearchGraph& graph, const Consumption& consumption)
      : graph_(&graph), consumption_(&consumption) {
    exit_of_.assign(graph.node_count(), kNone);
    for (std::uint32_t exit = 0; exit < graph.exits.size(); ++exit)
      exit_of_[graph.exits[exit].node] = exit;
    measure();
  }

  [[nodiscard]] std::uint32_t vertex_count() const { return graph_->node_count() + 2; }
  [[nodiscard]] std::uint32_t source() const { return graph_->node_count(); }
  [[nodiscard]] std::uint32_t sink() const { return graph_->node_count() + 1; }
  [[nodiscard]] Cost distance(std::uint32_t vertex) const { return labels_[vertex].first; }
  /// Circles may be free of cost, but an arc of the tree is always one nearer to the sink.
  [[nodiscard]] bool is_shortest(std::uint32_t tail, std::uint32_t head, Cost cost) const {
    return labels_[tail] == Label{labels_[head].first + cost, labels_[head].second + 1};
  }
  template <class Visit>
  void for_each_arc(std::uint32_t vertex, Visit visit) const {
    if (vertex == source()) {
      for (std::uint32_t entry = 0; entry < graph_->entries.size(); ++entry)
        visit(entry, graph_->entries[entry].node, graph_->entries[entry].cost);
      return;
    }
    const Zone& zone = graph_->zones[consumption_->zone_of(vertex)];
    if (zone.table) {
      const TransitionTable& table = graph_->tables[*zone.table];
      const std::uint32_t local = vertex - zone.first_node;
      for (std::uint32_t arc = table.first[local]; arc < table.first[local + 1]; ++arc)
        visit(arc, zone.first_node + table.arcs[arc].head, table.arcs[arc].cost);
    }
    const auto [first, last] = consumption_->links_from(vertex);
    for (std::uint32_t link = first; link < last; ++link)
      visit(link, graph_->links[link].to, graph_->links[link].cost);
    if (const std::uint32_t exit = exit_of_[vertex]; exit != kNone)
      visit(exit, sink(), graph_->exits[exit].cost);
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  using Label = std::pair<Cost, std::uint32_t>;  ///< cost, then arcs to the sink

  /// Dijkstra's algorithm from the sink.
  void measure() {
    struct Incoming {
      std::uint32_t tail;
      Cost cost;
    };
    std::vector<std::vector<Incoming>> incoming(vertex_count());
    for (std::uint32_t vertex = 0; vertex <= source(); ++vertex)
      for_each_arc(vertex, [&](std::uint32_t, std::uint32_t head, Cost cost) {
        incoming[head].push_back({vertex, cost});
      });
    labels_.assign(vertex_count(), {kUnreachable, 0});
    labels_[sink()] = {0, 0};
    using Entry = std::pair<Label, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.emplace(labels_[sink()], sink());
    while (!open.empty()) {
      const auto [label, head] = open.top();
      open.pop();
      if (label != labels_[head]) continue;
      for (const auto& [tail, cost] : incoming[head]) {
        const Label longer{label.first + cost, label.second + 1};
        if (longer >= labels_[tail]) continue;
        labels_[tail] = longer;
        open.emplace(longer, tail);
      }
    }
  }

  const SearchGraph* graph_;
  const Consumption* consumption_;
  std::vector<std::uint32_t> exit_of_;  ///< by node
  std::vector<Label> labels_;           ///< by vertex
};

/// How many states are kept that are known to end well or not: some 100 MB.
constexpr std::size_t kLookaheadStates = 2'000'000;

class Stream final : public SequenceStream {
 public:
  Stream(PrunedGraph pruned, const RankingSearch::Options& options)
      : pruned_(std::move(pruned)),
        graph_(pruned_.graph),
        options_(options),
        consumption_(graph_),
        completable_(consumption_, pruned_.bounds, kLookaheadStates),
        walks_(Unconstrained(graph_, consumption_)) {}

  Expected<bool> next(SequencePath& path) override {
    while (walks_.next(walk_)) {
      if (statistics_.states_expanded == options_.max_walks)
        return fail(FailureCode::kTooManyStates,
                    "looked at " + std::to_string(options_.max_walks) + " walks, of which " +
                        std::to_string(statistics_.states_created) +
                        " keep the bounds; raise max_walks, or take another method");
      ++statistics_.states_expanded;
      statistics_.arcs_relaxed += walk_.arcs.size();
      if (!keeps_bounds()) continue;
      ++statistics_.states_created;
      path.cost = walk_.cost;
      path.steps.clear();
      for (std::size_t i = 0; i + 1 < walk_.arcs.size(); ++i)
        path.steps.push_back({walk_.arcs[i].head, walk_.arcs[i].arc});
      pruned_.restore(path);
      return true;
    }
    return false;
  }

  [[nodiscard]] SearchStatistics statistics() const override {
    SearchStatistics statistics = statistics_;
    statistics.bytes_held = walks_.bytes();
    return statistics;
  }

 private:
  /// Follows the walk. Where it cannot end well any more before its last detour is over, nor can
  /// the walks that begin as it does.
  bool keeps_bounds() {
    consumed_.assign(graph_.dimension_count, 0);
    std::uint32_t tail = walks_.graph().source();
    for (std::size_t i = 0; i + 1 < walk_.arcs.size(); ++i) {
      const std::uint32_t head = walk_.arcs[i].head;
      const bool is_hopeless = !follow(tail, walk_.arcs[i]) || cannot_end(head);
      if (is_hopeless && i < walk_.fixed) {
        walks_.forbid_extensions();
        ++statistics_.states_pruned;
      }
      if (is_hopeless) return false;
      tail = head;
    }
    return consumption_.may_end(consumption_.zone_of(tail), consumed_);
  }

  [[nodiscard]] bool cannot_end(std::uint32_t node) {
    switch (options_.pruning) {
      case RankingSearch::Pruning::kNone:
        return false;
      case RankingSearch::Pruning::kResources:
        return !pruned_.bounds.may_end(node, consumed_);
      case RankingSearch::Pruning::kStates:
        return !completable_.may_end(node, consumed_);
    }
    return false;
  }

  bool follow(std::uint32_t tail, const WalkArc& step) {
    const std::uint32_t zone = consumption_.zone_of(step.head);
    if (tail == walks_.graph().source())
      return consumption_.add(zone, consumed_, graph_.uses(step.head));
    if (consumption_.zone_of(tail) != zone)
      return consumption_.follow(graph_.links[step.arc], consumed_);
    return consumption_.follow_arc(zone, step.arc, consumed_);
  }

  PrunedGraph pruned_;
  const SearchGraph& graph_;
  RankingSearch::Options options_;
  Consumption consumption_;
  CompletableStates completable_;
  KShortestWalks<Unconstrained> walks_;
  Walk walk_;
  std::vector<Amount> consumed_;
  SearchStatistics statistics_;
};

/// The graph as it is, as if pruned.
PrunedGraph unpruned(const SearchGraph& graph) {
  PrunedGraph out;
  out.graph = graph;
  const auto count = [](std::size_t n) {
    std::vector<std::uint32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
  };
  out.nodes = count(graph.node_count());
  for (const auto& table : graph.tables) out.arcs.push_back(count(table.arcs.size()));
  out.entries = count(graph.entries.size());
  out.links = count(graph.links.size());
  return out;
}

}  // namespace

Expected<std::unique_ptr<SequenceStream>> RankingSearch::search(const SearchGraph& graph) const {
  return std::make_unique<Stream>(
      options_.pruning == Pruning::kNone ? unpruned(graph) : prune(graph), options_);
}

}  // namespace plat::sequences
