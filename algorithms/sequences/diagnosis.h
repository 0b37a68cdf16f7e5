#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/failure.h"
#include "sequences/bound_use.h"

namespace plat::sequences {

/// The attainable amounts nearest to a bound, all other bounds kept. None: there is none there.
struct NearestAmounts {
  BoundUse bound;
  std::optional<std::int64_t> below;  ///< the largest below the minimum
  std::optional<std::int64_t> above;  ///< the smallest above the maximum
};

/// Why a problem has no sequence.
struct Diagnosis {
  /// What no transition leads beyond, in words; empty: without its bounds the problem has
  /// sequences.
  std::string gap;
  /// The smallest sets of bounds of which each, taken away, lets sequences be: all sets of the
  /// least size. Where trying them would take more than `kMostTrials` searches, one set that has no
  /// smaller one in it.
  std::vector<std::vector<BoundPlace>> cuts;
  bool has_all_cuts = true;
  std::vector<NearestAmounts> nearest;  ///< by bound, as `bounds_of`
};
inline constexpr std::size_t kMostTrials = 2000;

/// States that a diagnosis may meet in one of its searches.
struct DiagnosisLimits {
  std::size_t max_states = 5'000'000;
};

/// Says which bounds of a problem without sequences cut them off.
///
/// Guarantees: 1. exact: each question is a search over states in which the bounds in question may
/// be stretched (`stretched_path`, ADR 0024);  2. local bounds are told from those on the whole.
/// Pre: the problem has no sequence.
/// @returns  Failure kTooManyStates where a search meets more states than allowed
Expected<Diagnosis> diagnose(const CompiledProblem& compiled, const SequenceProblem& problem,
                             const DiagnosisLimits& limits = {});

/// How much it matters that a bound is kept.
struct BoundWeight {
  BoundPlace place;
  double weight = 1.0;  ///< per unit of the resource by which the bound is missed, above 0
};

/// The sequence that misses its bounds least.
struct Relaxation {
  double distance = 0.0;  ///< the sum of weight x distance to the bounds
  SequencePath path;
  std::vector<BoundUse> uses;  ///< what it consumes, against the bounds as they were
};

/// The best relaxation: of all sequences that keep the bounds without a weight, one whose sum of
/// weight x distance to the weighted bounds is least, and of those the cheapest.
///
/// Guarantees: 1. exact (`stretched_path`);  2. nothing where no sequence keeps the bounds without
/// a weight.
/// @returns  Failure kTooManyStates where the search meets more states than allowed
/// @throws InputError  for a weight that is not above 0, for weights that have no common measure of
///                     at most 9 decimals, or where no such bound is
/// Paper:     [Har, Sec. 7.3.3]
/// Deviation: no placeholder nodes are added to a graph that does not connect; what they would fill
///            is paid for where it is consumed or missing (ADR 0024)
Expected<std::optional<Relaxation>> relax(const CompiledProblem& compiled,
                                          const SequenceProblem& problem,
                                          const std::vector<BoundWeight>& weights,
                                          const DiagnosisLimits& limits = {});

/// "length_m", or "length_m of north".
std::string place_name(const SequenceProblem& problem, const BoundPlace& place);
/// The segment's name, or its number where it has none.
std::string segment_name(const SequenceProblem& problem, std::size_t segment);

}  // namespace plat::sequences
