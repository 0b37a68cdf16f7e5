#pragma once

#include "sequences/compiled_problem.h"

namespace plat::sequences {

/// What every compilation ends with: `validate` of its graph.
/// @throws LogicError as `validate`
/// @throws InputError naming the elements of a circle that costs and consumes nothing
void validate(const CompiledProblem& compiled, const SequenceDatabase& database);

}  // namespace plat::sequences
