#include "sequences/label_setting_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <boost/graph/r_c_shortest_paths.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "sequences/cheapest_ways.h"
#include "sequences/expanded_graph_internal.h"
#include "sequences/given_paths.h"
#include "sequences/resource_bounds.h"
#include "sequences/state_index.h"

namespace plat::sequences {
namespace {

using detail::Edge;
using detail::EdgeMeaning;
using detail::Expanded;
using detail::expanded;
using detail::Graph;
using detail::Way;

/// How many labels may precede one that is kept: 1 in the first run, more in each further one.
constexpr std::size_t kLimitGrowth = 2;
/// Edges and vertices of the expanded graph that are worth shorter lists of labels.
constexpr std::int64_t kLargestSplit = 4'000'000;
/// As many possible states are numbered from the start.
constexpr std::size_t kDenseStates = std::size_t{1} << 16;

/// Which of two amounts of a dimension is no worse.
enum class Better : std::uint8_t { kLess, kMore, kEqual };

std::vector<Better> betters(const SearchGraph& graph) {
  std::vector<Better> out;
  for (std::uint32_t d = 0; d < graph.dimension_count; ++d) {
    const auto has = [&](auto bound) {
      return std::ranges::any_of(graph.zones,
                                 [&](const Zone& zone) { return bound(zone.bounds[d]); });
    };
    if (!has([](const Bounds& bounds) { return bounds.min > 0; }))
      out.push_back(Better::kLess);
    else if (!has([](const Bounds& bounds) { return bounds.max != kUnbounded; }))
      out.push_back(Better::kMore);
    else
      out.push_back(Better::kEqual);
  }
  return out;
}

/// The dimension of most amounts among those that only compare where equal, if the graph split by
/// it is of a moderate size.
std::optional<std::uint32_t> dimension_to_split_by(const SearchGraph& graph,
                                                   const std::vector<Better>& betters) {
  std::optional<std::uint32_t> split;
  std::int64_t most = 1;
  for (std::uint32_t d = 0; d < graph.dimension_count; ++d) {
    std::int64_t levels = 0;
    std::int64_t edges = 0;
    for (const Zone& zone : graph.zones) {
      levels = std::max<std::int64_t>(levels, largest_amount(zone.bounds[d]) + std::int64_t{1});
      if (zone.table) edges += std::ssize(graph.tables[*zone.table].arcs);
    }
    if (betters[d] != Better::kEqual || levels <= most) continue;
    if (levels * (edges + graph.node_count()) > kLargestSplit) continue;
    split = d;
    most = levels;
  }
  return split;
}

/// What a path to a vertex has cost and consumed: Boost's resource container.
struct Label {
  Cost cost = 0;
  Cost least_total = 0;      ///< with the least cost from here to an exit
  std::uint64_t number = 0;  ///< in the order of making: tells equal labels apart
  boost::container::small_vector<Amount, 4> consumed;
  /// How many labels of the vertex were seen to precede this one; Boost compares each pair once.
  mutable std::size_t preceding = 0;

  friend bool operator<(const Label& a, const Label& b) {
    return std::pair(a.least_total, a.number) < std::pair(b.least_total, b.number);
  }
};

/// What Boost's functors, which it copies or holds as constants, have in common.
struct Shared {
  const SearchGraph& graph;
  const std::vector<std::uint32_t>* nodes;  ///< by vertex
  std::vector<std::uint32_t> zones;         ///< by node
  std::vector<Better> betters;              ///< by dimension
  ResourceBounds bounds;
  std::size_t limit = 1;
  std::uint64_t max_labels = 0;
  std::uint64_t max_comparisons = 0;
  bool has_bounds = true;
  std::uint64_t labels = 0;
  std::uint64_t comparisons = 0;
  std::uint64_t expanded = 0;
  std::uint64_t relaxed = 0;
  std::uint64_t dominated = 0;
  std::size_t found = 0;
  /// Where more than one path is asked for: labels of one state are told apart by a table, before
  /// Boost compares each with each.
  std::optional<StateIndex> states = {};
  std::optional<CheapestWays> cheapest = {};

  [[nodiscard]] bool is_beyond_limits() const {
    return labels > max_labels || comparisons > max_comparisons;
  }
};

/// Boost's resource extension function: follows an edge; false where a bound forbids it.
class Extension {
 public:
  explicit Extension(Shared& shared) : shared_(&shared) {}

