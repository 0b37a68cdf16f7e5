#include "tile_similarity/block_statistics.h"

#include <cmath>
#include <map>
#include <string_view>

#include "core/failure.h"
#include "core/rng.h"

namespace plat::tile_similarity {
namespace {

constexpr double kLevel_01 = 0.95;
/// Differences that rounding may tell apart are equal.
constexpr double kSameShare = 1e-12;

Rng stream(std::string_view purpose, std::uint64_t seed, int replicate) {
  return Rng(derive_seed(seed, {seed_key(purpose), static_cast<std::uint64_t>(replicate)}));
}

double mean_of(std::span<const BlockSum> blocks) {
  BlockSum all;
  for (const BlockSum& block : blocks) {
    all.sum += block.sum;
    all.count += block.count;
  }
  return all.sum / all.count;
}

std::vector<BlockSum> drawn(std::span<const BlockSum> blocks, Rng& rng) {
  std::vector<BlockSum> out;
  for (std::size_t i = 0; i < blocks.size(); ++i) out.push_back(blocks[rng.index(blocks.size())]);
  return out;
}

double permutation_p(std::span<const BlockSum> a, std::span<const BlockSum> b, double observed,
                     int permutations, std::uint64_t seed) {
  int extreme = 0;
  for (int r = 0; r < permutations; ++r) {
    Rng rng = stream("permutation", seed, r);
    double difference = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      difference += (rng.index(2) == 1 ? -1.0 : 1.0) * (a[i].sum - b[i].sum);
      count += a[i].count;
    }
    extreme += std::abs(difference / count) >= std::abs(observed) - kSameShare ? 1 : 0;
  }
  return (1.0 + extreme) / (1.0 + permutations);
}

}  // namespace

std::vector<BlockSum> block_sums(std::span<const std::uint32_t> blocks,
                                 std::span<const std::optional<double>> values) {
  expects(blocks.size() == values.size(), "a block per value");
  std::map<std::uint32_t, BlockSum> sums;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    BlockSum& sum = sums[blocks[i]];
    sum.sum += *values[i];
    sum.count += 1.0;
  }
  std::vector<BlockSum> out;
  for (const auto& [block, sum] : sums) out.push_back(sum);
  return out;
}

std::optional<BlockMean> block_mean(std::span<const BlockSum> blocks, int resamples,
                                    std::uint64_t seed) {
  if (blocks.empty()) return std::nullopt;
  std::vector<double> replicates;
  for (int r = 0; r < resamples; ++r) {
    Rng rng = stream("bootstrap", seed, r);
    replicates.push_back(mean_of(drawn(blocks, rng)));
  }
  BlockMean out{mean_of(blocks), statistics::percentile_interval(replicates, kLevel_01), 0,
                blocks.size()};
  for (const BlockSum& block : blocks) out.queries += static_cast<std::size_t>(block.count);
  return out;
}

std::optional<BlockDifference> block_difference(std::span<const BlockSum> a,
                                                std::span<const BlockSum> b, int resamples,
                                                int permutations, std::uint64_t seed) {
  expects(a.size() == b.size(), "the same blocks on both sides");
  if (a.size() < 2) return std::nullopt;
  const double observed = mean_of(a) - mean_of(b);
  std::vector<double> replicates;
  for (int r = 0; r < resamples; ++r) {
    Rng for_a = stream("bootstrap", seed, r);
    Rng for_b = stream("bootstrap", seed, r);
    replicates.push_back(mean_of(drawn(a, for_a)) - mean_of(drawn(b, for_b)));
  }
  double dominance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double by = a[i].sum / a[i].count - b[i].sum / b[i].count;
    dominance += by > kSameShare ? 1.0 : by < -kSameShare ? -1.0 : 0.0;
  }
  return BlockDifference{observed, statistics::percentile_interval(replicates, kLevel_01),
                         permutation_p(a, b, observed, permutations, seed),
                         dominance / static_cast<double>(a.size())};
}

}  // namespace plat::tile_similarity
