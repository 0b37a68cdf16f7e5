#pragma once

#include <string>

#include "layout_blending/blending_experiment.h"

namespace plat::blending {

/// A row per pair, way, weight and seed: every measure.
std::string blends_csv(const BlendingConfig& config, const BlendingResult& result);
/// Every measure of both examples as observed.
std::string examples_csv(const BlendingConfig& config, const BlendingResult& result);
/// Mean and the interval of 95 % of the seeds, by weight.
std::string weights_csv(const BlendingConfig& config, const BlendingResult& result);
/// Per pair, way and measure: does it move from one end to the other? Spearman's rank
/// correlation with the weight, its sign turned so that 1 is towards the irregular example's end,
/// with an interval that resamples seeds; how many weights' means lie between the ends', and how
/// far the farthest lies outside, as a share of the ends' distance.
std::string trends_csv(const BlendingConfig& config, const BlendingResult& result);
/// Kept streets: a row per street, its line as WKT.
std::string networks_csv(const BlendingConfig& config, const BlendingResult& result);

}  // namespace plat::blending
