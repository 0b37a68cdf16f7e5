#include "streets/network_routes.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <limits>
#include <map>
#include <numeric>

namespace plat::streets {
namespace {

using EdgeLength = boost::property<boost::edge_weight_t, double>;
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS,
                                    boost::no_property, EdgeLength>;

Graph shortest_edges(const NetworkGraph& network) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> shortest;
  for (const NetworkGraph::Edge& edge : network.edges) {
    if (edge.from == edge.to) continue;
    const auto [it, is_new] = shortest.try_emplace(std::minmax(edge.from, edge.to), edge.length_m);
    if (!is_new) it->second = std::min(it->second, edge.length_m);
  }
  Graph graph(network.nodes.size());
  for (const auto& [ends, length] : shortest)
    boost::add_edge(ends.first, ends.second, length, graph);
  return graph;
}

/// Notes the vertices in the order of their distance.
class OrderNoter : public boost::dijkstra_visitor<> {
 public:
  explicit OrderNoter(std::vector<std::uint32_t>& order) : order_(&order) {}
  void examine_vertex(std::size_t v, const Graph&) const {
    order_->push_back(static_cast<std::uint32_t>(v));
  }

 private:
  std::vector<std::uint32_t>* order_;
};

/// Shortest ways from one node to all others.
class Ways {
 public:
  explicit Ways(const Graph& graph)
      : graph_(graph),
        distance_(boost::num_vertices(graph)),
        ways_(boost::num_vertices(graph)),
        dependency_(boost::num_vertices(graph)) {}

  void find(std::uint32_t source) {
    order_.clear();
    boost::dijkstra_shortest_paths(graph_, source,
                                   boost::distance_map(distance_.data())
                                       .distance_inf(kUnreached_m)
                                       .visitor(OrderNoter(order_)));
    source_ = source;
  }

  [[nodiscard]] bool reaches(std::uint32_t v) const { return distance_[v] < kUnreached_m; }
  [[nodiscard]] double distance_m(std::uint32_t v) const { return distance_[v]; }

  /// Adds to `sums` what the source contributes to every node: [Bra01, Alg. 1] with lengths.
  void add_dependencies(std::vector<double>& sums) {
    std::fill(ways_.begin(), ways_.end(), 0.0);
    std::fill(dependency_.begin(), dependency_.end(), 0.0);
    ways_[source_] = 1.0;
    for (const std::uint32_t v : order_)
      for_each_next(v, [&](std::uint32_t next) { ways_[next] += ways_[v]; });
    for (std::size_t i = order_.size(); i-- > 0;) {
      const std::uint32_t v = order_[i];
      for_each_next(v, [&](std::uint32_t next) {
        dependency_[v] += ways_[v] / ways_[next] * (1.0 + dependency_[next]);
      });
      if (v != source_) sums[v] += dependency_[v];
    }
  }

 private:
  static constexpr double kUnreached_m = std::numeric_limits<double>::infinity();

  /// The nodes that a shortest way through `v` may visit next.
  template <class Visit>
  void for_each_next(std::uint32_t v, Visit visit) const {
    for (const auto& edge : boost::make_iterator_range(boost::out_edges(v, graph_))) {
      const auto next = static_cast<std::uint32_t>(boost::target(edge, graph_));
      const double length = boost::get(boost::edge_weight, graph_, edge);
      if (distance_[v] + length == distance_[next]) visit(next);
    }
  }

  const Graph& graph_;
  std::uint32_t source_ = 0;
  std::vector<std::uint32_t> order_;
  std::vector<double> distance_;
  std::vector<double> ways_;        // shortest ways from the source
  std::vector<double> dependency_;  // delta in [Bra01]
};

/// `count` of the numbers below `n`, ascending, each at most once.
std::vector<std::uint32_t> draw_distinct(std::size_t n, std::size_t count, Rng& rng) {
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0U);
  count = std::min(count, n);
  for (std::size_t i = 0; i < count; ++i) std::swap(all[i], all[i + rng.index(n - i)]);
  all.resize(count);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

RouteMeasures measure_routes(const NetworkGraph& network, const RouteOptions& options, Rng& rng) {
  RouteMeasures out;
  const std::size_t n = network.nodes.size();
  out.sources = draw_distinct(n, static_cast<std::size_t>(options.sources), rng);
  out.betweenness.assign(n, 0.0);
  const Graph graph = shortest_edges(network);
  Ways ways(graph);
  for (const std::uint32_t source : out.sources) {
    ways.find(source);
    ways.add_dependencies(out.betweenness);
    for (int t = 0; n > 1 && t < options.targets; ++t) {
      auto target = static_cast<std::uint32_t>(rng.index(n - 1));
      if (target >= source) ++target;
      if (!ways.reaches(target)) {
        ++out.unreachable;
        continue;
      }
      out.routes.push_back({source, target, ways.distance_m(target),
                            distance(network.nodes[source], network.nodes[target])});
    }
  }
  // Every pair was met from both ends, were all nodes sources.
  const auto nodes = static_cast<double>(n);
  const double scale =
      n > 2 ? nodes / static_cast<double>(out.sources.size()) / ((nodes - 1.0) * (nodes - 2.0))
            : 1.0;
  for (double& value : out.betweenness) value *= scale;
  return out;
}

}  // namespace plat::streets