  bool operator()(const Graph& graph, Label& next, const Label& last, Edge edge) const {
    const EdgeMeaning& meaning = graph[edge];
    ++shared_->relaxed;
    next.cost = last.cost + meaning.cost;
    next.consumed = last.consumed;
    next.preceding = 0;
    const std::size_t tail = source(edge, graph);
    if (meaning.way == Way::kExit) {
      const Zone& zone = zone_at(tail);
      for (std::size_t d = 0; d < next.consumed.size(); ++d) {
        if (next.consumed[d] < zone.bounds[d].min) return false;
        next.consumed[d] = 0;
      }
      next.least_total = next.cost;
      return count(next);
    }
    const std::uint32_t head = (*shared_->nodes)[target(edge, graph)];
    const Zone& zone = shared_->graph.zones[shared_->zones[head]];
    if (meaning.way == Way::kLink && !reset(zone_at(tail), zone, next)) return false;
    if (!enter(zone, head, meaning, next)) return false;
    next.least_total = next.cost;
    if (shared_->has_bounds) {
      if (!shared_->bounds.may_end(head, {next.consumed.data(), next.consumed.size()}))
        return false;
      next.least_total += shared_->bounds.cost_to_exit[head];
    }
    return is_cheap(head, next) && count(next);
  }

 private:
  [[nodiscard]] const Zone& zone_at(std::size_t vertex) const {
    return shared_->graph.zones[shared_->zones[(*shared_->nodes)[vertex]]];
  }
  /// False where as many labels of the same state as may precede one that is kept do so.
  [[nodiscard]] bool is_cheap(std::uint32_t node, const Label& label) const {
    if (!shared_->states) return true;
    const auto state = shared_->states->id(shared_->zones[node], node, label.consumed.data());
    shared_->cheapest->grow(shared_->states->size());
    return shared_->cheapest->admit(state, label.cost);
  }
  bool count(Label& label) const {
    label.number = ++shared_->labels;
    return true;
  }
  static bool reset(const Zone& from, const Zone& to, Label& label) {
    for (std::size_t d = 0; d < label.consumed.size(); ++d) {
      if (!to.resets[d]) continue;
      if (label.consumed[d] < from.bounds[d].min) return false;
      label.consumed[d] = 0;
    }
    return true;
  }
  [[nodiscard]] bool enter(const Zone& zone, std::uint32_t node, const EdgeMeaning& meaning,
                           Label& label) const {
    const SearchGraph& searched = shared_->graph;
    const auto uses = searched.uses(node);
    const Amount* arc_uses = nullptr;
    if (meaning.way == Way::kArc && !searched.tables[*zone.table].arc_uses.empty())
      arc_uses = searched.tables[*zone.table].arc_uses.data() +
                 std::size_t{meaning.index} * searched.dimension_count;
    for (std::size_t d = 0; d < label.consumed.size(); ++d) {
      auto sum = add_amount(zone.bounds[d], label.consumed[d], uses[d]);
      if (sum && arc_uses != nullptr) sum = add_amount(zone.bounds[d], *sum, arc_uses[d]);
      if (!sum) return false;
      label.consumed[d] = *sum;
    }
    return true;
  }

  Shared* shared_;
};

/// Boost's dominance function. `a` precedes `b` where any path on from `b` is as good from `a`, and
/// `a` is better in something or was made before; `b` falls when `limit` labels precede it. Those
/// of them that no others bring to fall are as many, by transitivity, so that no path is missed.
class Dominance {
 public:
  explicit Dominance(Shared& shared) : shared_(&shared) {}

  bool operator()(const Label& a, const Label& b) const {
    ++shared_->comparisons;
    return precedes(a, b) && ++b.preceding >= shared_->limit;
  }

 private:
  [[nodiscard]] bool precedes(const Label& a, const Label& b) const {
    if (a.cost > b.cost) return false;
    bool is_better = a.cost < b.cost;
    for (std::size_t d = 0; d < a.consumed.size(); ++d) {
      if (a.consumed[d] == b.consumed[d]) continue;
      const Better order = shared_->betters[d];
      if (order == Better::kEqual || (a.consumed[d] < b.consumed[d]) != (order == Better::kLess))
        return false;
      is_better = true;
    }
    return is_better || a.number < b.number;
  }

  Shared* shared_;
};

/// Boost's visitor: counts, and ends the search.
class Counter : public boost::default_r_c_shortest_paths_visitor {
 public:
  explicit Counter(Shared& shared) : shared_(&shared) {}

  template <class AnyLabel>
  void on_label_not_dominated(const AnyLabel& label, const Graph& graph) {
    ++shared_->expanded;
    if (label.resident_vertex + 1 == num_vertices(graph)) ++shared_->found;
  }
  template <class AnyLabel>
  void on_label_dominated(const AnyLabel& /*label*/, const Graph& /*graph*/) {
    ++shared_->dominated;
  }
  /// Labels are popped by cost: what is popped at the sink is the best that is left.
  template <class Queue>
  bool on_enter_loop(const Queue& /*queue*/, const Graph& /*graph*/) {
    if (shared_->is_beyond_limits()) return false;
    return !shared_->has_bounds || shared_->found < shared_->limit;
  }

