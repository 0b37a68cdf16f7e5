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
    EXPECT_NO_THROW(static_cast<void>(read_config(e.name))) << e.name;
    EXPECT_FALSE(e.question.empty()) << e.name;
  }
}

}  // namespace
}  // namespace plat::harness
