#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/options.h"
#include "harness/search_config.h"
#include "statistics/comparison.h"

namespace plat::harness {

/// Whether a strategy's options are fitted to the observed parcels of each block.
enum class Fit { kPerBlock, kNone };

/// One strategy of the grid. Options given here win over fitted ones.
struct StrategyConfig {
  std::string label;  ///< names the layer; the strategy's name if not given
  std::string name;   ///< in the registry of block subdividers
  OptionMap options;
  Fit fit = Fit::kPerBlock;
  std::optional<SearchConfig> search = std::nullopt;  ///< options that are found, not given
};

/// What an experiment runs: data set x strategy[options] x repetition. The harness names no
/// strategy.
struct ExperimentConfig {
  std::string experiment;
  std::vector<std::string> datasets;
  std::vector<StrategyConfig> strategies;
  int repetitions = 1;
  std::uint64_t seed = 1;
  statistics::ComparisonOptions statistics;
};

/// From a JSON object; `source` names it in messages. Every key is checked: unknown keys,
/// strategies, data sets and options, wrong types, values out of range and doubled labels throw
/// InputError before anything runs.
ExperimentConfig parse_config(const nlohmann::json& json, const std::string& source);

/// Reads a config file; a name without a file of that name is looked up among the experiments that
/// come with Plat
/// (`experiments/<name>/config.json`).
ExperimentConfig read_config(const std::string& file_or_name);

/// The config with every default filled in, as the manifest keeps it.
nlohmann::json to_json(const ExperimentConfig& config);

/// Experiments that come with Plat: name and what it asks, by name.
struct ExperimentSummary {
  std::string name;
  std::string question;     ///< empty where only the README tells
  bool is_program = false;  ///< an executable of that name, not a config of this grid
};
std::vector<ExperimentSummary> list_experiments();

}  // namespace plat::harness
