#pragma once

#include <string>

#include "sequences/compiled_problem.h"

namespace plat::cli {

/// Writes the intermediate graph of a problem, dead ends included, as JSON: `dimensions` (the
/// bounded resources), `states` topologically (element, consumed and level in whole steps, from
/// which side it was reached, whether it is left after pruning, whether a path may begin or end
/// there), `arcs` (from, to, cost in the user's unit).
/// @throws InputError for a graph of more than `kMostDrawnStates`, or a file that cannot be written
void write_graph(const sequences::CompiledProblem& compiled,
                 const sequences::SequenceProblem& problem, const std::string& file);
/// More cannot be looked at, and arcs would fill the disk.
inline constexpr std::uint64_t kMostDrawnStates = 20'000;

}  // namespace plat::cli
