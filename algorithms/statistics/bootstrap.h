#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "statistics/distances.h"
#include "statistics/grouped_sample.h"
#include "statistics/quantile.h"

namespace plat::statistics {

/// Replicates of the distances between two samples under the cluster bootstrap (Davison and Hinkley
/// 1997, sec. 3.8): as many groups as there are, drawn with replacement, each with its values of
/// both samples, since parcels of a block are not independent and both samples share their blocks.
///
/// Replicate r of two calls with the same number of groups and seed draws the same groups, so that
/// differences of replicates are replicates of the difference. Groups that are empty in either
/// sample must be left out first (select_groups). Independent of the number of threads.
/// Complexity: O(n log n + resamples n).
std::vector<Distances> bootstrap_distances(const GroupedSample& a, const GroupedSample& b,
                                           const Bins& bins, int resamples, std::uint64_t seed,
                                           Jobs jobs = {});

/// The interval at `level_01` of a distance from its replicates: percentiles, moved for bias.
///
/// A resample adds its own noise to a distance, which cannot be negative, so replicates lie above
/// the estimate on average, and the estimate above the truth for the same reason. The percentile
/// interval is moved down by twice that mean excess, cut at 0 and made to hold the estimate.
/// Measured on 400 clustered samples of 150 blocks, nominal 95 %: 88..92 % where the distance is
/// well above the noise floor (plain percentiles: 66..95 %), 84..95 % for KS and Wasserstein near
/// it, about half for Jensen-Shannon near it: there no interval is to be trusted, compare with
/// noise_floor.h.
Interval distance_interval(double estimate, std::span<const double> replicates, double level_01);

/// The same for a difference of two distances: the bias may have either sign, nothing is cut.
Interval difference_interval(double estimate, std::span<const double> replicates, double level_01);

/// One kind out of all replicates.
std::vector<double> pick(std::span<const Distances> replicates, DistanceKind kind);

}  // namespace plat::statistics
