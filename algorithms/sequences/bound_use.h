#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sequences/compiled_problem.h"

namespace plat::sequences {

/// Where a bound holds: on one resource, on the whole or on one segment.
struct BoundPlace {
  std::uint32_t resource = 0;
  std::optional<std::uint32_t> segment = {};  ///< none: the whole
  friend auto operator<=>(const BoundPlace&, const BoundPlace&) = default;
};

/// A bound and what is consumed of it.
struct BoundUse {
  BoundPlace place;
  Bounds bounds;
  std::int64_t consumed = 0;
};

/// What a dimension counts in a zone.
BoundPlace place_of(const CompiledProblem& compiled, std::size_t dimension, std::size_t zone);

/// The bounds of a problem that limit something: those on the whole by resource, then the local
/// ones by segment and resource. In a plain sequence, which has one segment, both are the whole.
std::vector<BoundUse> bounds_of(const CompiledProblem& compiled);

/// The same, with what a path of the graph consumes of each, transitions included.
///
/// Guarantees: 1. amounts are whole, not cut off at a minimum.
std::vector<BoundUse> bound_uses(const CompiledProblem& compiled, const SequencePath& path);

}  // namespace plat::sequences
