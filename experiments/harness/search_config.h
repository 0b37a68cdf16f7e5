#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/options.h"

namespace plat::harness {

/// Which options of a strategy are found, and by what: the product of the values is a grid, and its
/// best point on the blocks outside a fold divides the blocks of that fold (option_search.h).
struct SearchConfig {
  std::map<std::string, std::vector<OptionValue>, std::less<>> options;  ///< values to try, each
  std::vector<std::string> measures{"area_m2", "aspect_ratio"};  ///< the score is their mean
  int folds = 2;                                                 ///< parts of the blocks
};

/// A grid of more points is a mistake in the config.
inline constexpr std::size_t kMaxSearchPoints = 2000;

/// Every combination of the values: the last option, in the order of their keys, changes fastest.
std::vector<OptionMap> grid_points(const SearchConfig& search);

/// From a JSON object; `where` names it in messages.
/// @throws InputError for unknown keys and measures, wrong types, empty lists and doubled values
SearchConfig parse_search(const nlohmann::json& object, const std::string& where);

/// @throws InputError for options that the strategy does not have or that `given` fixes, and values
/// out of range
void expect_valid(const SearchConfig& search, const std::string& strategy, const OptionMap& given);

nlohmann::json to_json(const SearchConfig& search);

/// Options as a JSON object.
nlohmann::json options_json(const OptionMap& options);

}  // namespace plat::harness
