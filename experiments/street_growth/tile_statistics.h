#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "statistics/quantile.h"
#include "streets/network_recovery.h"

/// Squares of a city are the unit of every interval and test, as blocks are for parcels (ADR 0007):
/// seeds repeat the growth of one city and say nothing of other places.
namespace plat::growth {

/// A share of sums over squares.
struct Quantity {
  std::string_view name;
  std::optional<double> (*value)(const streets::RecoveryShares&);
};
/// recall_01, precision_01, f1_01.
std::span<const Quantity> quantities();

streets::RecoveryShares sum_of(std::span<const streets::RecoveryShares> tiles);

/// Percentile interval (95 %) of the share: as many squares as there are, drawn with replacement.
/// Streams come from (seed, replicate): two calls with as many squares draw the same ones. Absent
/// where fewer than two squares are there, or no replicate has a value.
std::optional<statistics::Interval> share_interval(std::span<const streets::RecoveryShares> tiles,
                                                   const Quantity& quantity, int resamples,
                                                   std::uint64_t seed);

/// A variant held against another on the same squares.
struct TileDifference {
  double difference = 0.0;  ///< of the shares, a - b
  statistics::Interval interval;
  double p_value = 1.0;      ///< squares change sides at random, two-sided
  double effect_size = 0.0;  ///< share of squares where a's share is larger, less that of smaller
};

/// Absent where a share is, or fewer than two squares are there. Pre: as many squares on both
/// sides, in one order.
std::optional<TileDifference> tile_difference(std::span<const streets::RecoveryShares> a,
                                              std::span<const streets::RecoveryShares> b,
                                              const Quantity& quantity, int resamples,
                                              int permutations, std::uint64_t seed);

}  // namespace plat::growth
