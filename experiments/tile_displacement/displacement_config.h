#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/options.h"
#include "core/point.h"
#include "tile_displacement/displacement.h"

namespace plat::displacement {

/// A part of a data set.
struct CityChoice {
  std::string dataset;
  std::optional<std::size_t> tiles;  ///< the nearest to `near`; none: all
  std::optional<Point> near;         ///< in the CRS that the data set is read in; none: its middle
};

/// When deformed tiles give way to others (tiles/reconfiguration.h), by every similarity named.
struct ReplacementChoice {
  std::string way;  ///< one of the ways
  std::vector<std::string> similarities;
  double reach_m = 250.0;  ///< every candidate is a solution: fewer tiles make room than elsewhere
  double deformation_threshold = 0.25;
  double gap_threshold_m = 4.0;
  int candidates = 5;
  int max_rounds = 10;
  std::vector<double> displacements_m;  ///< of those of the experiment
  int groups = 6;                       ///< the first ones of each city
};

struct DisplacementConfig {
  std::vector<CityChoice> cities;
  std::vector<double> displacements_m;
  int groups = 12;               ///< drawn at random in each city
  double group_radius_m = 60.0;  ///< a group is a tile and those whose middles are as near to its
  double reach_m = 250.0;        ///< tiles farther than this from the group stay
  std::vector<Way> ways;
  std::optional<ReplacementChoice> replacement;
  int resamples = 2000;
  std::uint64_t seed = 1;
};

/// @throws InputError that names file, key, value and what is allowed
DisplacementConfig parse_displacement_config(const nlohmann::json& object,
                                             const std::string& source);

CityChoice read_city_choice(const nlohmann::json& object, const std::string& where);
std::vector<Way> read_ways(const nlohmann::json& list, const std::string& where);
/// [east, north] or any pair of numbers.
Point read_pair(const nlohmann::json& list, const std::string& where);

}  // namespace plat::displacement
