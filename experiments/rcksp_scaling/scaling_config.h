#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/registry.h"
#include "rcksp_scaling/search_run.h"
#include "rcksp_scaling/street_database.h"
#include "sequences/sequence_search.h"

namespace plat::rcksp {

/// A strategy of the grid: strategy[options].
struct StrategyChoice {
  std::string label;  ///< names its rows; the strategy's name if not given
  std::string name;   ///< in the registry of sequence searches
  OptionMap options;
};

/// One curve: an option of the cell that varies while the others stay.
struct Study {
  std::string name;
  std::string title;
  std::string vary;  ///< a key of CellOptions
  std::vector<double> values;
  OptionMap set;  ///< what differs from the defaults of CellOptions
  /// A strategy that does not finish at one value is not tried at those behind it.
  bool is_easiest_first = true;

  [[nodiscard]] CellOptions cell(double value) const;
};

/// Numbers of others, fitted as ours are.
struct PublishedCurve {
  std::string label;
  std::string study;
  std::string quantity;  ///< as in exponents.csv
  std::vector<double> values;
  std::vector<double> numbers;  ///< one per value
};

struct ScalingConfig {
  std::vector<StrategyChoice> strategies;
  std::vector<Study> studies;
  std::vector<PublishedCurve> published;
  std::string reference;       ///< label of the strategy that all others are compared with
  int rounds = 9;              ///< of paired repetitions
  double cell_budget_s = 2.0;  ///< a slow strategy has fewer rounds, but kLeastRounds of them
  RunLimits limits;
  int resamples = 1000;
  std::uint64_t seed = 1;
};
inline constexpr int kLeastRounds = 3;

/// From a JSON object; `source` names it in messages. "strategies" is "all" or a list.
/// @throws InputError for an unknown key, strategy or option, a wrong type, a value out of range, a
///         label that comes twice: before anything runs
ScalingConfig parse_scaling_config(const nlohmann::json& json, const std::string& source,
                                   const Registry<sequences::AnySequenceSearch>& menu);

}  // namespace plat::rcksp
