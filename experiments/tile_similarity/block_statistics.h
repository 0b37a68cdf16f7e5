#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "statistics/quantile.h"

/// Blocks are the unit of every interval and test (ADR 0007): queries of one block are alike.
namespace plat::tile_similarity {

/// What the queries of a block gave.
struct BlockSum {
  double sum = 0.0;
  double count = 0.0;
};

/// Per block in order of its number, of the values that there are.
std::vector<BlockSum> block_sums(std::span<const std::uint32_t> blocks,
                                 std::span<const std::optional<double>> values);

struct BlockMean {
  double mean = 0.0;
  statistics::Interval interval;  ///< 95 %, percentiles
  std::size_t queries = 0;
  std::size_t blocks = 0;
};

/// Sum by count over blocks, with its bootstrap over blocks; absent where nothing was counted.
/// Streams come from (seed, replicate): two calls with as many blocks draw the same ones.
std::optional<BlockMean> block_mean(std::span<const BlockSum> blocks, int resamples,
                                    std::uint64_t seed);

struct BlockDifference {
  double difference = 0.0;  ///< of the means, a - b
  statistics::Interval interval;
  double p_value = 1.0;      ///< blocks change sides at random, two-sided
  double effect_size = 0.0;  ///< share of blocks where a's mean is larger, less that of smaller
};

/// Pre: the same queries on both sides. Absent where fewer than two blocks have any.
std::optional<BlockDifference> block_difference(std::span<const BlockSum> a,
                                                std::span<const BlockSum> b, int resamples,
                                                int permutations, std::uint64_t seed);

}  // namespace plat::tile_similarity
