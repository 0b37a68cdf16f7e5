#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "tile_similarity/similarity_config.h"

namespace plat::tile_similarity {

/// What a pruned matrix keeps of the full one, and what both cost.
struct PruningRow {
  std::size_t tiles = 0;
  std::size_t clusters = 0;
  std::string cheap;  ///< empty: the full matrix
  std::uint32_t keep = 0;
  std::size_t entries = 0;
  double recall_at_1 = 1.0;  ///< share of the full matrix's nearest that is kept
  double recall_at_10 = 1.0;
  double seconds = 0.0;  ///< wall clock, with preparing
};

/// The tiles nearest to the middle of the place, and all of it: the full matrix and pruned ones.
/// Empty where the config asks for none.
std::vector<PruningRow> run_pruning(const SimilarityConfig& config, Jobs jobs);

std::string pruning_csv(const std::vector<PruningRow>& rows);

}  // namespace plat::tile_similarity
