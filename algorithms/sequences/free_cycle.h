#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// The nodes of a zone's cycles of arcs that cost nothing and consume nothing of what the zone
/// bounds from above, with those that lead there; none where there is no such cycle.
std::vector<std::uint32_t> free_cycle(const SearchGraph& graph, const Zone& zone);

/// What is wrong with one, for an `InputError`.
inline constexpr std::string_view kFreeCycle =
    "transitions without a cost lead in a circle that consumes nothing that has an upper bound, "
    "so that there is no end of equal sequences; give them a cost or bound what they use";

}  // namespace plat::sequences
