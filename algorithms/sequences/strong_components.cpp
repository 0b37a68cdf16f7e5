#include "sequences/strong_components.h"

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/strong_components.hpp>
#include <utility>

namespace plat::sequences {

StrongComponents strong_components(const TransitionTable& table) {
  using Graph = boost::compressed_sparse_row_graph<boost::directedS>;
  const std::uint32_t node_count = table.node_count();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> arcs;
  arcs.reserve(table.arcs.size());
  for (std::uint32_t tail = 0; tail < node_count; ++tail)
    for (std::uint32_t arc = table.first[tail]; arc < table.first[tail + 1]; ++arc)
      arcs.emplace_back(tail, table.arcs[arc].head);
  const Graph graph(boost::edges_are_sorted, arcs.begin(), arcs.end(), node_count);
  StrongComponents out;
  out.of_node.resize(node_count);
  // Boost numbers a component when it is finished, after all that can be reached from it.
  const std::size_t count = boost::strong_components(
      graph,
      boost::make_iterator_property_map(out.of_node.begin(), get(boost::vertex_index, graph)));
  out.first.assign(count + 1, 0);
  for (const std::uint32_t component : out.of_node) ++out.first[component + 1];
  for (std::size_t c = 0; c < count; ++c) out.first[c + 1] += out.first[c];
  out.members.resize(node_count);
  std::vector<std::uint32_t> next = out.first;
  for (std::uint32_t node = 0; node < node_count; ++node)
    out.members[next[out.of_node[node]]++] = node;
  return out;
}

}  // namespace plat::sequences
