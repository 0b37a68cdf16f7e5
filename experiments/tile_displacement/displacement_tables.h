#pragma once

#include <string>

#include "tile_displacement/displacement_experiment.h"

namespace plat::displacement {

/// A row per city, group, displacement and way.
std::string displacements_csv(const DisplacementConfig& config, const DisplacementResult& result);
/// Per city, way, displacement and measure: the mean over groups, its interval of 95 % by
/// resampling groups, and how many groups it stands on.
std::string curves_csv(const DisplacementConfig& config, const DisplacementResult& result);
/// Per city, displacement and similarity: the mean of its difference from moving without
/// replacement, group by group, with the same interval.
std::string replacements_csv(const DisplacementConfig& config, const DisplacementResult& result);
std::string cities_csv(const DisplacementConfig& config, const DisplacementResult& result);

}  // namespace plat::displacement
