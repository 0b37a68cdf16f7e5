#include "sequences/ranking_search.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "sequences/consumption.h"
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

class Stream final : public SequenceStream {
 public:
  Stream(const SearchGraph& graph, std::uint32_t max_walks)
      : graph_(graph),
        consumption_(graph),
        walks_(Unconstrained(graph, consumption_)),
        max_walks_(max_walks) {}

  Expected<bool> next(SequencePath& path) override {
    while (walks_.next(walk_)) {
      if (statistics_.states_expanded == max_walks_)
        return fail(FailureCode::kTooManyStates, "looked at " + std::to_string(max_walks_) +
                                                     " walks, of which " + std::to_string(found_) +
                                                     " keep the bounds; raise max_walks, or take " +
                                                     "another method");
      ++statistics_.states_expanded;
      statistics_.arcs_relaxed += walk_.arcs.size();
      const std::size_t kept = arcs_within_maxima();
      if (kept < walk_.fixed) walks_.forbid_extensions();
      if (kept < walk_.arcs.size()) continue;
      ++found_;
      write(path);
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
  /// How many arcs of the walk keep the bounds: all, or the number before the first that does not.
  std::size_t arcs_within_maxima() {
    std::uint32_t node = walk_.arcs.front().head;
    consumed_.assign(graph_.dimension_count, 0);
    if (!consumption_.add(consumption_.zone_of(node), consumed_, graph_.uses(node))) return 0;
    for (std::size_t i = 1; i + 1 < walk_.arcs.size(); ++i) {
      if (!follow(node, walk_.arcs[i])) return i;
      node = walk_.arcs[i].head;
    }
    const bool is_complete = consumption_.may_end(consumption_.zone_of(node), consumed_);
    return walk_.arcs.size() - (is_complete ? 0 : 1);
  }

  bool follow(std::uint32_t tail, const WalkArc& step) {
    const std::uint32_t zone = consumption_.zone_of(step.head);
    if (consumption_.zone_of(tail) != zone)
      return consumption_.follow(graph_.links[step.arc], consumed_);
    const TransitionTable& table = graph_.tables[*graph_.zones[zone].table];
    if (!table.arc_uses.empty()) {
      const std::span<const Amount> uses(
          table.arc_uses.data() + std::size_t{step.arc} * graph_.dimension_count,
          graph_.dimension_count);
      if (!consumption_.add(zone, consumed_, uses)) return false;
    }
    return consumption_.add(zone, consumed_, graph_.uses(step.head));
  }

  void write(SequencePath& path) const {
    path.cost = walk_.cost;
    path.steps.clear();
    for (std::size_t i = 0; i + 1 < walk_.arcs.size(); ++i)
      path.steps.push_back({walk_.arcs[i].head, walk_.arcs[i].arc});
  }

  const SearchGraph& graph_;
  Consumption consumption_;
  KShortestWalks<Unconstrained> walks_;
  std::uint32_t max_walks_;
  Walk walk_;
  std::vector<Amount> consumed_;
  std::uint64_t found_ = 0;
  SearchStatistics statistics_;
};

}  // namespace

Expected<std::unique_ptr<SequenceStream>> RankingSearch::search(const SearchGraph& graph) const {
  return std::make_unique<Stream>(graph, options_.max_walks);
}

}  // namespace plat::sequences
