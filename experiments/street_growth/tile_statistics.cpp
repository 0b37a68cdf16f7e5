#include "street_growth/tile_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/failure.h"
#include "core/rng.h"

namespace plat::growth {
namespace {

using streets::RecoveryShares;

constexpr double kLevel_01 = 0.95;
/// Differences that rounding may tell apart are equal.
constexpr double kSameShare = 1e-12;

Rng stream(std::string_view purpose, std::uint64_t seed, int replicate) {
  return Rng(derive_seed(seed, {seed_key(purpose), static_cast<std::uint64_t>(replicate)}));
}

RecoveryShares drawn(std::span<const RecoveryShares> tiles, Rng& rng) {
  RecoveryShares sum;
  for (std::size_t i = 0; i < tiles.size(); ++i) sum += tiles[rng.index(tiles.size())];
  return sum;
}

double dominance(std::span<const RecoveryShares> a, std::span<const RecoveryShares> b,
                 const Quantity& quantity) {
  int more = 0;
  int less = 0;
  int both = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto in_a = quantity.value(a[i]);
    const auto in_b = quantity.value(b[i]);
    if (!in_a || !in_b) continue;
    ++both;
    more += *in_a > *in_b + kSameShare ? 1 : 0;
    less += *in_b > *in_a + kSameShare ? 1 : 0;
  }
  return both == 0 ? 0.0 : static_cast<double>(more - less) / both;
}

std::optional<double> difference(const RecoveryShares& a, const RecoveryShares& b,
                                 const Quantity& quantity) {
  const auto in_a = quantity.value(a);
  const auto in_b = quantity.value(b);
  if (!in_a || !in_b) return std::nullopt;
  return *in_a - *in_b;
}

double permutation_p(std::span<const RecoveryShares> a, std::span<const RecoveryShares> b,
                     const Quantity& quantity, double observed, int permutations,
                     std::uint64_t seed) {
  int extreme = 0;
  for (int r = 0; r < permutations; ++r) {
    Rng rng = stream("permutation", seed, r);
    RecoveryShares x;
    RecoveryShares y;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool is_swapped = rng.index(2) == 1;
      x += is_swapped ? b[i] : a[i];
      y += is_swapped ? a[i] : b[i];
    }
    const double swapped = difference(x, y, quantity).value_or(0.0);
    extreme += std::abs(swapped) >= std::abs(observed) - kSameShare ? 1 : 0;
  }
  return (1.0 + extreme) / (1.0 + permutations);
}

}  // namespace

std::span<const Quantity> quantities() {
  static constexpr std::array kAll{
      Quantity{"recall_01", [](const RecoveryShares& s) { return s.recall_01(); }},
      Quantity{"precision_01", [](const RecoveryShares& s) { return s.precision_01(); }},
      Quantity{"f1_01", [](const RecoveryShares& s) { return s.f1_01(); }},
  };
  return kAll;
}

RecoveryShares sum_of(std::span<const RecoveryShares> tiles) {
  RecoveryShares sum;
  for (const RecoveryShares& tile : tiles) sum += tile;
  return sum;
}

std::optional<statistics::Interval> share_interval(std::span<const RecoveryShares> tiles,
                                                   const Quantity& quantity, int resamples,
                                                   std::uint64_t seed) {
  std::vector<double> replicates;
  for (int r = 0; r < resamples && tiles.size() > 1; ++r) {
    Rng rng = stream("bootstrap", seed, r);
    if (const auto value = quantity.value(drawn(tiles, rng))) replicates.push_back(*value);
  }
  if (replicates.empty()) return std::nullopt;
  return statistics::percentile_interval(replicates, kLevel_01);
}

std::optional<TileDifference> tile_difference(std::span<const RecoveryShares> a,
                                              std::span<const RecoveryShares> b,
                                              const Quantity& quantity, int resamples,
                                              int permutations, std::uint64_t seed) {
  expects(a.size() == b.size(), "both sides have the same squares");
  const auto observed = difference(sum_of(a), sum_of(b), quantity);
  if (!observed || a.size() < 2) return std::nullopt;
  std::vector<double> replicates;
  for (int r = 0; r < resamples; ++r) {
    Rng for_a = stream("bootstrap", seed, r);
    Rng for_b = stream("bootstrap", seed, r);
    if (const auto value = difference(drawn(a, for_a), drawn(b, for_b), quantity))
      replicates.push_back(*value);
  }
  if (replicates.empty()) return std::nullopt;
  return TileDifference{*observed, statistics::percentile_interval(replicates, kLevel_01),
                        permutation_p(a, b, quantity, *observed, permutations, seed),
                        dominance(a, b, quantity)};
}

}  // namespace plat::growth
