#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sequences/sequence_path.h"

namespace plat::testing {

/// What plain enumeration found.
struct Enumeration {
  std::vector<sequences::SequencePath> paths;  ///< by (cost, steps), `k` at most
  bool is_complete = false;                    ///< there is no further path
};

/// The `k` cheapest feasible paths by trying every way, with a limit on the cost that grows until
/// there are enough. Shares no code with the strategies. Nothing where more than `max_visits` steps
/// would be tried: that is no answer.
std::optional<Enumeration> enumerate_paths(const sequences::SearchGraph& graph, std::size_t k,
                                           std::size_t max_visits = 60'000);

/// The `k` cheapest feasible paths by an exact k-best dynamic programme: of every (node, consumed)
/// the k cheapest ways to it, in order of cost. The second oracle, for problems that enumeration
/// does not finish. Shares no code with the strategies.
std::vector<sequences::SequencePath> k_best_paths(const sequences::SearchGraph& graph,
                                                  std::size_t k);

}  // namespace plat::testing
