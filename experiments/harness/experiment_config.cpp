#include "harness/experiment_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geodata/dataset_catalogue.h"
#include "harness/build_info.h"
#include "harness/config_reader_internal.h"
#include "parcels/block_subdivider.h"

namespace plat::harness {
namespace {

using nlohmann::json;

StrategyConfig read_strategy(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  StrategyConfig out;
  out.name = reader.text("name", "");
  out.label = reader.text("label", out.name);
  if (const json* options = reader.find("options")) out.options = read_options(*options, where);
  const std::string fit = reader.text("fit", "per_block");
  const json* search = reader.find("search");
  reader.expect_nothing_else();
  if (fit != "per_block" && fit != "none")
    throw InputError(fmt::format("{}: fit = \"{}\", allowed: per_block, none", where, fit));
  out.fit = fit == "none" ? Fit::kNone : Fit::kPerBlock;
  const auto is_plain = [](char c) {
    return (std::isalnum(static_cast<unsigned char>(c)) != 0) || c == '_' || c == '-';
  };
  if (!std::all_of(out.label.begin(), out.label.end(), is_plain) || out.label.empty()) {
    throw InputError(
        fmt::format("{}: label \"{}\" must be letters, digits, _ and - only", where, out.label));
  }
  for (const char* taken : {"observed", "blocks", "failures"}) {
    if (out.label == taken)
      throw InputError(
          fmt::format("{}: label \"{}\" is taken by a layer of that name", where, taken));
  }
  naming(where, [&] {  // a typo never runs an experiment
    static_cast<void>(parcels::block_subdividers().make(out.name, out.options));
  });
  if (search != nullptr) {
    out.search = parse_search(*search, where + ": search");
    naming(where + ": search", [&] { expect_valid(*out.search, out.name, out.options); });
  }
  return out;
}

}  // namespace

ExperimentConfig parse_config(const json& object, const std::string& source) {
  ObjectReader reader(object, source);
  ExperimentConfig out;
  out.experiment = reader.text("experiment", "");
  static_cast<void>(reader.text("question", ""));
  if (out.experiment.empty())
    throw InputError(source + ": \"experiment\" must name the experiment");
  const json* datasets = reader.find("datasets");
  if (datasets == nullptr || !datasets->is_array() || datasets->empty()) {
    throw InputError(source + ": \"datasets\" must be a list of data set names (plat data list)");
  }
  for (const json& name : *datasets) {
    if (!name.is_string()) throw InputError(source + ": \"datasets\" must hold names");
    naming(source, [&] { out.datasets.push_back(geodata::dataset(name.get<std::string>()).name); });
  }
  const json* strategies = reader.find("strategies");
  if (strategies == nullptr || !strategies->is_array() || strategies->empty()) {
    throw InputError(source + ": \"strategies\" must be a list (plat list strategies)");
  }
  for (std::size_t i = 0; i < strategies->size(); ++i) {
    out.strategies.push_back(
        read_strategy((*strategies)[i], fmt::format("{}: strategies[{}]", source, i)));
    for (std::size_t j = 0; j < i; ++j) {
      if (out.strategies[j].label == out.strategies[i].label) {
        throw InputError(
            fmt::format("{}: two strategies are labelled \"{}\": give one another \"label\"",
                        source, out.strategies[i].label));
      }
    }
  }
  out.repetitions = static_cast<int>(reader.whole("repetitions", 1, 1, 10000));
  out.seed = static_cast<std::uint64_t>(reader.whole("seed", 1, 0, std::int64_t{1} << 62));
  if (const json* statistics = reader.find("statistics")) {
    out.statistics = from_option_map<statistics::ComparisonOptions>(
        source + ": statistics", read_options(*statistics, source));
  }
  reader.expect_nothing_else();
  return out;
}

namespace {

/// Such an experiment is no grid of strategies: it is built as a program of its name.
bool has_program(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "main.cpp");
}

}  // namespace

ExperimentConfig read_config(const std::string& file_or_name) {
  std::filesystem::path path = file_or_name;
  if (!std::filesystem::exists(path)) {
    if (has_program(experiments_folder() / file_or_name)) {
      throw InputError(fmt::format("{0} is a program of its own: {0} --help", file_or_name));
    }
    path = experiments_folder() / file_or_name / "config.json";
    if (!std::filesystem::exists(path)) {
      std::vector<std::string> names;
      for (const auto& e : list_experiments()) names.push_back(e.name);
      const std::vector<std::string_view> views(names.begin(), names.end());
      throw InputError(
          fmt::format("{}: no such config file or experiment{} (plat list experiments)",
                      file_or_name, did_you_mean(file_or_name, views)));
    }
  }
  if (std::filesystem::is_directory(path)) path /= "config.json";
  std::ifstream in(path);
  if (!in) throw InputError(path.string() + ": cannot be read");
  try {
    return parse_config(json::parse(in), path.string());
  } catch (const json::parse_error& error) {
    throw InputError(fmt::format("{}: not valid JSON at byte {}", path.string(), error.byte));
  }
}

json to_json(const ExperimentConfig& config) {
  json out;
  out["experiment"] = config.experiment;
  out["datasets"] = config.datasets;
  out["repetitions"] = config.repetitions;
  out["seed"] = config.seed;
  out["statistics"] = options_json(to_option_map(config.statistics));
  for (const StrategyConfig& s : config.strategies) {
    json strategy{{"label", s.label},
                  {"name", s.name},
                  {"options", options_json(s.options)},
                  {"fit", s.fit == Fit::kNone ? "none" : "per_block"}};
    if (s.search) strategy["search"] = to_json(*s.search);
    out["strategies"].push_back(std::move(strategy));
  }
  return out;
}

std::vector<ExperimentSummary> list_experiments() {
  std::vector<ExperimentSummary> out;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(experiments_folder(), ignored)) {
    const bool is_program = has_program(entry.path());
    std::ifstream in(entry.path() / "config.json");
    if (!in && !is_program) continue;
    const json object = in ? json::parse(in, nullptr, false) : json::object();
    if (!object.is_object()) continue;
    const auto question = object.find("question");
    const bool has_question = question != object.end() && question->is_string();
    out.push_back({entry.path().filename().string(),
                   has_question ? question->get<std::string>() : std::string(), is_program});
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return out;
}

}  // namespace plat::harness
