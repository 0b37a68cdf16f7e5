#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/options.h"
#include "core/point.h"
#include "synthesis/point_blend.h"

namespace plat::blending {

/// A square window of a data set.
struct ExampleChoice {
  std::string dataset;
  Point centre_m;  ///< in the CRS that the data set is read in
};

/// Two examples whose points are blended one over the other.
struct PairChoice {
  std::string name;
  ExampleChoice grid;
  ExampleChoice irregular;
};

/// A way to choose and place points.
struct BlendWay {
  std::string name;
  synthesis::BlendPositions positions = synthesis::BlendPositions::kThinned;
  std::int64_t patch_places = 20;
};

struct BlendingConfig {
  std::vector<PairChoice> pairs;
  double window_m = 1200.0;
  std::string grower;
  OptionMap grower_options;
  std::vector<BlendWay> ways;
  std::vector<double> weights_01;
  int seeds = 20;
  int resamples = 2000;
  std::uint64_t seed = 1;
};

/// @throws InputError that names file, key, value and what is allowed
BlendingConfig parse_blending_config(const nlohmann::json& object, const std::string& source);

}  // namespace plat::blending
