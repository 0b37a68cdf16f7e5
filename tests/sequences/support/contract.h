#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sequences/sequence_search.h"

namespace plat::testing {

/// What `why_not_in_contract` says of a search that was right until it gave up.
inline constexpr std::string_view kGivesUp = "gives up";

/// What the first `k` paths of a search break of the contract of `SequenceSearch`, in words, or an
/// empty string. `best`: the oracle's first k, all where there are fewer.
template <sequences::SequenceSearch Search>
std::string why_not_in_contract(const Search& search, const sequences::SearchGraph& graph,
                                const std::vector<sequences::SequencePath>& best, std::size_t k) {
  const auto stream = search.search(graph);
  if (!stream) return "search: " + stream.error().message;
  std::set<std::vector<sequences::Step>> seen;
  sequences::SequencePath path{-1, {{7, 7}}};  // what is in it must not matter
  for (std::size_t i = 0; i < k; ++i) {
    const auto more = (*stream)->next(path);
    if (!more && more.error().code == FailureCode::kTooManyStates) return std::string(kGivesUp);
    if (!more) return fmt::format("path {}: {}", i, more.error().message);
    if (!*more) {
      if (i < best.size()) return fmt::format("ends after {} of {} paths", i, best.size());
      for (int again = 0; again < 2; ++again)
        if (const auto after = (*stream)->next(path); !after || *after)
          return "goes on after its end";
      return {};
    }
    if (const std::string wrong = why_not_feasible(graph, path); !wrong.empty())
      return fmt::format("path {}: {}", i, wrong);
    if (i >= best.size()) return fmt::format("path {} of {}", i, best.size());
    if (!seen.insert(path.steps).second) return fmt::format("path {} came before", i);
    if (path.cost != best[i].cost)
      return fmt::format("path {} costs {}, the oracle's {}", i, path.cost, best[i].cost);
  }
  return {};
}

}  // namespace plat::testing
