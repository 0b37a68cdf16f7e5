#pragma once

#include <cstdint>

#include "sequences/cost_table.h"
#include "sequences/layer_plan.h"
#include "sequences/min_plus.h"
#include "sequences/search_graph.h"

namespace plat::sequences {

/// Fills the table with what the best completion costs: dynamic programming from the last zone to
/// the first, from large vectors to small ones. Returns the number of arcs relaxed.
///
/// Guarantees: 1. exact for every reached row;  2. the same for both `Value`s (32 bits serve where
/// `path_cost_bound` is below kInfinite<std::int32_t>) and for every instruction set.
template <class Value>
std::uint64_t fill_costs(const SearchGraph& graph, const LayerPlan& plan, InstructionSet set,
                         CostTable<Value>& table);

}  // namespace plat::sequences
