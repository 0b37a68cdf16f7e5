#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/rng.h"
#include "sequences/compiled_problem.h"

namespace plat::testing {

/// What stands where. Arrangements that differ in parallel transitions only are equal here, and
/// are counted as often as there are.
struct PlainArrangement {
  sequences::Cost cost = 0;
  std::vector<sequences::ElementIndex> key_points;
  std::vector<std::vector<sequences::ElementIndex>> segments;  ///< from `from` to `to`
  std::vector<std::int64_t> consumed;                          ///< by resource
  friend auto operator<=>(const PlainArrangement&, const PlainArrangement&) = default;
};

/// All arrangements of a structure, sorted, by trying all elements at all key points and all rows
/// between them, straight from the problem: no zones, no unrolling. Nothing where there are more
/// than `limit`, or
/// where they take too many steps to find.
std::optional<std::vector<PlainArrangement>> enumerate_arrangements(
    const sequences::SequenceProblem& problem, std::size_t limit = 1000);

/// The same, of the paths of the compiled graph; each is judged by `why_not_feasible`.
/// @throws LogicError where a path is not feasible
std::optional<std::vector<PlainArrangement>> arrangements_of_all_paths(
    const sequences::CompiledProblem& compiled, const sequences::SequenceProblem& problem,
    std::size_t limit = 1000);

/// How random structures are made.
struct StructureSize {
  std::uint32_t segments = 4;
  std::uint32_t filling = 2;
  std::uint32_t key_elements = 4;
  bool has_cycles = true;
};

/// A random structure over a random database: trees and cycles, free ends, reversed segments, arms,
/// stems, transitions stored in either order and with uses of their own, local and global bounds.
sequences::SequenceProblem random_structure_problem(Rng& rng, const StructureSize& size = {});

}  // namespace plat::testing
