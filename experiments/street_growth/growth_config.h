#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/box.h"
#include "core/options.h"
#include "core/registry.h"
#include "street_growth/flattening.h"
#include "streets/network_recovery.h"
#include "streets/network_routes.h"
#include "streets/street_grower.h"

namespace plat::growth {

/// A city, or a part of one.
struct CityChoice {
  std::string dataset;
  std::optional<Box> window;  ///< in the projected CRS, metres
};

/// A strategy of the grid: strategy[options], on points of which some attributes say nothing.
struct Variant {
  std::string label;  ///< names its rows
  std::string strategy;
  OptionMap options;
  std::vector<Attribute> flattened;
  bool is_ablation = false;
  bool is_mapped = true;  ///< whether a layer of its edges is written
};

struct GrowthConfig {
  std::vector<CityChoice> cities;
  std::vector<Variant> variants;
  std::size_t reference = 0;  ///< the variant that all others are compared with
  int seeds = 20;
  int ablation_seeds = 20;
  double tile_m = 500.0;  ///< side of the squares that intervals and tests resample
  int resamples = 1000;
  int permutations = 2000;
  std::uint64_t seed = 1;
  streets::LengthRecoveryOptions length;
  streets::RouteOptions routes;

  [[nodiscard]] int seeds_of(const Variant& variant) const {
    return variant.is_ablation ? ablation_seeds : seeds;
  }
};

/// From a JSON object; `source` names it in messages. "strategies" is "all" or a list of
/// {label, name, options}; "ablations" are of the reference, {label, options, flatten}; "maps" are
/// labels of ablations that are mapped, as all strategies are.
/// @throws InputError for an unknown key, data set, strategy, option or attribute, a wrong type, a
///         value out of range, a label that comes twice: before anything runs
GrowthConfig parse_growth_config(const nlohmann::json& json, const std::string& source,
                                 const Registry<streets::AnyStreetGrower>& menu);

}  // namespace plat::growth
