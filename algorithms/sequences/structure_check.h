#pragma once

#include "sequences/sequence_problem.h"

namespace plat::sequences {

/// Whether the structure is one segment with free ends: a plain sequence.
bool is_plain(const Structure& structure);

/// Checks what a structure of key points must be before it can be taken apart.
/// @throws InputError naming the key point or segment: an index out of range, no allowed element or
///         not ascending ones, two segments at one port, bounds that are not 0 <= min <= max, a
///         key point or segment that nothing connects with the others
void check_structure(const SequenceProblem& problem);

}  // namespace plat::sequences
