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

/// What a search by way of the clusters finds of what comparing with every tile finds.
struct CandidateRow {
  std::size_t tiles = 0;
  std::size_t clusters = 0;
  int looked_into = 0;
  std::size_t places = 0;    ///< tiles searched for, themselves left out
  double recall_at_1 = 1.0;  ///< share of the nearest tiles that is found
  double recall_at_5 = 1.0;
  double milliseconds = 0.0;  ///< a search, by one thread
};

struct PruningResult {
  std::vector<PruningRow> matrices;
  std::vector<CandidateRow> candidates;
};

/// The tiles nearest to the middle of the place, and all of it: the full matrix and pruned ones;
/// candidates for places in the middle. Empty where the config asks for none.
PruningResult run_pruning(const SimilarityConfig& config, Jobs jobs);

std::string pruning_csv(const std::vector<PruningRow>& rows);
std::string candidates_csv(const std::vector<CandidateRow>& rows);

}  // namespace plat::tile_similarity
