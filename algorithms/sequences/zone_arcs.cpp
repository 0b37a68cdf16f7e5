#include "sequences/zone_arcs.h"

#include <algorithm>
#include <map>
#include <utility>

namespace plat::sequences {
namespace {

/// No amount of a state reaches `kUnbounded`, so that more need not be told apart.
Amount sum_up_to_unbounded(Amount a, Amount b) {
  return static_cast<Amount>(std::min<std::int64_t>(std::int64_t{a} + b, kUnbounded));
}

}  // namespace

ZoneArcs::ZoneArcs(const SearchGraph& graph, const Zone& zone)
    : table_(&graph.tables[*zone.table]),
      dimension_count_(graph.dimension_count),
      words_((zone.size + 63) / 64) {
  sort_into_classes(graph, zone);
  turn_around();
}

void ZoneArcs::sort_into_classes(const SearchGraph& graph, const Zone& zone) {
  std::map<std::vector<Amount>, std::uint32_t> classes;
  std::vector<Amount> used(dimension_count_);
  const auto class_of_uses = [&] {
    const auto [entry, is_new] = classes.emplace(used, class_count_);
    if (is_new) {
      used_.insert(used_.end(), used.begin(), used.end());
      ++class_count_;
    }
    return entry->second;
  };
  for (std::uint32_t head = 0; is_by_head() && head < zone.size; ++head) {
    std::ranges::copy(graph.uses(zone.first_node + head), used.begin());
    class_of_head_.push_back(class_of_uses());
  }
  for (std::size_t arc = 0; arc < table_->arcs.size(); ++arc) {
    const std::uint32_t head = table_->arcs[arc].head;
    if (is_by_head()) {
      class_of_arc_.push_back(class_of_head_[head]);
      continue;
    }
    std::ranges::copy(graph.uses(zone.first_node + head), used.begin());
    for (std::uint32_t d = 0; d < dimension_count_; ++d)
      used[d] = sum_up_to_unbounded(used[d], table_->arc_uses[arc * dimension_count_ + d]);
    class_of_arc_.push_back(class_of_uses());
  }
}

void ZoneArcs::turn_around() {
  const std::uint32_t nodes = table_->node_count();
  successors_.assign(nodes * words_, 0);
  predecessors_.assign(nodes * words_, 0);
  first_incoming_.assign(nodes + 1, 0);
  for (const auto& arc : table_->arcs) ++first_incoming_[arc.head + 1];
  for (std::uint32_t node = 0; node < nodes; ++node)
    first_incoming_[node + 1] += first_incoming_[node];
  incoming_.resize(table_->arcs.size());
  std::vector<std::uint32_t> next(first_incoming_.begin(), first_incoming_.end() - 1);
  for (std::uint32_t tail = 0; tail < nodes; ++tail) {
    for (std::uint32_t arc = table_->first[tail]; arc < table_->first[tail + 1]; ++arc) {
      const std::uint32_t head = table_->arcs[arc].head;
      incoming_[next[head]++] = {tail, arc};
      successors_[tail * words_ + head / 64] |= std::uint64_t{1} << (head % 64);
      predecessors_[head * words_ + tail / 64] |= std::uint64_t{1} << (tail % 64);
    }
  }
}

AllZoneArcs::AllZoneArcs(const SearchGraph& graph) {
  const auto uses_of = [&graph](const Zone& zone) {
    return std::vector<Amount>(
        graph.node_uses.begin() + std::size_t{zone.first_node} * graph.dimension_count,
        graph.node_uses.begin() + std::size_t{zone.first_node + zone.size} * graph.dimension_count);
  };
  std::map<std::pair<std::uint32_t, std::vector<Amount>>, std::size_t> known;
  for (const Zone& zone : graph.zones) {
    index_.emplace_back();
    if (!zone.table) continue;
    const auto [entry, is_new] = known.emplace(std::pair(*zone.table, uses_of(zone)), arcs_.size());
    if (is_new) arcs_.emplace_back(graph, zone);
    index_.back() = entry->second;
  }
}

}  // namespace plat::sequences
