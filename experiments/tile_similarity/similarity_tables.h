#pragma once

#include <string>
#include <vector>

#include "tile_similarity/retrieval.h"
#include "tile_similarity/similarity_config.h"
#include "tile_similarity/tile_gallery.h"

namespace plat::tile_similarity {

/// What was found in one place.
struct PlaceResult {
  std::string place;
  TileGallery gallery;
  std::vector<MeasureResult> measures;  ///< in the order of the menu
  std::vector<PairTime> times;          ///< likewise
};

/// A row per place, task and measure: precision at 1 and 10 with intervals over blocks, chance.
std::string retrieval_csv(const SimilarityConfig& config, const std::vector<PlaceResult>& places);
/// A row per place, task and pair of measures: difference of precision at 10, its interval, a
/// paired permutation test over blocks, adjusted by Holm within the place and task.
std::string differences_csv(const SimilarityConfig& config, const std::vector<PlaceResult>& places);
/// A row per place and pair of measures: Spearman's correlation of a query's distances, mean over
/// queries.
std::string correlation_csv(const SimilarityConfig& config, const std::vector<PlaceResult>& places);
std::string times_csv(const std::vector<PlaceResult>& places);
/// Three queries per place and their five nearest by every measure, as WKT in the local frame.
std::string examples_csv(const std::vector<PlaceResult>& places);
/// A row per place: how many tiles, refused features, queries; per measure shapes it refuses.
std::string places_csv(const std::vector<PlaceResult>& places);

}  // namespace plat::tile_similarity
