#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace plat::tile_similarity {

/// Where a tile's zone comes from: the largest feature of a layer whose middle lies in the tile.
struct ZoneSource {
  std::string layer;
  std::string field;
};

/// Tiles of a data set that are compared with each other.
struct PlaceChoice {
  std::string name;
  std::string dataset;
  std::string layer;  ///< of the data set's file: "parcels" or "blocks"
  std::optional<ZoneSource> zones;
};

/// A matrix of `measure` within clusters, pruned by cheap measures.
struct PruningChoice {
  std::string dataset;
  int tiles = 2000;  ///< in the middle of the place; all of it is asked as well
  double percent = 1.0;
  std::string measure = "affine_vertex";
  std::vector<std::string> cheap;
  std::vector<std::uint32_t> keep;
  int places = 100;  ///< tiles for which candidates are searched
};

struct SimilarityConfig {
  std::vector<PlaceChoice> places;
  std::optional<PruningChoice> pruning;
  int gallery = 250;  ///< tiles to search in, by whole blocks
  int queries = 100;  ///< tiles of the gallery that are searched for
  int copies = 10;    ///< perturbed copies per query and kind
  int timed_pairs = 1000;
  int resamples = 1000;
  int permutations = 1000;
  std::uint64_t seed = 1;
};

/// @throws InputError for an unknown key, data set or value
SimilarityConfig parse_similarity_config(const nlohmann::json& object, const std::string& source);

}  // namespace plat::tile_similarity
