#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/parallel.h"
#include "geodata/layer_io.h"
#include "statistics/comparison.h"

namespace plat::harness {

struct LayerComparisonOutcome {
  std::size_t blocks = 0;
  std::size_t observed = 0;
  std::size_t generated = 0;
  std::size_t outside = 0;  ///< generated parcels in no observed block; each is a row
  std::size_t input_failures =
      0;  ///< observed parcels and blocks that could not be used; each is a row
};

/// Compares two parcel layers, whoever made them: blocks are the unions of the observed parcels,
/// edges facing what their gaps tell; generated parcels belong to the block that an interior point
/// of theirs lies in. Writes a run directory (docs/run_directory.md) whose data set and strategy
/// are the two layers.
/// @throws InputError as geodata::read_layer, and where no generated parcel lies in an observed
/// block
LayerComparisonOutcome compare_layers(const geodata::LayerSource& observed,
                                      const geodata::LayerSource& generated,
                                      const std::filesystem::path& out,
                                      const statistics::ComparisonOptions& options,
                                      std::uint64_t seed, Jobs jobs);

}  // namespace plat::harness
