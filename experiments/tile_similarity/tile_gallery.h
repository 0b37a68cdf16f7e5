#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "similarity/labelled_shape.h"
#include "tile_similarity/similarity_config.h"

namespace plat::tile_similarity {

/// The tiles of a place that are searched in, and those that are searched for.
struct TileGallery {
  std::vector<similarity::LabelledShape> shapes;
  std::vector<std::string> ids;
  std::vector<std::uint32_t> blocks;   ///< per shape; of blocks, each is its own
  std::vector<std::uint32_t> queries;  ///< shapes, ascending
  std::size_t tiles = 0;               ///< usable ones of the whole place
  std::size_t refused = 0;             ///< features of the place that are no usable tile
};

/// The file that holds a data set's parcels. @throws InputError where it has none
std::string file_of(const std::string& dataset);

/// Whole blocks in random order until `gallery` tiles are there; `queries` of them at random.
/// @throws InputError for a data set that is not there or has no such layer
TileGallery read_gallery(const PlaceChoice& place, const SimilarityConfig& config, Jobs jobs);

}  // namespace plat::tile_similarity
