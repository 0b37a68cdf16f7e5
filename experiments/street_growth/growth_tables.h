#pragma once

#include <optional>
#include <string>
#include <vector>

#include "street_growth/growth_cell.h"

namespace plat::growth {

/// All cells of one city; without a city where its data are not there.
struct CityResult {
  std::string label;
  std::string skipped;  ///< why there is nothing; empty where there is
  std::optional<KnownCity> city;
  std::vector<std::vector<GrowthCell>> cells;  ///< per variant, then seed
};

/// A row per city, variant and seed: what ran, whether it did, and its shares over the whole city.
std::string cells_csv(const GrowthConfig& config, const std::vector<CityResult>& cities,
                      const std::string& commit);

/// A row per city, variant, level ("all" and each) and share by edges or by length, over all seeds,
/// with its interval over squares.
std::string recovery_csv(const GrowthConfig& config, const std::vector<CityResult>& cities);

/// A row per city, variant other than the reference and share: the difference to the reference on
/// the seeds that both have, interval, p, p by Holm within city and share, effect size.
std::string differences_csv(const GrowthConfig& config, const std::vector<CityResult>& cities);

/// A row per city, variant, seed and measure with a distribution: KS and Wasserstein to the city.
std::string distances_csv(const GrowthConfig& config, const std::vector<CityResult>& cities);

/// A row per city, variant, seed and measure with one value: the city's and the grown one's.
std::string scalars_csv(const GrowthConfig& config, const std::vector<CityResult>& cities);

}  // namespace plat::growth
