#include "harness/option_search.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::harness {
namespace {

/// Blocks whose observed parcels come from a strategy with known options.
class MadePlace {
 public:
  MadePlace(const std::string& name, int count, const StrategyConfig& truth) {
    Rng rng = testing::property_rng(name);
    for (Polygon& shape : testing::synthetic_blocks(rng, count)) {
      const BlockId id{static_cast<std::uint32_t>(blocks.size())};
      blocks.push_back(blocks::block_from_contour(id, std::move(shape)));
    }
    Progress progress("test", blocks.size(), Progress::Style::kQuiet);
    for (DividedBlock& block : subdivide_blocks(blocks, truth, {}, "made", 1, 0, {1}, progress)) {
      std::vector<Polygon> shapes;
      for (const parcels::Parcel& p : *block.parcels) shapes.push_back(p.shape);
      styles.push_back(parcels::style_of(blocks[styles.size()], shapes));
      observed.push_back(std::move(block.measures));
    }
  }

  [[nodiscard]] SearchPlace view() const { return {"made", blocks, styles, observed}; }

  std::vector<blocks::Block> blocks;
  std::vector<parcels::ParcelStyle> styles;
  std::vector<std::vector<parcels::ParcelMeasures>> observed;
};

StrategyConfig with_options(const std::string& name, OptionMap options) {
  return {name, name, std::move(options), Fit::kNone};
}

StrategyConfig obb_search(std::vector<OptionValue> area_max_m2) {
  StrategyConfig strategy = with_options("obb", {});
  strategy.search = SearchConfig{};
  strategy.search->options = {{"area_max_m2", std::move(area_max_m2)}};
  return strategy;
}

SearchResult search(const MadePlace& place, const StrategyConfig& strategy, int jobs = 2) {
  return search_options(place.view(), strategy, 20, 1, Jobs{jobs});
}

void expect_same(const SearchResult& a, const SearchResult& b) {
  EXPECT_EQ(to_json(a), to_json(b));
}

TEST(OptionSearch, FindsTheOptionsThatMadeThePlace) {
  const MadePlace place("Search.Truth", 60, with_options("obb", {{"area_max_m2", 700.0}}));
  const SearchResult found = search(place, obb_search({300.0, 700.0, 1500.0}));
  for (std::size_t fold = 0; fold < 2; ++fold) {
    EXPECT_EQ(found.chosen(fold).options.at("area_max_m2"), OptionValue(700.0));
    EXPECT_EQ(found.chosen(fold).score, 0.0) << "the same streams make the same parcels";
  }
}

TEST(OptionSearch, ChoosesForAFoldWithoutItsObservedParcels) {
  const StrategyConfig strategy = obb_search({300.0, 700.0, 1500.0});
  MadePlace place("Search.HeldOut", 60, with_options("obb", {{"area_max_m2", 700.0}}));
  const SearchResult before = search(place, strategy);
  const MadePlace other("Search.HeldOut", 60, with_options("obb", {{"area_max_m2", 300.0}}));
  for (std::size_t i = 0; i < place.blocks.size(); ++i) {
    if (before.fold_of_block[i] == 0) place.observed[i] = other.observed[i];
  }
  const SearchResult after = search(place, strategy);
  EXPECT_EQ(before.fold_of_block, after.fold_of_block);
  bool has_other_score = false;
  for (std::size_t r = 0; r < before.rows.size(); ++r) {
    if (before.rows[r].fold == 0) {
      EXPECT_EQ(before.rows[r].score, after.rows[r].score);
      EXPECT_EQ(before.rows[r].is_chosen, after.rows[r].is_chosen);
    } else {
      has_other_score = has_other_score || before.rows[r].score != after.rows[r].score;
    }
  }
  EXPECT_TRUE(has_other_score) << "the other fold's search sees them";
}

TEST(OptionSearch, DoesNotDependOnTheNumberOfThreads) {
  const MadePlace place("Search.Threads", 40, with_options("voronoi", {}));
  const StrategyConfig strategy = obb_search({300.0, 700.0});
  expect_same(search(place, strategy, 1), search(place, strategy, 3));
}

TEST(OptionSearch, TakesTheFirstOfEqualScores) {
  const MadePlace place("Search.Ties", 20, with_options("obb", {}));
  StrategyConfig strategy = obb_search({700.0});
  strategy.search->options["fit_deviations"] = {3.0, 1.0, 2.0};  // says nothing without a fit
  EXPECT_EQ(search(place, strategy).chosen(0).options.at("fit_deviations"), OptionValue(3.0));
}

TEST(OptionSearch, FailingDoesNotPay) {
  const MadePlace place("Search.Fails", 8, with_options("voronoi", {{"area_mean_m2", 150.0}}));
  StrategyConfig strategy = with_options("voronoi", {});
  strategy.search = SearchConfig{};
  strategy.search->options = {{"area_mean_m2", {1.0, 160.0}}};
  const SearchResult found = search(place, strategy);
  EXPECT_GT(found.rows[0].undivided, 0U) << "too many parcels to make";
  EXPECT_GT(found.rows[0].score, found.rows[1].score);
  EXPECT_EQ(found.chosen(0).options.at("area_mean_m2"), OptionValue(160.0));
}

TEST(OptionSearch, DealsFoldsOfEqualSizeThatOtherStrategiesShare) {
  const MadePlace place("Search.Folds", 41, with_options("obb", {}));
  StrategyConfig strategy = obb_search({700.0});
  strategy.search->folds = 3;
  const SearchResult found = search(place, strategy);
  std::vector<std::size_t> size(3);
  for (const std::size_t fold : found.fold_of_block) ++size.at(fold);
  EXPECT_EQ(std::multiset<std::size_t>(size.begin(), size.end()),
            (std::multiset<std::size_t>{13, 14, 14}));
  for (std::size_t fold = 0; fold < 3; ++fold)
    EXPECT_EQ(found.search_blocks[fold], 41 - size[fold]);
  StrategyConfig other = with_options("voronoi", {});
  other.search = strategy.search;
  other.search->options = {{"row_offset_m", {1.0, 2.0}}};
  EXPECT_EQ(search(place, other).fold_of_block, found.fold_of_block);
}

TEST(OptionSearch, BlocksAreDividedWithTheChoiceOfTheirFold) {
  const MadePlace place("Search.Apply", 30, with_options("obb", {}));
  const StrategyConfig strategy = obb_search({300.0, 700.0});
  SearchResult found = search(place, strategy);
  for (SearchRow& row : found.rows)  // another choice per fold
    row.is_chosen = (row.options.at("area_max_m2") == OptionValue(300.0)) == (row.fold == 0);
  const auto divided = subdivide_by_fold(place.view(), strategy, found, 1, 0, Jobs{2});
  ASSERT_EQ(divided.size(), place.blocks.size());
  for (std::size_t i = 0; i < divided.size(); ++i) {
    EXPECT_EQ(divided[i].block, place.blocks[i].id);
    EXPECT_EQ(divided[i].options.at("area_max_m2"),
              OptionValue(found.fold_of_block[i] == 0 ? 300.0 : 700.0));
  }
}

TEST(OptionSearch, SaysWhereAPlaceIsTooSmall) {
  const MadePlace place("Search.Small", 3, with_options("obb", {}));
  EXPECT_THROW(static_cast<void>(search(place, obb_search({700.0}))), InputError);
}

TEST(OptionSearch, IsKeptAndReadBackToTheLastBit) {
  const MadePlace place("Search.Kept", 20, with_options("obb", {}));
  const SearchResult found = search(place, obb_search({300.0, 700.0}));
  const auto text = to_json(found).dump();
  const auto back = search_from(nlohmann::json::parse(text), place.blocks.size());
  ASSERT_TRUE(back);
  expect_same(found, *back);
  EXPECT_EQ(back->chosen(1).options, found.chosen(1).options);
  EXPECT_FALSE(search_from(nlohmann::json::parse(text), 21));
  EXPECT_FALSE(search_from(nlohmann::json::parse("{}"), 20));
}

TEST(GridPoints, AreEveryCombinationLastKeyFastest) {
  SearchConfig config;
  config.options = {{"b", {1.0, 2.0}}, {"a", {std::string("x"), std::string("y")}}};
  const std::vector<OptionMap> points = grid_points(config);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(to_string(points[0]), "a=x;b=1");
  EXPECT_EQ(to_string(points[1]), "a=x;b=2");
  EXPECT_EQ(to_string(points[3]), "a=y;b=2");
}

}  // namespace
}  // namespace plat::harness
