#pragma once

#include "sequences/compiled_problem.h"

namespace plat::sequences {

/// Unrolls a structure of key points to a search graph: one path through it meets all segments.
///
/// Of each segment, in the order of `visit_order`:
///
///     start zone            interior zones              end zone
///     the key element       the filling elements,       the key element that
///     left, once more;      one zone per context        is arrived at
///     local amounts
///     begin at its arm
///
/// The key element is consumed where it is placed, which is where it is first met; where it is left
/// again, or a cycle arrives at it, it is a virtual duplicate that consumes but its arm.
///
/// Guarantees: those of `compile`; beyond that 1. all interior zones that are walked in one
/// direction share one table;  2. a chain of key points has one interior zone per segment.
/// @throws InputError as `check_structure` and `decompose`, and where the copies would have more
///         than `kMostUnrolledLinks` links
/// Complexity: O(contexts x filling elements x the elements that key points may take)
/// Paper:      [Har, Sec. 3.3.4, Fig. 3.4, 3.5]
/// Deviation:  contexts also tell cycles that share key points apart (ADR 0023)
CompiledProblem unroll(const SequenceProblem& problem);
inline constexpr double kMostUnrolledLinks = 1e7;

}  // namespace plat::sequences
