#include "sequences/consumption.h"

#include <algorithm>

namespace plat::sequences {

Consumption::Consumption(const SearchGraph& graph) : graph_(&graph) {
  for (std::uint32_t z = 0; z < graph.zones.size(); ++z) {
    const Zone& zone = graph.zones[z];
    zone_of_node_.insert(zone_of_node_.end(), zone.size, z);
    for (const Bounds& bounds : zone.bounds)
      limits_.push_back({bounds.min, largest_amount(bounds), bounds.max == kUnbounded});
  }
  first_link_.assign(graph.node_count() + 1, 0);
  for (const Link& link : graph.links) ++first_link_[link.from + 1];
  for (std::uint32_t node = 0; node < graph.node_count(); ++node)
    first_link_[node + 1] += first_link_[node];
}

bool Consumption::add(std::uint32_t zone, std::span<Amount> consumed,
                      std::span<const Amount> used) const {
  const auto limit = limits(zone);
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    const std::int64_t sum = std::int64_t{consumed[d]} + used[d];
    if (sum > limit[d].largest && !limit[d].saturates) return false;
    consumed[d] = static_cast<Amount>(std::min<std::int64_t>(sum, limit[d].largest));
  }
  return true;
}

bool Consumption::follow_arc(std::uint32_t zone, std::uint32_t arc,
                             std::span<Amount> consumed) const {
  const TransitionTable& table = graph_->tables[*graph_->zones[zone].table];
  if (!table.arc_uses.empty()) {
    const std::span<const Amount> uses(
        table.arc_uses.data() + std::size_t{arc} * graph_->dimension_count,
        graph_->dimension_count);
    if (!add(zone, consumed, uses)) return false;
  }
  return add(zone, consumed, graph_->uses(graph_->zones[zone].first_node + table.arcs[arc].head));
}

bool Consumption::follow(const Link& link, std::span<Amount> consumed) const {
  const auto left = limits(zone_of(link.from));
  const std::uint32_t zone = zone_of(link.to);
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    if (!graph_->zones[zone].resets[d]) continue;
    if (consumed[d] < left[d].asked) return false;
    consumed[d] = 0;
  }
  return add(zone, consumed, graph_->uses(link.to));
}

bool Consumption::may_end(std::uint32_t zone, std::span<const Amount> consumed) const {
  const auto limit = limits(zone);
  for (std::size_t d = 0; d < consumed.size(); ++d)
    if (consumed[d] < limit[d].asked) return false;
  return true;
}

bool Consumption::before_arc(std::uint32_t zone, std::span<const Amount> consumed,
                             std::span<const Amount> used, std::span<AmountRange> before) const {
  const auto limit = limits(zone);
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    const Amount low = consumed[d] - used[d];
    const bool is_saturated = limit[d].saturates && consumed[d] == limit[d].largest;
    before[d] = {is_saturated ? std::max<Amount>(low, 0) : low,
                 is_saturated ? limit[d].largest : low};
    if (before[d].low < 0) return false;
  }
  return true;
}

bool Consumption::before_link(const Link& link, std::span<const Amount> consumed,
                              std::span<AmountRange> before) const {
  const std::uint32_t zone = zone_of(link.to);
  const auto left = limits(zone_of(link.from));
  const auto entered = limits(zone);
  if (!before_arc(zone, consumed, graph_->uses(link.to), before)) return false;
  for (std::size_t d = 0; d < consumed.size(); ++d) {
    if (graph_->zones[zone].resets[d]) {
      if (before[d].low > 0) return false;
      before[d] = {left[d].asked, left[d].largest};
    } else if (entered[d].saturates && consumed[d] == entered[d].largest) {
      before[d].high = left[d].largest;
    }
    before[d].high = std::min(before[d].high, left[d].largest);
    if (before[d].low > before[d].high) return false;
  }
  return true;
}

void Consumption::at_end(std::uint32_t zone, std::span<AmountRange> range) const {
  const auto limit = limits(zone);
  for (std::size_t d = 0; d < range.size(); ++d) range[d] = {limit[d].asked, limit[d].largest};
}

}  // namespace plat::sequences
