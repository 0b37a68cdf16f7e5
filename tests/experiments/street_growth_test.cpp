#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/rng.h"
#include "street_growth/flattening.h"
#include "street_growth/growth_config.h"
#include "street_growth/tile_statistics.h"

namespace plat::growth {
namespace {

using streets::IntersectionPoint;
using streets::PassingStreet;
using streets::RecoveryShares;

PassingStreet passing(int hierarchy, double value, int connections) {
  return {hierarchy, 1.0 + value, value, value, value, value, value, connections};
}

std::vector<IntersectionPoint> points() {
  return {{{0, 0}, passing(0, 1.0, 2), passing(2, 3.0, 1), {}},
          {{10, 0}, passing(1, 8.0, 2), std::nullopt, {}}};
}

TEST(Flattening, EveryAttributeIsItsMeanAndNoOtherChanges) {
  // The mean of 1, 3 and 8 is 4; tortuosity is 1 more; connections 2, 1, 2 round to 2.
  const auto before = points();
  for (const Attribute attribute : all_attributes()) {
    const auto after = flattened(before, attribute);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      const auto was = streets_of(before[i]);
      const auto is = streets_of(after[i]);
      ASSERT_EQ(is.size(), was.size());
      EXPECT_EQ(after[i].place, before[i].place);
      for (std::size_t k = 0; k < is.size(); ++k) {
        PassingStreet expected = was[k];
        if (attribute == Attribute::kHierarchy) expected.hierarchy = 0;
        if (attribute == Attribute::kTortuosity) expected.tortuosity = 5.0;
        if (attribute == Attribute::kDistance) expected.distance_mean_m = 4.0;
        if (attribute == Attribute::kAngle) expected.angle_mean_rad = 4.0;
        if (attribute == Attribute::kVariances) expected.distance_variance_m2 = 4.0;
        if (attribute == Attribute::kVariances) expected.angle_variance_rad2 = 4.0;
        if (attribute == Attribute::kWidth) expected.width_m = 4.0;
        if (attribute == Attribute::kConnections) expected.connections = 2;
        EXPECT_EQ(is[k], expected) << attribute_name(attribute);
      }
    }
  }
  EXPECT_TRUE(flattened({}, Attribute::kAngle).empty());
}

const Quantity& quantity(std::string_view name) {
  for (const Quantity& q : quantities()) {
    if (q.name == name) return q;
  }
  throw LogicError("no such quantity");
}

/// Squares of 20 known and 20 grown edges, `mean` of both matched, give or take.
std::vector<RecoveryShares> tiles(Rng& rng, int count, double mean) {
  std::vector<RecoveryShares> out;
  for (int i = 0; i < count; ++i) {
    const double matched = std::floor(mean + rng.uniform(-3.0, 3.0));
    out.push_back({20.0, matched, 20.0, matched});
  }
  return out;
}

TEST(TileStatistics, IntervalHoldsTheShareAndNarrowsWithSquares) {
  Rng rng(1);
  const auto few = tiles(rng, 10, 12.0);
  const auto many = tiles(rng, 1000, 12.0);
  const auto width = [&](const std::vector<RecoveryShares>& sample) {
    const auto interval = share_interval(sample, quantity("recall_01"), 500, 1).value();
    const double value = *sum_of(sample).recall_01();
    EXPECT_LE(interval.low, value);
    EXPECT_GE(interval.high, value);
    return interval.high - interval.low;
  };
  EXPECT_GT(width(few), 4.0 * width(many));
  EXPECT_EQ(share_interval(std::span(few).first(1), quantity("recall_01"), 500, 1), std::nullopt);
}

TEST(TileStatistics, EqualSidesDoNotDifferAndBetterOnesDo) {
  Rng rng(2);
  const auto a = tiles(rng, 60, 14.0);
  const auto b = tiles(rng, 60, 11.0);
  const Quantity& recall = quantity("recall_01");
  const auto none = tile_difference(a, a, recall, 300, 300, 1).value();
  EXPECT_EQ(none.difference, 0.0);
  EXPECT_EQ(none.interval.low, 0.0);  // both sides draw the same squares
  EXPECT_EQ(none.interval.high, 0.0);
  EXPECT_EQ(none.p_value, 1.0);
  EXPECT_EQ(none.effect_size, 0.0);
  const auto better = tile_difference(a, b, recall, 300, 300, 1).value();
  EXPECT_NEAR(better.difference, 0.15, 0.05);
  EXPECT_GT(better.interval.low, 0.05);
  EXPECT_LT(better.p_value, 0.01);
  EXPECT_GT(better.effect_size, 0.5);
  const auto worse = tile_difference(b, a, recall, 300, 300, 1).value();
  EXPECT_EQ(worse.difference, -better.difference);
  EXPECT_EQ(worse.effect_size, -better.effect_size);
}

TEST(TileStatistics, POfSidesThatDifferByChanceIsSpreadEvenly) {
  Rng rng(3);
  int small = 0;
  constexpr int kTrials = 200;
  for (int i = 0; i < kTrials; ++i) {
    const auto a = tiles(rng, 30, 12.0);
    const auto b = tiles(rng, 30, 12.0);
    const auto row =
        tile_difference(a, b, quantity("f1_01"), 20, 99, static_cast<std::uint64_t>(i)).value();
    small += row.p_value <= 0.1 ? 1 : 0;
  }
  EXPECT_GT(small, kTrials / 40);
  EXPECT_LT(small, kTrials / 5);
}

TEST(TileStatistics, SharesWithoutAWholeAreAbsent) {
  const std::vector<RecoveryShares> nothing_grown{{4, 0, 0, 0}, {5, 0, 0, 0}};
  EXPECT_EQ(share_interval(nothing_grown, quantity("precision_01"), 50, 1), std::nullopt);
  EXPECT_EQ(tile_difference(nothing_grown, nothing_grown, quantity("precision_01"), 50, 50, 1)
                .has_value(),
            false);
}

nlohmann::json config() {
  return {{"cities", {{{"dataset", "cambridge_ma"}}}},
          {"strategies", "all"},
          {"reference", "nearest"},
          {"ablations", {{{"label", "no angle"}, {"flatten", "angle"}}}}};
}

void expect_refused(const nlohmann::json& json, const std::string& word) {
  try {
    static_cast<void>(parse_growth_config(json, "c.json", streets::street_growers()));
    ADD_FAILURE() << "accepted: " << json.dump();
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("c.json"), std::string::npos) << what;
    EXPECT_NE(what.find(word), std::string::npos) << what;
  }
}

