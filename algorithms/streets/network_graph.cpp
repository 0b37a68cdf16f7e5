#include "streets/network_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace plat::streets {
namespace {

/// Half-street 2s leaves the `from` node of street s, 2s+1 its `to` node.
using HalfStreet = std::uint32_t;
constexpr std::uint32_t kNone = 0xffffffffU;

class Walker {
 public:
  Walker(const StreetNetwork& network, std::span<const Point> kept)
      : network_(network), is_node_(network.nodes.size(), false) {
    offsets_.assign(network.nodes.size() + 1, 0);
    for (HalfStreet h = 0; h < 2 * network.streets.size(); ++h) ++offsets_[start(h) + 1];
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    around_.resize(2 * network.streets.size());
    std::vector<std::uint32_t> place(offsets_.begin(), offsets_.end() - 1);
    for (HalfStreet h = 0; h < around_.size(); ++h) around_[place[start(h)]++] = h;
    for (std::uint32_t v = 0; v < is_node_.size(); ++v)
      is_node_[v] = degree(v) != 2 && degree(v) != 0;
    for (const Point p : kept) {
      const auto it = std::lower_bound(network.nodes.begin(), network.nodes.end(), p);
      if (it == network.nodes.end() || *it != p) continue;
      const auto v = static_cast<std::uint32_t>(it - network.nodes.begin());
      if (degree(v) > 0) is_node_[v] = true;
    }
  }

  NetworkGraph walk() {
    is_walked_.assign(network_.streets.size(), false);
    for (std::uint32_t v = 0; v < is_node_.size(); ++v) {
      if (is_node_[v]) walk_from(v);
    }
    // What is left are rings without a node.
    for (std::uint32_t v = 0; v < is_node_.size(); ++v) {
      if (degree(v) == 0 || is_walked_[around_[offsets_[v]] / 2]) continue;
      is_node_[v] = true;
      walk_from(v);
    }
    return numbered();
  }

 private:
  [[nodiscard]] std::uint32_t start(HalfStreet h) const {
    const Street& street = network_.streets[h / 2];
    return h % 2 == 0 ? street.from : street.to;
  }
  [[nodiscard]] std::uint32_t end(HalfStreet h) const { return start(h ^ 1U); }
  [[nodiscard]] std::uint32_t degree(std::uint32_t v) const {
    return offsets_[v + 1] - offsets_[v];
  }

  void walk_from(std::uint32_t v) {
    for (std::uint32_t k = offsets_[v]; k < offsets_[v + 1]; ++k) {
      HalfStreet h = around_[k];
      if (is_walked_[h / 2]) continue;
      NetworkGraph::Edge edge;
      edge.from = v;
      for (;;) {
        is_walked_[h / 2] = true;
        edge.streets.push_back(h / 2);
        edge.length_m += length_m(network_.streets[h / 2].line);
        edge.to = end(h);
        if (is_node_[edge.to]) break;
        const std::uint32_t first = offsets_[edge.to];
        h = around_[first] == (h ^ 1U) ? around_[first + 1] : around_[first];
      }
      edges_.push_back(std::move(edge));
    }
  }

  /// Nodes of the network that are none of the graph are left out of the count.
  NetworkGraph numbered() {
    NetworkGraph graph;
    std::vector<std::uint32_t> number(is_node_.size(), kNone);
    for (std::uint32_t v = 0; v < is_node_.size(); ++v) {
      if (!is_node_[v]) continue;
      number[v] = static_cast<std::uint32_t>(graph.nodes.size());
      graph.nodes.push_back(network_.nodes[v]);
    }
    for (NetworkGraph::Edge& edge : edges_) {
      edge.from = number[edge.from];
      edge.to = number[edge.to];
    }
    graph.edges = std::move(edges_);
    return graph;
  }

  const StreetNetwork& network_;
  std::vector<bool> is_node_;
  std::vector<std::uint32_t> offsets_;  // n+1 offsets into around_
  std::vector<HalfStreet> around_;
  std::vector<bool> is_walked_;  // per street
  std::vector<NetworkGraph::Edge> edges_;
};

constexpr std::size_t kBins = 36;

/// Degrees clockwise from north, 0 <= bearing < 360.
double bearing_deg(Point direction) {
  const double degrees = std::atan2(direction.x, direction.y) * (180.0 / std::numbers::pi);
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}

/// Bins of 5 degrees, taken in pairs about the multiples of 10.
std::size_t bearing_bin(double bearing) {
  const auto half_bin = static_cast<std::size_t>(std::floor(bearing / 5.0));
  return ((half_bin + 1) / 2) % kBins;
}

}  // namespace

NetworkGraph network_graph(const StreetNetwork& network, std::span<const Point> kept) {
  return Walker(network, kept).walk();
}

std::vector<std::uint32_t> node_degrees(const NetworkGraph& graph) {
  std::vector<std::uint32_t> degrees(graph.nodes.size(), 0);
  for (const NetworkGraph::Edge& edge : graph.edges) {
    ++degrees[edge.from];
    ++degrees[edge.to];
  }
  return degrees;
}

double circuity(const NetworkGraph& graph) {
  double length = 0.0;
  double straight = 0.0;
  for (const NetworkGraph::Edge& edge : graph.edges) {
    length += edge.length_m;
    straight += distance(graph.nodes[edge.from], graph.nodes[edge.to]);
  }
  return straight > 0.0 ? length / straight : 0.0;
}

double orientation_entropy(const NetworkGraph& graph, BearingWeight weight) {
  std::array<double, kBins> sums{};
  for (const NetworkGraph::Edge& edge : graph.edges) {
    if (edge.from == edge.to) continue;
    const double share = weight == BearingWeight::kEdge ? 1.0 : edge.length_m;
    const double bearing = bearing_deg(graph.nodes[edge.to] - graph.nodes[edge.from]);
    sums[bearing_bin(bearing)] += share;
    sums[bearing_bin(bearing < 180.0 ? bearing + 180.0 : bearing - 180.0)] += share;
  }
  const double total = std::accumulate(sums.begin(), sums.end(), 0.0);
  double entropy = 0.0;
  for (const double sum : sums) {
    if (sum > 0.0) entropy -= sum / total * std::log(sum / total);
  }
  return entropy;
}

}  // namespace plat::streets
