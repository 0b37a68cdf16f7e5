#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// More than any walk costs, and may be added to once.
inline constexpr Cost kUnreachable = std::numeric_limits<Cost>::max() / 4;

/// A graph whose arcs are found when they are asked for, with what it costs to reach the sink.
/// `for_each_arc(vertex, visit(arc, head, cost))` visits in the same order each time; heads that do
/// not reach the sink may be among them. Of the arcs for which `is_shortest(tail, head, cost)`, the
/// first that leaves each vertex: they form a tree towards the sink.
template <class G>
concept WalkGraph = requires(const G& graph, std::uint32_t vertex, Cost cost) {
  { graph.vertex_count() } -> std::convertible_to<std::uint32_t>;
  { graph.source() } -> std::convertible_to<std::uint32_t>;
  { graph.sink() } -> std::convertible_to<std::uint32_t>;
  { graph.distance(vertex) } -> std::same_as<Cost>;
  { graph.is_shortest(vertex, vertex, cost) } -> std::same_as<bool>;
  graph.for_each_arc(vertex, [](std::uint32_t, std::uint32_t, Cost) {});
};

/// One arc of a walk and where it leads.
struct WalkArc {
  std::uint32_t arc = 0;
  std::uint32_t head = 0;
};

/// A walk from the source to the sink; vertices may come more than once.
struct Walk {
  Cost cost = 0;
  std::vector<WalkArc> arcs;
  /// How many arcs there are up to the last one that leaves the tree of shortest walks.
  std::size_t fixed = 0;
};

/// The k shortest walks of a graph, one after the other, cheapest first.
///
/// Each vertex has a list of its sidetracks (the arcs that are not in the tree of shortest walks,
/// by what they cost more) and a heap of the lists that lie on its way to the sink: the heap of the
/// next vertex and one list more, sharing all but O(log n) nodes. A walk is its sidetracks in
/// order. Lists and heaps are made for the vertices that walks come by, when they do.
///
/// Guarantees: 1. costs do not decrease;  2. every walk comes once, also where arcs are parallel;
/// 3. of candidates of equal cost the one found last comes first: a walk's extensions, then those
/// that change its last sidetrack, then older ones, so that among arcs without a cost a search goes
/// deep;  4. memory grows with the number of walks taken and the vertices they come by, not with
/// the number of walks there are.
///
/// Complexity: O(d log d + log n) for a vertex of d arcs, once; O(log k + length) for a walk
///
/// Paper:      [Epp94]
///
/// Deviation:  lists are sorted where the paper has heaps: a candidate then has two children or
///             four
template <WalkGraph G>
class KShortestWalks {
 public:
  /// @param graph  is called until the last walk is taken
  explicit KShortestWalks(G graph)
      : graph_(std::move(graph)), next_(graph_.vertex_count(), WalkArc{kNone, kNone}) {}

  [[nodiscard]] const G& graph() const { return graph_; }

  /// Writes the next walk and returns true, or returns false where there is none.
  bool next(Walk& walk) {
    if (!has_begun_) return begin(walk);
    if (last_ != kNone) add_children();
    last_ = kNone;
    if (queue_.empty()) return false;
    last_ = queue_.top().candidate;
    queue_.pop();
    may_extend_ = true;
    write(walk);
    return true;
  }

  /// Leaves all further walks out that begin with the first `fixed` arcs of the last one.
  void forbid_extensions() { may_extend_ = false; }

  /// What is held, roughly.
  [[nodiscard]] std::uint64_t bytes() const {
    return next_.capacity() * sizeof(WalkArc) + heaps_.capacity() * sizeof(std::uint32_t) +
           sidetracks_.capacity() * sizeof(Sidetrack) + nodes_.capacity() * sizeof(HeapNode) +
           candidates_.capacity() * sizeof(Candidate) + queue_.size() * sizeof(Entry);
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::uint32_t kUnbuilt = kNone - 1;

  struct Sidetrack {
    Cost delta = 0;  ///< what a walk through it costs more
    std::uint32_t arc = 0;
    std::uint32_t head = 0;
  };
  /// A node of a persistent leftist heap: the list of one vertex, by its first sidetrack.
  struct HeapNode {
    std::uint32_t tail = 0;
    std::uint32_t first = 0;  ///< into `sidetracks_`
    std::uint32_t last = 0;
    std::uint32_t left = kNone;
    std::uint32_t right = kNone;
    std::uint32_t rank = 1;
  };
  /// A walk: another one's sidetracks up to its last, and one more.
  struct Candidate {
    Cost cost = 0;
    std::uint32_t prefix = kNone;     ///< the candidate that is extended
    std::uint32_t heap_node = kNone;  ///< none: the shortest walk
    std::uint32_t sidetrack = kNone;
  };
  /// A candidate in the queue: the cheapest on top, of those the youngest.
  struct Entry {
    Cost cost = 0;
    std::uint32_t candidate = 0;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.cost != b.cost ? a.cost > b.cost : a.candidate < b.candidate;
    }
  };

  bool begin(Walk& walk) {
    has_begun_ = true;
    const Cost cost = graph_.distance(graph_.source());
    if (cost >= kUnreachable) return false;
    candidates_.push_back({.cost = cost});
    last_ = 0;
    write(walk);
    return true;
  }

  const WalkArc& next_of(std::uint32_t vertex) {
    WalkArc& next = next_[vertex];
    if (next.head != kNone) return next;
    graph_.for_each_arc(vertex, [&](std::uint32_t arc, std::uint32_t head, Cost cost) {
      if (next.head == kNone && graph_.is_shortest(vertex, head, cost)) next = {arc, head};
    });
    return next;
  }

