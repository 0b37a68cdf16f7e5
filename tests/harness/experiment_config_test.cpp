#include "harness/experiment_config.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace plat::harness {
namespace {

using nlohmann::json;

json minimal() {
  return json::parse(
      R"({"experiment": "e", "datasets": ["monaco_mc"], "strategies": [{"name": "obb"}]})");
}

/// The message with which the config is refused.
std::string refusal(const json& config) {
  try {
    static_cast<void>(parse_config(config, "c.json"));
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << config.dump();
  return {};
}

void expect_refused(const char* patch, std::initializer_list<const char*> words) {
  json config = minimal();
  config.merge_patch(json::parse(patch));
  const std::string message = refusal(config);
  EXPECT_TRUE(message.starts_with("c.json: ")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const char* word : words) EXPECT_NE(message.find(word), std::string::npos) << message;
}

TEST(ExperimentConfig, FillsInDefaults) {
  const ExperimentConfig config = parse_config(minimal(), "c.json");
  EXPECT_EQ(config.repetitions, 1);
  EXPECT_EQ(config.seed, 1U);
  ASSERT_EQ(config.strategies.size(), 1U);
  EXPECT_EQ(config.strategies[0].label, "obb");
  EXPECT_EQ(config.strategies[0].fit, Fit::kPerBlock);
}

TEST(ExperimentConfig, WritesBackWhatItRead) {
  json config = minimal();
  config["strategies"][0]["options"]["snap_m"] = 0.25;
  config["strategies"][0]["label"] = "obb-fine";
  config["strategies"][0]["fit"] = "none";
  config["seed"] = 99;
  const json once = to_json(parse_config(config, "c.json"));
  EXPECT_EQ(once, to_json(parse_config(once, "c.json")));
  EXPECT_EQ(once["strategies"][0]["options"]["snap_m"], 0.25);
  EXPECT_EQ(once["seed"], 99);
}

TEST(ExperimentConfig, RefusesUnknownKeysWithASuggestion) {
  expect_refused(R"({"sed": 3})", {"unknown key \"sed\"", "did you mean \"seed\""});
  expect_refused(R"({"strategies": [{"name": "obb", "optons": {}}]})",
                 {"strategies[0]", "did you mean \"options\""});
  expect_refused(R"({"strategies": [{"name": "obb", "options": {"snap": 1}}]})",
                 {"strategies[0]", "did you mean \"snap_m\""});
  expect_refused(R"({"strategies": [{"name": "skeletton"}]})", {"did you mean \"skeleton\""});
  expect_refused(R"({"datasets": ["monaco_mx"]})", {"did you mean \"monaco_mc\""});
  expect_refused(R"({"statistics": {"resample": 3}})",
                 {"statistics", "did you mean \"resamples\""});
}

TEST(ExperimentConfig, RefusesValuesOutOfRangeAndOfTheWrongType) {
  expect_refused(R"({"repetitions": 0})", {"repetitions", "1..10000"});
  expect_refused(R"({"repetitions": 2.5})", {"whole number"});
  expect_refused(R"({"seed": -1})", {"seed"});
  expect_refused(R"({"seed": 18446744073709551615})", {"seed"});
  expect_refused(R"({"experiment": 3})", {"must be a text"});
  expect_refused(R"({"experiment": ""})", {"experiment"});
  expect_refused(R"({"datasets": null})", {"datasets"});
  expect_refused(R"({"datasets": [1]})", {"datasets"});
  expect_refused(R"({"strategies": []})", {"strategies"});
  expect_refused(R"({"strategies": [3]})", {"strategies[0]", "JSON object"});
  expect_refused(R"({"strategies": [{"name": "obb", "options": 3}]})", {"JSON object"});
  expect_refused(R"({"strategies": [{"name": "obb", "options": {"snap_m": true}}]})",
                 {"a number or a text"});
  expect_refused(R"({"strategies": [{"name": "obb", "options": {"snap_m": 1e9}}]})",
                 {"snap_m", "0..50"});
}

TEST(ExperimentConfig, ReadsASearchAndWritesItBack) {
  json config = minimal();
  config["strategies"][0]["search"] = json::parse(
      R"({"options": {"irregularity": [0, 0.5], "snap_m": [1]}, "measures": ["width_m"], "folds": 3})");
  const json once = to_json(parse_config(config, "c.json"));
  EXPECT_EQ(once, to_json(parse_config(once, "c.json")));
  EXPECT_EQ(once["strategies"][0]["search"]["options"]["irregularity"], json::parse("[0.0, 0.5]"));
  EXPECT_EQ(once["strategies"][0]["search"]["folds"], 3);
  EXPECT_FALSE(to_json(parse_config(minimal(), "c.json"))["strategies"][0].contains("search"));
}

TEST(ExperimentConfig, RefusesASearchThatCannotBeMade) {
  const auto expect_search_refused = [](const char* search,
                                        std::initializer_list<const char*> words) {
    const std::string patch =
        R"({"strategies": [{"name": "obb", "options": {"street_access": 1}, "search": )" +
        std::string(search) + "}]}";
    expect_refused(patch.c_str(), words);
  };
  expect_search_refused("3", {"search", "JSON object"});
  expect_search_refused("{}", {"\"options\"", "values to try"});
  expect_search_refused(R"({"options": {}})", {"values to try"});
  expect_search_refused(R"({"options": {"snap_m": 1}})", {"snap_m", "list of values"});
  expect_search_refused(R"({"options": {"snap_m": []}})", {"snap_m", "list of values"});
  expect_search_refused(R"({"options": {"snap_m": [1, 1]}})", {"snap_m", "twice"});
  expect_search_refused(R"({"options": {"snap_m": [true]}})", {"a number or a text"});
  expect_search_refused(R"({"options": {"snap": [1]}})", {"did you mean \"snap_m\""});
  expect_search_refused(R"({"options": {"snap_m": [1, 1e9]}})", {"snap_m", "0..50"});
  expect_search_refused(R"({"options": {"street_access": [0]}})", {"street_access", "also given"});
  expect_search_refused(R"({"options": {"snap_m": [1]}, "fold": 2})", {"did you mean \"folds\""});
  expect_search_refused(R"({"options": {"snap_m": [1]}, "folds": 1})", {"folds", "2..20"});
  expect_search_refused(R"({"options": {"snap_m": [1]}, "measures": ["area_m"]})",
                        {"unknown measure", "did you mean \"area_m2\""});
  expect_search_refused(R"({"options": {"snap_m": [1]}, "measures": ["has_street_access"]})",
                        {"unknown measure"});
  expect_search_refused(R"({"options": {"snap_m": [1]}, "measures": []})", {"measures"});
  json many = json::array();
  for (int i = 0; i < 50; ++i) many.push_back(0.01 * i);
  const json grid = {{"options", {{"irregularity", many}, {"snap_m", many}}}};
  expect_search_refused(grid.dump().c_str(), {"more than 2000 points"});
}

TEST(ExperimentConfig, LabelsAreDistinctPlainAndNoLayersOfOurs) {
  expect_refused(R"({"strategies": [{"name": "obb"}, {"name": "obb"}]})", {"two strategies"});
  expect_refused(R"({"strategies": [{"name": "obb", "label": "a/b"}]})", {"letters"});
  expect_refused(R"({"strategies": [{"name": "obb", "label": "failures"}]})", {"is taken"});
}

TEST(ExperimentConfig, MustBeAnObject) {
  EXPECT_NE(refusal(json::array()).find("JSON object"), std::string::npos);
  EXPECT_NE(refusal(json(3)).find("JSON object"), std::string::npos);
}

TEST(ExperimentConfig, ThoseThatComeWithPlatAreValid) {
  const auto experiments = list_experiments();
  ASSERT_FALSE(experiments.empty());
  for (const ExperimentSummary& e : experiments) {
    if (e.is_program) continue;
    EXPECT_NO_THROW(static_cast<void>(read_config(e.name))) << e.name;
    EXPECT_FALSE(e.question.empty()) << e.name;
  }
}

TEST(ExperimentConfig, AProgramOfItsOwnIsNotRunAsAGrid) {
  int programs = 0;
  for (const ExperimentSummary& e : list_experiments()) {
    if (!e.is_program) continue;
    ++programs;
    try {
      static_cast<void>(read_config(e.name));
      ADD_FAILURE() << e.name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(e.name + " --help"), std::string::npos);
    }
  }
  EXPECT_GT(programs, 0);
}

}  // namespace
}  // namespace plat::harness
