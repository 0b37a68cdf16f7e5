#pragma once

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences::detail {

/// What an edge of the expanded graph does.
enum class Way : std::uint8_t { kEntry, kArc, kLink, kExit };
struct EdgeMeaning {
  Cost cost = 0;
  std::uint32_t index = 0;  ///< of the entry, of the arc in its zone's table, or of the link
  Way way = Way::kArc;
};
using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, EdgeMeaning>;
using Edge = boost::graph_traits<Graph>::edge_descriptor;

/// A search graph as Boost takes it: a vertex per node, then the source and the sink. With a
/// dimension to split by, a vertex per node and amount of it: Boost compares each label of a vertex
/// with each, and labels of different amounts of a dimension with both bounds never compare.
struct Expanded {
  Graph graph;
  std::vector<std::uint32_t> nodes;  ///< by vertex
  [[nodiscard]] std::size_t source() const { return nodes.size(); }
  [[nodiscard]] std::size_t sink() const { return nodes.size() + 1; }
};

Expanded expanded(const SearchGraph& graph, std::optional<std::uint32_t> split);

}  // namespace plat::sequences::detail