 private:
  Shared* shared_;
};

class LabelSettingStream final : public SequenceStream {
 public:
  LabelSettingStream(const SearchGraph& graph, const LabelSettingSearch::Options& options)
      : expanded_(expanded(graph, std::nullopt)),
        shared_{graph, &expanded_.nodes, {}, betters(graph), resource_bounds(graph)} {
    for (std::uint32_t z = 0; z < graph.zones.size(); ++z)
      shared_.zones.insert(shared_.zones.end(), graph.zones[z].size, z);
    shared_.max_labels = static_cast<std::uint64_t>(options.max_labels);
    shared_.max_comparisons = static_cast<std::uint64_t>(1e6 * options.max_comparisons_million);
    shared_.has_bounds = options.pruning == LabelSettingSearch::Pruning::kBounds;
  }

  Expected<bool> next(SequencePath& path) override {
    while (true) {
      if (shared_.is_beyond_limits())
        return fail(FailureCode::kTooManyStates,
                    fmt::format("label setting made {} labels and {} comparisons for {} paths; "
                                "allowed are {} and {}",
                                shared_.labels, shared_.comparisons, shared_.limit,
                                shared_.max_labels, shared_.max_comparisons));
      if (!run_) {
        run();
        continue;
      }
      for (; at_ < run_->size(); ++at_) {
        if (given_.count() == shared_.limit || !given_.add((*run_)[at_])) continue;
        path = (*run_)[at_++];
        return true;
      }
      if (run_->size() < shared_.limit) return false;
      if (shared_.limit == 1) {
        const auto split = dimension_to_split_by(shared_.graph, shared_.betters);
        if (split) expanded_ = expanded(shared_.graph, split);
      }
      shared_.limit *= kLimitGrowth;
      run_.reset();
    }
  }

  [[nodiscard]] SearchStatistics statistics() const override {
    SearchStatistics out;
    out.states_created = shared_.labels;
    out.states_expanded = shared_.expanded;
    out.arcs_relaxed = shared_.relaxed;
    out.states_pruned = shared_.dominated;
    // A label of Boost is shared by a list and a heap, and counted.
    out.bytes_held = shared_.labels * (sizeof(Label) + 96) + num_edges(expanded_.graph) * 24;
    return out;
  }

 private:
  /// Finds the best paths, as many as the limit, and puts them in order.
  void run() {
    shared_.found = 0;
    if (shared_.limit > 1) {
      shared_.states.emplace(shared_.graph, kDenseStates);
      shared_.cheapest.emplace(shared_.limit, shared_.states->size());
    }
    std::vector<std::vector<Edge>> walks;
    std::vector<Label> labels;
    Label start;
    start.consumed.resize(shared_.graph.dimension_count);
    const Graph& graph = expanded_.graph;
    boost::r_c_shortest_paths(graph, get(boost::vertex_index, graph), get(boost::edge_index, graph),
                              expanded_.source(), expanded_.sink(), walks, labels, start,
                              Extension(shared_), Dominance(shared_),
                              boost::default_r_c_shortest_paths_allocator(), Counter(shared_));
    run_.emplace();
    at_ = 0;
    if (shared_.is_beyond_limits()) return;
    std::vector<std::size_t> order(labels.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return labels[a] < labels[b]; });
    if (order.size() > shared_.limit) order.resize(shared_.limit);
    for (const std::size_t i : order) run_->push_back(path_of(walks[i], labels[i].cost));
  }

  [[nodiscard]] SequencePath path_of(const std::vector<Edge>& from_sink, Cost cost) const {
    SequencePath path{cost, {}};
    // The first edge leads to the sink.
    const Graph& graph = expanded_.graph;
    for (std::size_t i = from_sink.size(); i-- > 1;)
      path.steps.push_back(
          {expanded_.nodes[target(from_sink[i], graph)], graph[from_sink[i]].index});
    return path;
  }

  Expanded expanded_;
  Shared shared_;
  std::optional<std::vector<SequencePath>> run_;  ///< what the last run found
  std::size_t at_ = 0;
  GivenPaths given_;
};

}  // namespace

Expected<std::unique_ptr<SequenceStream>> LabelSettingSearch::search(
    const SearchGraph& graph) const {
  return std::make_unique<LabelSettingStream>(graph, options_);
}

}  // namespace plat::sequences