TEST(GrowthConfig, HasEveryStrategyAndTheReferenceWithSomethingTakenAway) {
  const GrowthConfig read = parse_growth_config(config(), "c.json", streets::street_growers());
  ASSERT_EQ(read.variants.size(), streets::street_growers().names().size() + 1);
  EXPECT_EQ(read.variants[read.reference].label, "nearest");
  const Variant& ablation = read.variants.back();
  EXPECT_EQ(ablation.strategy, "nearest");
  EXPECT_EQ(ablation.flattened, std::vector{Attribute::kAngle});
  EXPECT_TRUE(ablation.is_ablation);
  EXPECT_FALSE(ablation.is_mapped);
  EXPECT_TRUE(read.variants[read.reference].is_mapped);
  nlohmann::json mapped = config();
  mapped["maps"] = {"no angle"};
  EXPECT_TRUE(
      parse_growth_config(mapped, "c.json", streets::street_growers()).variants.back().is_mapped);
}

TEST(GrowthConfig, RefusesWhatWouldOnlyBeFoundLater) {
  auto with = [](const char* key, const nlohmann::json& value) {
    nlohmann::json object = config();
    object[key] = value;
    return object;
  };
  expect_refused(with("cites", 1), "cites");
  expect_refused(with("strategies", {{{"name", "neerest"}}}), "did you mean");
  expect_refused(with("reference", "none"), "none");
  expect_refused(with("ablations", {{{"label", "x"}, {"flatten", "angel"}}}), "did you mean");
  expect_refused(with("ablations", {{{"label", "nearest"}}}), "twice");
  expect_refused(with("ablations", {{{"label", "x"}, {"options", {{"neighbours", 0}}}}}), "1..256");
  expect_refused(with("seeds", 0), "seeds");
  expect_refused(with("maps", {"no angel"}), "no angel");
  expect_refused(with("cities", {{{"dataset", "cambridge_ma"}, {"window", {1, 2, 3}}}}), "window");
}

}  // namespace
}  // namespace plat::growth
