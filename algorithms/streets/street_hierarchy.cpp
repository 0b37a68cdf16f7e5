#include "streets/street_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plat::streets {
namespace {

constexpr int kNoLevel = -1;

double importance_of(const StreetNetwork& network, const StreetChain& chain, Importance by) {
  switch (by) {
    case Importance::kLength:
      return length_m(network, chain);
    case Importance::kWidth:
      return width_m(network, chain);
    case Importance::kLengthTimesWidth:
      return length_m(network, chain) * width_m(network, chain);
  }
  return 0.0;
}

/// Chain indices, the most important first.
std::vector<std::uint32_t> by_importance(const StreetNetwork& network,
                                         const std::vector<StreetChain>& chains, Importance by) {
  std::vector<double> importance;
  importance.reserve(chains.size());
  for (const StreetChain& chain : chains) importance.push_back(importance_of(network, chain, by));
  std::vector<std::uint32_t> order(chains.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return importance[a] > importance[b]; });
  return order;
}

/// Labels whatever is reached from the chains of `queue`, breadth first.
void spread(std::vector<StreetChain>& chains,
            const std::vector<std::vector<std::uint32_t>>& chains_at,
            std::vector<std::uint32_t> queue) {
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const StreetChain& from = chains[queue[next]];
    for (const std::uint32_t node : from.nodes) {
      for (const std::uint32_t met : chains_at[node]) {
        if (chains[met].hierarchy != kNoLevel) continue;
        chains[met].hierarchy = from.hierarchy + 1;
        queue.push_back(met);
      }
    }
  }
}

}  // namespace

void assign_hierarchy(const StreetNetwork& network, std::vector<StreetChain>& chains,
                      const HierarchyOptions& options) {
  if (chains.empty()) return;
  std::vector<std::vector<std::uint32_t>> chains_at(network.nodes.size());
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    chains[c].hierarchy = kNoLevel;
    for (const std::uint32_t node : chains[c].nodes) chains_at[node].push_back(c);
  }
  std::vector<std::uint32_t> order = by_importance(network, chains, options.importance);
  const auto share = std::llround(options.main_share_01 * static_cast<double>(chains.size()));
  const auto main_count = static_cast<std::ptrdiff_t>(std::max(share, 1LL));
  for (auto main = order.begin(); main != order.begin() + main_count; ++main)
    chains[*main].hierarchy = 0;
  spread(chains, chains_at, {order.begin(), order.begin() + main_count});
  for (const std::uint32_t chain : order) {
    if (chains[chain].hierarchy != kNoLevel) continue;
    chains[chain].hierarchy = 0;
    spread(chains, chains_at, {chain});
  }
}

}  // namespace plat::streets
