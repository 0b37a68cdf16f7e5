#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/failure.h"
#include "sequences/sequence_path.h"

namespace plat::sequences {

/// What a bound may be missed by, per quantum. None: it holds. 0: it is not there.
struct Stretch {
  std::optional<std::int64_t> below = {};  ///< the price of each quantum short of the minimum
  std::optional<std::int64_t> above = {};  ///< the price of each quantum beyond the maximum
};

/// A path, and the price of what its bounds are missed by.
struct StretchedPath {
  std::int64_t price = 0;
  SequencePath path;  ///< not feasible where the price is above 0
};

/// Whether costs break ties of price, or any path of the least price will do.
enum class PriceTies : std::uint8_t { kByCost, kAny };

/// The path of the least price, for bounds that may be stretched. Beyond a maximum states are not
/// told apart, because each further quantum is paid for as it is consumed: the search is finite,
/// and needs no guess how far a bound must be widened.
///
/// Guarantees: 1. exact: no path has a lower price, nor, `kByCost`, the same at a lower cost;
/// 2. nothing where no path misses only what may be stretched;  3. the same call gives the same
/// path.
/// @param stretches  by zone, then by dimension; zones that a dimension goes on through agree
/// @returns          Failure kTooManyStates beyond `max_states`
/// Complexity:       O(states x arcs of a node x log(states))
Expected<std::optional<StretchedPath>> stretched_path(
    const SearchGraph& graph, const std::vector<std::vector<Stretch>>& stretches, PriceTies ties,
    std::size_t max_states);

}  // namespace plat::sequences
