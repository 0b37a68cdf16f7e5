#include "rcksp_scaling/scaling_experiment.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/made_searches.h"
#include "rcksp_scaling/scaling_tables.h"

namespace plat::rcksp {
namespace {

using nlohmann::json;
using Menu = Registry<sequences::AnySequenceSearch>;

const Menu& menu() {
  static const Menu kMenu = [] {
    Menu all;
    all.add<ExhaustiveSearch>();
    all.add<SecondBestSearch>();
    all.add<EndlessSearch>();
    all.add<HungrySearch>();
    return all;
  }();
  return kMenu;
}

json object(const std::vector<std::string>& strategies) {
  json out = json::parse(R"({
    "rounds": 4, "time_limit_s": 0.2, "resamples": 50, "reference": "exhaustive",
    "studies": [{"name": "short", "vary": "length_m", "values": [30, 40, 50],
                 "set": {"elements": 4, "k": 3, "length_slack_m": 5}}]})");
  for (const std::string& name : strategies) out["strategies"].push_back({{"name", name}});
  return out;
}

ScalingConfig config(const std::vector<std::string>& strategies) {
  return parse_scaling_config(object(strategies), "test", menu());
}

std::vector<CellResult> run(const ScalingConfig& what) {
  return run_scaling(what, menu(), [](const std::string&) {});
}

TEST(RckspScaling, PairsRoundsOfWhoeverFinishes) {
  const auto cells = run(config({"exhaustive"}));
  ASSERT_EQ(cells.size(), 3U);
  for (const CellResult& cell : cells) {
    EXPECT_TRUE(cell.contenders[0].is_ok());
    EXPECT_EQ(cell.contenders[0].rounds.size(), 4U);
  }
  EXPECT_EQ(cells.back().contenders[0].guarded.found, 3U);
  EXPECT_FALSE(cells.back().best.steps.empty());
}

TEST(RckspScaling, TellsWhoDisagrees) {
  const auto cells = run(config({"exhaustive", "second_best"}));
  EXPECT_TRUE(cells.back().contenders[0].is_ok());
  EXPECT_EQ(cells.back().contenders[1].guarded.status, RunStatus::kDisagrees);
  EXPECT_TRUE(cells.back().contenders[1].rounds.empty());
}

TEST(RckspScaling, EndsWhatDoesNotFinishAndTriesItNoMore) {
  const auto cells = run(config({"exhaustive", "endless", "hungry"}));
  EXPECT_EQ(cells[0].contenders[1].guarded.status, RunStatus::kTimeLimit);
  EXPECT_EQ(cells[0].contenders[2].guarded.status, RunStatus::kMemoryLimit);
  EXPECT_EQ(cells[1].contenders[1].guarded.status, RunStatus::kNotTried);
  EXPECT_EQ(cells[2].contenders[2].guarded.status, RunStatus::kNotTried);
  EXPECT_TRUE(cells[2].contenders[0].is_ok());
}

TEST(RckspScaling, FindsTheSameInEveryRun) {
  const auto what = config({"exhaustive"});
  EXPECT_EQ(solutions_csv(what, run(what)), solutions_csv(what, run(what)));
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

TEST(RckspScaling, WritesARowForEveryCellAndStrategy) {
  const auto what = config({"exhaustive", "endless"});
  const auto cells = run(what);
  for (const std::string& text :
       {runs_csv(what, cells), cells_csv(what, cells), exponents_csv(what, cells),
        solutions_csv(what, cells), buildings_csv(what)}) {
    const auto rows = lines(text);
    ASSERT_GT(rows.size(), 1U);
    for (const std::string& row : rows)
      EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(rows.front(), ',')) << row;
  }
  const auto rows = lines(cells_csv(what, cells));
  EXPECT_EQ(rows.size(), 1U + 3U * 2U);
  EXPECT_NE(rows[2].find(",time_limit,0,"), std::string::npos) << rows[2];
  EXPECT_EQ(lines(runs_csv(what, cells)).size(), 1U + 3U * 4U);
}

TEST(RckspScaling, FitsPublishedCurvesBesideItsOwn) {
  json with = object({"exhaustive"});
  with["published"] = json::parse(R"([{"label": "paper", "study": "short", "quantity": "total_s",
      "values": [10, 20, 40], "numbers": [1, 4, 16]}])");
  const auto what = parse_scaling_config(with, "test", menu());
  EXPECT_NE(exponents_csv(what, run(what)).find("short,length_m,paper,total_s,2"),
            std::string::npos);
}

ContenderResult taking(std::initializer_list<double> seconds) {
  ContenderResult out;
  for (const double s : seconds) {
    SearchRun run;
    run.first.wall_s = s;
    out.rounds.push_back(run);
  }
  return out;
}

TEST(RckspScaling, ComparesRoundByRound) {
  const auto ratio =
      ratio_to(taking({1.0, 2.0, 4.0}), taking({3.0, 6.0, 12.0, 99.0}), Clock::kWall, 100, 1);
  ASSERT_TRUE(ratio);
  EXPECT_DOUBLE_EQ(ratio->median, 3.0);
  EXPECT_DOUBLE_EQ(ratio->interval.low, 3.0);
  EXPECT_DOUBLE_EQ(ratio->interval.high, 3.0);
  ContenderResult unfinished;
  unfinished.guarded.status = RunStatus::kTimeLimit;
  EXPECT_FALSE(ratio_to(taking({1.0}), unfinished, Clock::kWall, 100, 1));
}

TEST(ScalingConfig, RefusesWhatMakesNoSense) {
  const auto refused = [](const char* pointer, json value) {
    json bad = object({"exhaustive"});
    bad[json::json_pointer(pointer)] = std::move(value);
    EXPECT_THROW(parse_scaling_config(bad, "test", menu()), InputError) << bad;
  };
  EXPECT_NO_THROW(config({"exhaustive"}));
  refused("/strategies/0/name", "exhausted");
  refused("/strategies/0/options", {{"unknown", 1}});
  refused("/strategies", json::array({{{"name", "endless"}}, {{"name", "endless"}}}));
  refused("/reference", "nobody");
  refused("/rounds", 0);
  refused("/roundz", 1);
  refused("/studies/0/vary", "colour");
  refused("/studies/0/values", {-3});
  refused("/studies/0/set", {{"length_m", 10}});
  refused("/studies/0/on_unfinished", "stop");
  refused("/time_limit_s", "long");
}

}  // namespace
}  // namespace plat::rcksp
