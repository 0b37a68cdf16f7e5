#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "similarity/shape_similarity.h"
#include "tile_similarity/similarity_config.h"
#include "tile_similarity/tile_gallery.h"

namespace plat::tile_similarity {

/// How good the nearest are: shares of relevant tiles among the first 1 and 10. Absent where a
/// query has no relevant tile, or could not be compared.
struct QueryPrecision {
  std::optional<double> at_1;
  std::optional<double> at_10;
  std::optional<double> chance;  ///< share of relevant tiles among all candidates
};

/// One question to a gallery, by one measure.
struct TaskResult {
  std::string task;  ///< "same_zone", "same_block", or "copies_" and how they were changed
  std::vector<QueryPrecision> queries;  ///< per query of the gallery
  std::size_t failures = 0;             ///< copies that could not be made or prepared
};

struct MeasureResult {
  std::string measure;
  std::vector<TaskResult> tasks;
  /// Per query, the distances of all shapes of the gallery, laid on it; empty where it failed.
  std::vector<std::vector<double>> distances;
  std::size_t unprepared = 0;  ///< shapes of the gallery that the measure refuses
};

/// Ranks the gallery for every query, and its copies among the gallery. Draws do not depend on the
/// measure; the result does not depend on the number of threads.
MeasureResult run_retrieval(const TileGallery& gallery,
                            const similarity::AnyShapeSimilarity& measure,
                            const SimilarityConfig& config, const std::string& place, Jobs jobs);

/// Time of one pair, by one thread.
struct PairTime {
  double prepare_us = 0.0;  ///< per shape, median of five rounds
  double pair_us = 0.0;     ///< per pair, median of five rounds
  std::size_t pairs = 0;
};
PairTime time_pairs(const TileGallery& gallery, const similarity::AnyShapeSimilarity& measure,
                    const SimilarityConfig& config, const std::string& place);

}  // namespace plat::tile_similarity
