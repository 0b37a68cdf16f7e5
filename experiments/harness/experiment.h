#pragma once

#include <cstddef>
#include <filesystem>

#include "core/parallel.h"
#include "harness/experiment_config.h"

namespace plat::harness {

/// Whether finished cells of an earlier run are taken over.
enum class Resume { kNo, kYes };

struct ExperimentOutcome {
  std::size_t blocks = 0;    ///< blocks times strategies times repetitions
  std::size_t failures = 0;  ///< of those; each is a row
  std::size_t input_failures =
      0;  ///< observed parcels and blocks that could not be used; each is a row
  std::size_t resumed_cells = 0;
};

/// Runs the grid data set x strategy[options] x repetition and writes the run directory
/// (docs/run_directory.md).
///
/// Guarantees: 1. the same config gives the same bytes, whatever the number of threads, but for
/// timings.json;
/// 2. every failure is a row of blocks.csv and a feature of the layer `failures`;  3. a file is
/// there whole or not at all, manifest.json last.
/// @throws InputError for a data set that is not there, or an output folder that cannot be written
ExperimentOutcome run_experiment(const ExperimentConfig& config, const std::filesystem::path& out,
                                 Jobs jobs, Resume resume);

}  // namespace plat::harness
