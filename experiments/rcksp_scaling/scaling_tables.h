#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rcksp_scaling/scaling_experiment.h"
#include "statistics/quantile.h"

namespace plat::rcksp {

/// A row per timed search: what ratios and intervals are made from.
std::string runs_csv(const ScalingConfig& config, const std::vector<CellResult>& cells);

/// A row per cell and strategy, those that did not finish included: medians over rounds, the least
/// total, counts, memory, and the ratio of totals to the reference with its interval.
std::string cells_csv(const ScalingConfig& config, const std::vector<CellResult>& cells);

/// A row per study, strategy and quantity that grows as a power law of what the study varies, with
/// published curves of the same study fitted alike.
std::string exponents_csv(const ScalingConfig& config, const std::vector<CellResult>& cells);

/// The best sequence of every cell, a row per building in its order.
std::string solutions_csv(const ScalingConfig& config, const std::vector<CellResult>& cells);

/// What the first cell's database holds.
std::string buildings_csv(const ScalingConfig& config);

/// How many times as long as the reference a strategy took.
struct Ratio {
  double median = 0.0;  ///< over rounds
  statistics::Interval interval;
};

/// The time on the clock, or what the processors spent: the steadier on a machine that does other
/// things too, and the same for strategies of one thread.
enum class Clock : std::uint8_t { kWall, kProcessor };

/// The ratio of total times round by round, over the rounds that both have; rounds are resampled
/// for the interval (95 %, percentiles of the median). Nothing where one did not finish.
std::optional<Ratio> ratio_to(const ContenderResult& reference, const ContenderResult& contender,
                              Clock clock, int resamples, std::uint64_t seed);

}  // namespace plat::rcksp
