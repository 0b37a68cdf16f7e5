#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rcksp_scaling/scaling_config.h"
#include "sequences/compiled_problem.h"

namespace plat::rcksp {

/// One strategy in one cell.
struct ContenderResult {
  SearchRun guarded;              ///< alone in a process: whether it finishes, and its memory
  std::vector<SearchRun> rounds;  ///< paired: round i of all strategies ran together

  [[nodiscard]] bool is_ok() const { return guarded.status == RunStatus::kOk; }
};

/// One problem and all strategies on it.
struct CellResult {
  std::size_t study = 0;  ///< index into the config
  double value = 0.0;     ///< of what the study varies
  CellOptions options;
  std::vector<ContenderResult> contenders;  ///< as the config's strategies
  sequences::SequencePath best;             ///< of the first strategy that finished
};

/// Runs the grid: every cell's strategies first each in a guarded process of its own, which tells
/// who finishes; then those paired in this process, round after round in shuffled order.
///
/// Guarantees: 1. a row for every cell and strategy, whatever happened;  2. all strategies that are
/// ok in a cell found the same costs, the others are kDisagrees;  3. what is searched and found
/// depends on config and seed alone; what it took, on the machine.
/// @param tell  called with one line per cell and phase
std::vector<CellResult> run_scaling(const ScalingConfig& config,
                                    const Registry<sequences::AnySequenceSearch>& menu,
                                    const std::function<void(const std::string&)>& tell);

/// The cell's problem again: generators are fast, problems are large.
sequences::SequenceProblem cell_problem(const CellOptions& options, std::uint64_t seed);

}  // namespace plat::rcksp