  void write(Walk& walk) {
    chain_.clear();
    for (std::uint32_t c = last_; candidates_[c].heap_node != kNone; c = candidates_[c].prefix)
      chain_.push_back(c);
    walk.cost = candidates_[last_].cost;
    walk.arcs.clear();
    walk.fixed = 0;
    std::uint32_t vertex = graph_.source();
    const auto follow_tree = [&](std::uint32_t until) {
      while (vertex != until) {
        walk.arcs.push_back(next_of(vertex));
        vertex = walk.arcs.back().head;
      }
    };
    for (auto c = chain_.rbegin(); c != chain_.rend(); ++c) {
      const Candidate& candidate = candidates_[*c];
      follow_tree(nodes_[candidate.heap_node].tail);
      const Sidetrack& sidetrack = sidetracks_[candidate.sidetrack];
      walk.arcs.push_back({sidetrack.arc, sidetrack.head});
      vertex = sidetrack.head;
      walk.fixed = walk.arcs.size();
    }
    follow_tree(graph_.sink());
  }

  /// The walks that differ from the last one in its last sidetrack, and those with one more.
  void add_children() {
    const Candidate from = candidates_[last_];
    std::uint32_t tip = graph_.source();
    if (from.heap_node != kNone) {
      const HeapNode node = nodes_[from.heap_node];
      if (from.sidetrack + 1 < node.last)
        add(from, from.prefix, from.heap_node, from.sidetrack + 1);
      if (from.sidetrack == node.first) {
        add_list(from, from.prefix, node.left);
        add_list(from, from.prefix, node.right);
      }
      tip = sidetracks_[from.sidetrack].head;
    }
    if (may_extend_) add_list({.cost = from.cost}, last_, heap_of(tip));
  }

  void add_list(const Candidate& from, std::uint32_t prefix, std::uint32_t heap_node) {
    if (heap_node != kNone) add(from, prefix, heap_node, nodes_[heap_node].first);
  }

  void add(const Candidate& from, std::uint32_t prefix, std::uint32_t heap_node,
           std::uint32_t sidetrack) {
    const Cost replaced = from.heap_node == kNone ? 0 : sidetracks_[from.sidetrack].delta;
    const Cost cost = from.cost - replaced + sidetracks_[sidetrack].delta;
    queue_.push({cost, static_cast<std::uint32_t>(candidates_.size())});
    candidates_.push_back({cost, prefix, heap_node, sidetrack});
  }

  /// The heap of a vertex, and of those on its way to the sink that have none yet.
  std::uint32_t heap_of(std::uint32_t vertex) {
    if (heaps_.empty()) {
      heaps_.assign(graph_.vertex_count(), kUnbuilt);
      heaps_[graph_.sink()] = kNone;
    }
    std::vector<std::uint32_t> way;
    for (std::uint32_t v = vertex; heaps_[v] == kUnbuilt; v = next_of(v).head) way.push_back(v);
    for (auto v = way.rbegin(); v != way.rend(); ++v)
      heaps_[*v] = with_list_of(*v, heaps_[next_of(*v).head]);
    return heaps_[vertex];
  }

  std::uint32_t with_list_of(std::uint32_t vertex, std::uint32_t heap) {
    HeapNode node;
    node.tail = vertex;
    node.first = static_cast<std::uint32_t>(sidetracks_.size());
    const WalkArc next = next_of(vertex);
    graph_.for_each_arc(vertex, [&](std::uint32_t arc, std::uint32_t head, Cost cost) {
      if (graph_.distance(head) >= kUnreachable || (arc == next.arc && head == next.head)) return;
      const Cost delta = cost + graph_.distance(head) - graph_.distance(vertex);
      sidetracks_.push_back({delta, arc, head});
    });
    node.last = static_cast<std::uint32_t>(sidetracks_.size());
    if (node.first == node.last) return heap;
    std::stable_sort(sidetracks_.begin() + node.first, sidetracks_.end(),
                     [](const Sidetrack& a, const Sidetrack& b) { return a.delta < b.delta; });
    return insert(node, heap);
  }

  std::uint32_t insert(HeapNode node, std::uint32_t heap) {
    if (heap == kNone || sidetracks_[node.first].delta <= sidetracks_[nodes_[heap].first].delta) {
      node.left = heap;
      nodes_.push_back(node);
    } else {
      HeapNode copy = nodes_[heap];
      copy.right = insert(node, copy.right);
      if (rank(copy.left) < rank(copy.right)) std::swap(copy.left, copy.right);
      copy.rank = rank(copy.right) + 1;
      nodes_.push_back(copy);
    }
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  [[nodiscard]] std::uint32_t rank(std::uint32_t heap) const {
    return heap == kNone ? 0 : nodes_[heap].rank;
  }

  G graph_;
  std::vector<WalkArc> next_;          ///< by vertex, as far as asked for
  std::vector<std::uint32_t> heaps_;   ///< by vertex
  std::vector<Sidetrack> sidetracks_;  ///< the lists, each sorted
  std::vector<HeapNode> nodes_;
  std::vector<Candidate> candidates_;
  std::priority_queue<Entry> queue_;
  std::vector<std::uint32_t> chain_;
  std::uint32_t last_ = kNone;  ///< the candidate that was taken last
  bool has_begun_ = false;
  bool may_extend_ = true;
};

}  // namespace plat::sequences
